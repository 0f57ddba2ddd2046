// Cases counted, in words and by bins.
import { hasFailed, kMissing, kOutcomes } from "./outcomes.js";

/** "1 case", "1,200 cases" */
export const casesText = (count) => (count === 1 ? "1 case" : `${count.toLocaleString("en")} cases`);

/**
 * For each bin of a column the number of the cases with each outcome.
 * @param {{of: (value: number) => number, texts: string[]}} bins
 * @param {Uint8Array} mask of the cases that count
 */
export function countOutcomes(column, bins, outcomes, mask) {
  const counts = bins.texts.map(() => new Array(kOutcomes.length).fill(0));
  for (let i = 0; i < outcomes.length; ++i) {
    const bin = mask[i] ? bins.of(column.values[i]) : -1;
    if (bin >= 0) ++counts[bin][outcomes[i]];
  }
  return counts;
}

/**
 * For each pair of bins the number of cases with a record, and of those that have failed in whatever way: cells[y][x].
 */
export function countFailures([x, xBins], [y, yBins], outcomes, mask) {
  const cells = yBins.texts.map(() => xBins.texts.map(() => ({ cases: 0, failed: 0 })));
  for (let i = 0; i < outcomes.length; ++i) {
    if (!mask[i] || outcomes[i] === kMissing) continue;
    const [column, row] = [xBins.of(x.values[i]), yBins.of(y.values[i])];
    if (column < 0 || row < 0) continue;
    ++cells[row][column].cases;
    if (hasFailed(outcomes[i])) ++cells[row][column].failed;
  }
  return cells;
}
