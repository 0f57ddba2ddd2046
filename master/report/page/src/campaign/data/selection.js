// Which cases are selected: those of the shown outcomes whose values are within all brushes.

export class Selection extends EventTarget {
  /** @param {ArrayLike<number>} outcomes of all cases */
  constructor(outcomes) {
    super();
    this.outcomes = outcomes;
    this.hidden = new Set();
    /** @type {Map<import("./column.js").Column, [number, number]>} both limits included */
    this.brushes = new Map();
    this.mask = new Uint8Array(outcomes.length);
    this.#update();
  }

  /** @param {[number, number]|null} limits null: none */
  brush(column, limits) {
    if (limits === null) this.brushes.delete(column);
    else this.brushes.set(column, limits);
    this.#update();
  }

  toggle(outcome) {
    if (!this.hidden.delete(outcome)) this.hidden.add(outcome);
    this.#update();
  }

  clear() {
    this.brushes.clear();
    this.hidden.clear();
    this.#update();
  }

  get isWhole() {
    return this.count === this.mask.length;
  }

  #update() {
    const limits = [...this.brushes].map(([column, [from, until]]) => ({ values: column.values, from, until }));
    this.count = 0;
    for (let i = 0; i < this.mask.length; ++i) {
      const isIn = ({ values, from, until }) => values[i] >= from && values[i] <= until;
      const isSelected = !this.hidden.has(this.outcomes[i]) && limits.every(isIn);
      this.mask[i] = isSelected ? 1 : 0;
      this.count += this.mask[i];
    }
    this.dispatchEvent(new Event("change"));
  }
}
