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

/** The text, or else the longest of cut(1), cut(2), … without so many of its characters for which there is room. */
function shortened(pen, text, width, cut) {
  if (pen.measureText(text).width <= width) return text;
  let dropped = 1;
  while (dropped < text.length - 1 && pen.measureText(cut(dropped)).width > width) ++dropped;
  return cut(dropped);
}

/** As much of the beginning of a text as there is room for, one character at least. */
export function fitted(pen, text, width) {
  return shortened(pen, text, width, (dropped) => `${text.slice(0, Math.max(1, text.length - dropped))}…`);
}

/** As much of the end of a name: "…offset.wrist_1". Names of one component differ there. */
export function fittedName(pen, name, width) {
  return shortened(pen, name, width, (dropped) => `…${name.slice(dropped)}`);
}
