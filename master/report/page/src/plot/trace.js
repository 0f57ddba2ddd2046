// How a curve is drawn: a line where a pixel has one value or only rises or falls, an upright bar where it has many.
// Long jagged lines would take a browser ten times as long.

/** If the values of a pixel are no further apart than this, a line is drawn [px]. */
const kSlim = 1.5;
/** Bars nearer than this touch [px]. */
const kNear = 1.75;

/**
 * @typedef {object} Sink the target of drawing: a line, and rectangles
 * @property {(x: number, y: number) => void} moveTo
 * @property {(x: number, y: number) => void} lineTo
 * @property {(x: number, y: number, width: number, height: number) => void} rect
 */

export class Tracer {
  #pen = null;
  /** The place of a value that is not yet connected by a line. */
  #lone = null;

  /** @param {Sink} sink @param {{isStepped: boolean, hasDots: boolean, width: number}} style width of lines [px] */
  constructor(sink, { isStepped, hasDots, width }) {
    this.sink = sink;
    this.isStepped = isStepped;
    this.hasDots = hasDots;
    this.width = width;
  }

  /** One value. */
  point(x, y) {
    this.#lineTo(x, y);
    if (this.hasDots) this.#dot(x, y);
  }

  /** A gap: the line ends, and a new one begins after it. */
  gap() {
    if (this.#lone) this.#dot(this.#lone.x, this.#lone.y);
    this.#pen = this.#lone = null;
  }

  /**
   * All values of a pixel. First and last are null if there is none.
   * @param {{x: number, y: number|null}} first
   * @param {{x: number, y: number|null}} last
   * @param {number} top the y of the largest value
   * @param {number} bottom the y of the smallest value
   */
  bar(first, last, top, bottom) {
    const isWhole = first.y !== null && last.y !== null;
    if (isWhole && bottom - top <= kSlim) return this.#lineTo((first.x + last.x) / 2, (top + bottom) / 2);
    if (isWhole && isSlope(first.y, last.y, top, bottom)) {
      this.#lineTo(first.x, first.y);
      return this.#lineTo(last.x, last.y);
    }
    const touches = this.#pen?.isBar && first.x - this.#pen.x <= kNear;
    if (!touches && this.#pen && first.y !== null) this.#lineTo(first.x, first.y);
    const high = touches ? Math.min(top, this.#pen.y) : top;
    const low = touches ? Math.max(bottom, this.#pen.y) : bottom;
    this.sink.rect(Math.floor(first.x), high - this.width / 2, Math.ceil(this.width), low - high + this.width);
    this.#lone = null;
    this.#pen = last.y === null ? null : { ...last, isBar: true };
  }

  end() {
    this.gap();
  }

  #lineTo(x, y) {
    if (this.#pen === null) {
      this.sink.moveTo(x, y);
      this.#lone = { x, y };
    } else {
      if (this.#pen.isBar) this.sink.moveTo(this.#pen.x, this.#pen.y);
      if (this.isStepped) this.sink.lineTo(x, this.#pen.y);
      this.sink.lineTo(x, y);
      this.#lone = null;
    }
    this.#pen = { x, y, isBar: false };
  }

  #dot(x, y) {
    const size = this.width * 2.4;
    this.sink.rect(x - size / 2, y - size / 2, size, size);
  }
}

/** Whether all values are between the first and the last, so that a line from one to the other is complete. */
const isSlope = (first, last, top, bottom) => Math.min(first, last) === top && Math.max(first, last) === bottom;

/**
 * Draws the result of groupTimes() and groupValues().
 * @param {Tracer} tracer
 * @param {{groups: number[], times: number[], values: (number|null)[]}} points
 * @param {{x: (time: number) => number, y: (value: number) => number}} place
 */
export function trace(tracer, { groups, times, values }, place) {
  const height = (value) => (value === null ? null : place.y(value));
  for (let g = 0, p = 0; g < groups.length; g += 2) {
    const isPoint = groups[g + 1] - groups[g] === 1;
    const isGap = values[isPoint ? p : p + 1] === null;
    if (isGap) tracer.gap();
    else if (isPoint) tracer.point(place.x(times[p]), place.y(values[p]));
    else {
      const first = { x: place.x(times[p]), y: height(values[p]) };
      const last = { x: place.x(times[p + 3]), y: height(values[p + 3]) };
      tracer.bar(first, last, place.y(values[p + 2]), place.y(values[p + 1]));
    }
    p += isPoint ? 1 : 4;
  }
  tracer.end();
}
