// The order of the rows of the table of cases.
import { hasFailed } from "./outcomes.js";

/**
 * The selected cases with a kind of outcome.
 * @param {string} kind "failed": all that have not passed, "": all, or the number of an outcome
 * @param {string} words that must all be in the reason, ignoring case
 */
export function rowsOf({ outcomes, reasons }, mask, kind, words = "") {
  const wanted = words.toLowerCase().split(/\s+/).filter(Boolean);
  const isKind = (outcome) => kind === "" || (kind === "failed" ? hasFailed(outcome) : outcome === Number(kind));
  const found = [];
  for (let i = 0; i < outcomes.length; ++i) {
    if (!mask[i] || !isKind(outcomes[i])) continue;
    if (wanted.length > 0 && !wanted.every((word) => reasons[i].toLowerCase().includes(word))) continue;
    found.push(i);
  }
  return found;
}

/**
 * Sorts rows by a number of each; NaN is last in both directions, and equal ones keep their order.
 * @param {ArrayLike<number>} values
 */
export function sorted(rows, values, isDescending) {
  const sign = isDescending ? -1 : 1;
  return [...rows].sort((a, b) => {
    const [x, y] = [values[a], values[b]];
    if (Number.isNaN(x) || Number.isNaN(y)) return Number(Number.isNaN(x)) - Number(Number.isNaN(y));
    return x === y ? a - b : sign * (x - y);
  });
}
