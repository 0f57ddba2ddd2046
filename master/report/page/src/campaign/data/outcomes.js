// What can become of a case. The numbers are those of the data.

/**
 * @typedef {object} Outcome
 * @property {string} name as the tables of the campaign have it
 * @property {string} color a custom property of the style sheet
 * @property {"circle"|"diamond"|"triangle"|"square"|"cross"|"ring"} mark so that not only colours tell them apart
 */

/** @type {Outcome[]} */
export const kOutcomes = [
  { name: "passed", color: "--passed", mark: "circle" },
  { name: "failed", color: "--failed", mark: "diamond" },
  { name: "error", color: "--error", mark: "triangle" },
  { name: "crashed", color: "--crashed", mark: "square" },
  { name: "timed out", color: "--timed-out", mark: "cross" },
  { name: "missing", color: "--missing", mark: "ring" },
];

export const kPassed = 0;
export const kMissing = 5;

/** Rare ones are drawn last. */
export const kDrawingOrder = [kMissing, kPassed, 1, 2, 3, 4];

/** Whether it has ended otherwise than passed. */
export const hasFailed = (outcome) => outcome !== kPassed && outcome !== kMissing;
