// The selected part of an axis: dragged, or written into fields.
import { numberText } from "../../data/number_text.js";
import { h } from "../../dom.js";

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
    this.fields = column.isNumber ? this.#numberFields() : this.#textField();
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
    this.showFields(limits);
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

  #numberFields() {
    const field = (label, placeholder) =>
      h("input", { type: "text", inputMode: "decimal", "aria-label": label, placeholder: numberText(placeholder) });
    const from = field(`${this.column.name} from`, this.column.least);
    const until = field(`${this.column.name} to`, this.column.most);
    const read = (input, otherwise) => (input.value.trim() === "" ? otherwise : Number(input.value.replace(",", ".")));
    const change = () => {
      const limits = [read(from, -Infinity), read(until, Infinity)];
      for (const [input, value] of [
        [from, limits[0]],
        [until, limits[1]],
      ])
        input.setAttribute("aria-invalid", String(Number.isNaN(value)));
      if (limits.some(Number.isNaN)) return;
      const isAll = limits[0] === -Infinity && limits[1] === Infinity;
      this.selection.brush(this.column, isAll ? null : limits);
    };
    from.addEventListener("change", change);
    until.addEventListener("change", change);
    this.showFields = (limits) => {
      const text = (value) =>
        value === undefined || !Number.isFinite(value) ? "" : numberText(Number(value.toPrecision(6)));
      if (document.activeElement !== from) from.value = text(limits?.[0]);
      if (document.activeElement !== until) until.value = text(limits?.[1]);
    };
    return h("fieldset", {}, h("legend", {}, this.column.name), from, " to ", until);
  }

  #textField() {
    const options = this.column.categories.map((text, place) => h("option", { value: String(place) }, text));
    const select = h("select", { "aria-label": this.column.name }, h("option", { value: "" }, "all"), ...options);
    select.addEventListener("change", () => {
      const place = Number(select.value);
      this.selection.brush(this.column, select.value === "" ? null : [place - 0.5, place + 0.5]);
    });
    this.showFields = (limits) => {
      const places = this.column.categories.map((_, i) => i).filter((i) => limits && i >= limits[0] && i <= limits[1]);
      select.value = places.length === 1 ? String(places[0]) : "";
    };
    return h("fieldset", {}, h("legend", {}, this.column.name), select);
  }
}
