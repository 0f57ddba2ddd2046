// What a signal was in the time that is shown, where there is no cursor to show the value at.
import { lastAtOrBefore } from "../data/exact_time.js";
import { briefText } from "../data/number_text.js";

/**
 * @param {{from: number, until: number}} view [s]
 * @returns {{last: number, least: number, most: number}|null} the row of the last value, and the values between which
 * the others are: least > most if there is no number; null if there is no row yet
 */
export function summaryOf(column, { from, until }) {
  const { seconds } = column;
  const last = lastAtOrBefore(seconds, until);
  if (last < 0) return null;
  const first = Math.max(0, lastAtOrBefore(seconds, from));
  return { last, ...column.pyramid.extremes(first, last + 1) };
}

/** @returns {{text: string, title: string}} in short, and with all digits */
export function summaryText(column, view) {
  const found = summaryOf(column, view);
  if (found === null) return { text: "–", title: "no value yet" };
  const { last, least, most } = found;
  const exact = column.textAt(last);
  if (column.isState) return { text: `last ${exact}`, title: `last: ${exact}` };
  const unit = column.unit ? ` ${column.unit}` : "";
  const ends = least <= most ? [least, most] : [];
  const words = (textOf) => ends.map((value, i) => `${["min", "max"][i]} ${textOf(value)}`);
  return {
    text: [`last ${briefText(column.values[last])}`, ...words(briefText)].join(" · ") + unit,
    title: [`last ${exact}`, ...words((value) => column.valueText(value))].join(", ") + unit,
  };
}
