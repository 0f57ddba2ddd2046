// The state that all parts of the page share: the time range that is shown, and the cursor.

/** Minimum range of the view, so that neighbouring pixels have different times as doubles. */
const kLeastDoubles = 4096;
const kLeastSpan = 2e-11;

/**
 * Events: "view" when another time range is shown, "cursor" when the cursor has moved. Both are dispatched at most
 * once per animation frame, however many changes there were before. And "data" when the report has others.
 */
export class View extends EventTarget {
  #changed = new Set();

  /** @param {{from: number, until: number}} whole [s] */
  constructor(whole) {
    super();
    this.whole = whole;
    this.from = whole.from;
    this.until = whole.until;
    /** The position of the cursor [s]; null if there is none. */
    this.cursor = null;
    /** The row that the cursor was set to, if it was set to one, and the times of whose rows it is. */
    this.row = null;
    /** Whether the cursor keeps its position when the mouse moves. */
    this.isHeld = false;
  }

  get span() {
    return this.until - this.from;
  }

  get isWhole() {
    return this.from === this.whole.from && this.until === this.whole.until;
  }

  /** Shows [from, until], limited to the time of the run. */
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

  /** The run has gone on, which is followed if the whole is shown; "data" is dispatched at once. */
  grow(whole) {
    const follows = this.isWhole;
    this.whole = whole;
    if (follows) Object.assign(this, { from: whole.from, until: whole.until });
    this.dispatchEvent(new Event("data"));
    this.#tell("view");
  }

  showWhole() {
    this.show(this.whole.from, this.whole.until);
  }

  /** Makes the shown time range `factor` times as long; `center` keeps its position. */
  zoom(factor, center = this.cursor ?? (this.from + this.until) / 2) {
    const middle = Math.min(Math.max(center, this.from), this.until);
    this.show(middle - (middle - this.from) * factor, middle + (this.until - middle) * factor);
  }

  /** Moves by a share of the shown time range. */
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
   * Sets and holds the cursor, and shows its position if it was out of sight.
   * @param {number} seconds
   * @param {{of: Float64Array, index: number}} [row] if doubles do not distinguish it from its neighbours
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

  /** The position of a time, as a share of the shown range. */
  shareOf(seconds) {
    return (seconds - this.from) / this.span;
  }

  #tell(name) {
    if (this.#changed.size === 0) requestAnimationFrame(() => this.flush());
    this.#changed.add(name);
  }

  /** Dispatches pending events at once instead of with the next animation frame. */
  flush() {
    const names = [...this.#changed];
    this.#changed.clear();
    for (const name of names) this.dispatchEvent(new Event(name));
  }
}
