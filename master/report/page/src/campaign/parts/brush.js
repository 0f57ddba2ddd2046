// The selected part of an axis: dragged, or written into fields.
import { h } from "../../dom.js";
import { numberFields, textField } from "./brush_fields.js";

/** On both sides of the axis [px]. */
const kReach = 14;
/** A drag that is shorter releases the brush [px]. */
const kClick = 4;

export class Brush {
  constructor(column, selection, top, height) {
    Object.assign(this, { column, selection, height });
    this.mark = h("div.brush-mark", { hidden: true });
    this.box = h("div.brush", { title: column.name }, this.mark);
    Object.assign(this.box.style, { top: `${top}px`, height: `${height}px`, width: `${2 * kReach}px` });
    this.fields = column.isNumber ? numberFields(column, selection) : textField(column, selection);
    this.#listen();
    selection.addEventListener("change", () => this.#show());
  }

  /** The box is centred there [px]. */
  place(x) {
    this.box.style.left = `${x - kReach}px`;
  }

  #show() {
    const limits = this.selection.brushes.get(this.column);
    this.mark.hidden = !limits;
    this.fields.show(limits);
    if (!limits) return;
    const [bottom, top] = limits.map((value) => this.column.shareOf(value) * this.height);
    Object.assign(this.mark.style, { bottom: `${bottom}px`, height: `${Math.max(2, top - bottom)}px` });
  }

  #listen() {
    let start = null;
    const at = (event) => event.clientY - this.box.getBoundingClientRect().top;
    const shares = (one, other) => [one, other].map((y) => 1 - y / this.height).sort((a, b) => a - b);
    const select = (y) => {
      const limits = shares(start, y).map((share) => this.column.valueAt(Math.min(1, Math.max(0, share))));
      this.selection.brush(this.column, limits);
    };
    this.box.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      start = at(event);
      this.box.setPointerCapture(event.pointerId);
    });
    this.box.addEventListener("pointermove", (event) => {
      if (start !== null && Math.abs(at(event) - start) >= kClick) select(at(event));
    });
    const end = (event) => {
      if (start !== null && Math.abs(at(event) - start) < kClick) this.selection.brush(this.column, null);
      start = null;
    };
    this.box.addEventListener("pointerup", end);
    this.box.addEventListener("pointercancel", () => (start = null));
  }
}
