// A quantity of each case: a parameter, an aggregate, a margin, a time.
import { briefText, numberText } from "../../data/number_text.js";
import { decimalsOf } from "../../plot/ticks.js";

/** Of numbers with no more different values than these each one is a bin. */
const kFewValues = 12;
/** Of a parameter that the case leaves as it is; texts have it from the campaign. */
const kScenarioValue = "(as in the scenario)";

/** A text as it is shown: there is something also where it is empty. */
export const shownText = (text) => (text === "" ? "(empty)" : text);

function finiteExtremes(values) {
  let least = Infinity;
  let most = -Infinity;
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    if (value < least) least = value;
    if (value > most) most = value;
  }
  return [least, most];
}

/** The sorted different values; nothing if there are more than `most`. */
function distinct(values, most) {
  const found = new Set();
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    found.add(value);
    if (found.size > most) return undefined;
  }
  return [...found].sort((a, b) => a - b);
}

/** Brief ones, if no two are the same. */
function differentTexts(values) {
  const texts = values.map(briefText);
  return new Set(texts).size === texts.length ? texts : values.map((value) => numberText(value));
}

export class Column {
  /**
   * @param {string} name
   * @param {"parameter"|"aggregate"|"margin"|"time"} role
   * @param {ArrayLike<number>} values of a text: its index in `categories`; NaN is not known
   * @param {string[]} [categories]
   */
  constructor(name, role, values, categories) {
    this.name = name;
    this.role = role;
    this.values = values;
    this.categories = categories;
    const [least, most] = finiteExtremes(values);
    this.least = least;
    this.most = most;
  }

  /** Of texts, in an order in which "10" is behind "9". */
  static ofTexts(name, role, values, texts) {
    const order = texts.map((_, i) => i).sort((a, b) => texts[a].localeCompare(texts[b], "en", { numeric: true }));
    const places = new Int32Array(texts.length);
    order.forEach((old, place) => (places[old] = place));
    const codes = Float64Array.from(values, (old) => places[old]);
    return new Column(
      name,
      role,
      codes,
      order.map((old) => shownText(texts[old])),
    );
  }

  get isNumber() {
    return this.categories === undefined;
  }

  get varies() {
    return this.most > this.least;
  }

  /** Bottom and top of its axis. */
  get range() {
    if (!this.isNumber) return [-0.5, this.categories.length - 0.5];
    if (!(this.least <= this.most)) return [0, 1];
    const room = this.varies ? (this.most - this.least) * 0.03 : Math.abs(this.least) * 0.1 || 1;
    return [this.least - room, this.most + room];
  }

  /** The place on the axis, from 0 to 1; infinities are at its ends, NaN stays. */
  shareOf(value) {
    const [bottom, top] = this.range;
    return Math.min(1, Math.max(0, (value - bottom) / (top - bottom)));
  }

  /** The number there, with no more digits than the axis can show. */
  valueAt(share) {
    const [bottom, top] = this.range;
    const value = bottom + share * (top - bottom);
    const step = (top - bottom) / 1e4;
    return step > 1e-20 ? Number(value.toFixed(decimalsOf(step))) : value;
  }

  /** With all digits. */
  textAt(row) {
    const value = this.values[row];
    if (Number.isNaN(value)) return this.role === "parameter" ? kScenarioValue : "";
    return this.isNumber ? numberText(value) : this.categories[value];
  }

  briefAt(row) {
    const value = this.values[row];
    if (Number.isNaN(value)) return this.role === "parameter" ? kScenarioValue : "";
    return this.isNumber ? briefText(value) : this.categories[value];
  }

  /**
   * Parts of its range: one for each of few values, or else `most` of equal width.
   * @returns {{texts: string[], of: (value: number) => number}} `of` is -1 for what is in no bin
   */
  bins(most) {
    if (!this.isNumber) return { texts: this.categories, of: (value) => (Number.isNaN(value) ? -1 : value) };
    const few = distinct(this.values, Math.min(most, kFewValues));
    if (few) return { texts: differentTexts(few), of: (value) => few.indexOf(value) };
    const width = (this.most - this.least) / most;
    const edge = (i) => briefText(this.least + i * width);
    const texts = Array.from({ length: most }, (_, i) => `${edge(i)} – ${edge(i + 1)}`);
    const place = (value) => Math.min(most - 1, Math.floor((value - this.least) / width));
    return { texts, of: (value) => (Number.isFinite(value) ? place(value) : -1) };
  }
}
