// The vertical axis of a pane: where values are, as shares of its height from the bottom, and the ticks beside it.
import { linearRange, logarithmicDecades } from "./scale.js";
import { commonExponent, powerText, ticks, valueTickTexts } from "./ticks.js";

/** The maximum number of ticks. */
const kMostTicks = 6;
/** The height of the place that zeros have below the decades of a logarithmic axis, and negative values below that. */
const kPlace = 0.17;
/** An axis that spans less than this share of its values has ticks that count from one of them. */
const kFine = 1e-7;

const inside = (share) => Math.min(1, Math.max(0, share));

/**
 * @typedef {object} ValueAxis
 * @property {(value: number) => number} shareOf 0 at the bottom, 1 at the top; what is beyond them is at the edge
 * @property {(value: number) => boolean} has whether a value has a place on it
 * @property {{share: number, text: string}[]} ticks
 * @property {number} exponent the power of ten that the texts of ticks leave out
 * @property {number} offset what they leave out before that
 * @property {number} below the height of the places of zeros and negative values
 */

/** @implements {ValueAxis} */
export class LinearAxis {
  /**
   * @param {{least: number, most: number}} extremes of what it shows
   * @param {boolean} isWhole whether the values are whole numbers
   */
  constructor(extremes, isWhole) {
    [this.bottom, this.top] = linearRange(extremes);
    this.isWhole = isWhole;
    this.below = 0;
    const largest = Math.max(Math.abs(extremes.least), Math.abs(extremes.most));
    const isFine = this.top - this.bottom < kFine * largest;
    this.offset = isFine ? (this.#tickValues.find((value) => value >= extremes.least) ?? 0) : 0;
    const shown = isFine ? this.top - this.bottom : largest;
    this.exponent = commonExponent(Number.isFinite(shown) ? shown : 0);
  }

  shareOf(value) {
    return inside((value / 2 - this.bottom / 2) / (this.top / 2 - this.bottom / 2));
  }

  has(value) {
    return value >= this.bottom && value <= this.top;
  }

  get #tickValues() {
    return ticks(this.bottom, this.top, kMostTicks, this.isWhole ? 1 : 0).values;
  }

  get ticks() {
    const values = this.#tickValues;
    const differences = values.map((value) => value - this.offset);
    const texts = valueTickTexts(differences, this.exponent);
    return values.map((value, i) => ({ share: this.shareOf(value), text: texts[i] }));
  }
}

/** @implements {ValueAxis} */
export class LogarithmicAxis {
  /** @param {{least: number, most: number, leastPositive: number}} extremes of what it shows */
  constructor(extremes) {
    [this.first, this.last] = logarithmicDecades(extremes);
    this.exponent = 0;
    this.offset = 0;
    this.places = ["0", "< 0"].slice(0, extremes.least < 0 ? 2 : extremes.least <= 0 ? 1 : 0);
    this.below = this.places.length * kPlace;
  }

  shareOf(value) {
    if (!(value > 0)) return inside(this.#placeShare(value < 0 ? 1 : 0));
    return this.#decadeShare(Math.log10(value));
  }

  has(value) {
    if (!(value > 0)) return this.places.length > (value < 0 ? 1 : 0);
    const decade = Math.log10(value);
    return decade >= this.first && decade <= this.last;
  }

  get ticks() {
    const step = Math.max(1, Math.ceil((this.last - this.first) / kMostTicks));
    const found = this.places.map((text, i) => ({ share: this.#placeShare(i), text }));
    for (let decade = this.first; decade <= this.last; decade += step) {
      found.push({ share: this.#decadeShare(decade), text: powerText(decade) });
    }
    return found.sort((a, b) => a.share - b.share);
  }

  /** The line in the place of zeros, or of negative values below it. */
  #placeShare(index) {
    return this.below - (index + 0.6) * kPlace;
  }

  #decadeShare(decade) {
    return this.below + inside((decade - this.first) / (this.last - this.first)) * (1 - this.below);
  }
}
