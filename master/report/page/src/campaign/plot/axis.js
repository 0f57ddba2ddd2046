// Where the texts of an axis are.
import { commonExponent, powerText, ticks, valueTickTexts } from "../../plot/ticks.js";

/**
 * Places from 0 to 1 with their texts.
 * @param {import("../data/column.js").Column} column
 * @param {number} most
 * @returns {{share: number, text: string}[]}
 */
export function axisTicks(column, most) {
  const [bottom, top] = column.range;
  if (!column.isNumber) {
    const step = Math.ceil(column.categories.length / most);
    const all = column.categories.map((text, i) => ({ share: column.shareOf(i), text }));
    return all.filter((_, i) => i % step === 0);
  }
  const { values } = ticks(bottom, top, most);
  const texts = valueTickTexts(values, exponentOf(column));
  return values.map((value, i) => ({ share: column.shareOf(value), text: texts[i] }));
}

const exponentOf = (column) => commonExponent(Math.max(...column.range.map(Math.abs)));

/** The name of the column, with the power of ten that its texts leave out. */
export function axisTitle(column) {
  const exponent = column.isNumber ? exponentOf(column) : 0;
  return exponent === 0 ? column.name : `${column.name} · ${powerText(exponent)}`;
}

/** As much of a text as there is room for. */
export function fitted(pen, text, width) {
  if (pen.measureText(text).width <= width) return text;
  let end = text.length;
  while (end > 1 && pen.measureText(`${text.slice(0, end)}…`).width > width) --end;
  return `${text.slice(0, end)}…`;
}

/** The same of its end: "…offset.wrist_1". Names of one component differ there. */
export function fittedName(pen, name, width) {
  if (pen.measureText(name).width <= width) return name;
  let begin = 1;
  while (begin < name.length - 1 && pen.measureText(`…${name.slice(begin)}`).width > width) ++begin;
  return `…${name.slice(begin)}`;
}
