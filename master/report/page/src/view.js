// What all parts of the page share: which time is shown, and where the cursor is.

/** Pixels of a display in which no two doubles of time are told apart make no sense. */
const kLeastDoubles = 4096;
const kLeastSpan = 2e-11;

/**
 * Events: "view" when another time is shown, "cursor" when the cursor has moved. Both are told once for each picture
 * that the screen shows, whatever has changed before.
 */
export class View extends EventTarget {
  #told = new Set();

  /** @param {{from: number, until: number}} whole [s] */
  constructor(whole) {
    super();
    this.whole = whole;
    this.from = whole.from;
    this.until = whole.until;
    /** Where the cursor is [s]; null where it is nowhere. */
    this.cursor = null;
    /** The row that the cursor was put on, where it was put on one. */
    this.row = null;
    /** Whether the cursor stays where it is when the mouse moves. */
    this.isHeld = false;
  }

  get span() {
    return this.until - this.from;
  }

  get isWhole() {
    return this.from === this.whole.from && this.until === this.whole.until;
  }

  /** Shows [from, until], as far as there is such a time. */
  show(from, until) {
    const { whole } = this;
    const least = Math.max(kLeastSpan, Math.abs(from) * Number.EPSILON * kLeastDoubles);
    const span = Math.min(whole.until - whole.from, Math.max(until - from, least));
    const start = Math.min(Math.max((from + until - span) / 2, whole.from), whole.until - span);
    if (start === this.from && start + span === this.until) return;
    this.from = start;
    this.until = span === whole.until - whole.from ? whole.until : start + span;
    this.#tell("view");
  }

  showWhole() {
    this.show(this.whole.from, this.whole.until);
  }

  /** Makes the time that is shown `factor` times as long, with `center` at its place. */
  zoom(factor, center = this.cursor ?? (this.from + this.until) / 2) {
    const middle = Math.min(Math.max(center, this.from), this.until);
    this.show(middle - (middle - this.from) * factor, middle + (this.until - middle) * factor);
  }

  /** Moves by a share of what is shown. */
  pan(share) {
    const shift = share * this.span;
    const bounded = Math.min(Math.max(shift, this.whole.from - this.from), this.whole.until - this.until);
    this.show(this.from + bounded, this.until + bounded);
  }

  /** @param {number|null} seconds */
  moveCursor(seconds) {
    if (seconds === this.cursor) return;
    this.cursor = seconds;
    this.row = null;
    this.#tell("cursor");
  }

  /**
   * Puts the cursor somewhere to stay, and shows the place if it was out of sight.
   * @param {number} seconds
   * @param {number} [row] where doubles do not tell it from its neighbours
   */
  holdCursor(seconds, row = null) {
    this.isHeld = true;
    this.cursor = seconds;
    this.row = row;
    this.#tell("cursor");
    if (seconds < this.from || seconds > this.until) this.show(seconds - this.span / 2, seconds + this.span / 2);
  }

  releaseCursor() {
    this.isHeld = false;
    this.cursor = null;
    this.row = null;
    this.#tell("cursor");
  }

  /** Where a time is, as a share of what is shown. */
  shareOf(seconds) {
    return (seconds - this.from) / this.span;
  }

  #tell(name) {
    if (this.#told.size === 0) requestAnimationFrame(() => this.flush());
    this.#told.add(name);
  }

  /** Tells at once what would be told with the next picture. */
  flush() {
    const names = [...this.#told];
    this.#told.clear();
    for (const name of names) this.dispatchEvent(new Event(name));
  }
}
