// The rows under the common time axis: messages, panes, activities. It draws the visible rows, moves the
// cursor through all rows, and zooms by dragging.
import { h } from "./dom.js";
import { kGutter } from "./plot/layout.js";

/** A drag shorter than this is a click [px]. */
const kClick = 4;
/** The zoom factor of one turn of the wheel. */
const kWheel = 1.0015;

/** Whether it is over a part of the page to which the mouse does something else. */
const hasOwnMouse = (event) => event.target.closest(".own-mouse") !== null;

/**
 * @typedef {object} Row
 * @property {HTMLElement} element with the drawing at its left edge
 * @property {(width: number) => void} draw
 * @property {() => void} [print] what paper needs beside
 */

export class Stack {
  #dirty = new Set();
  #visible = new Set();
  #rows = new Map();

  /**
   * @param {import("./view.js").View} view
   * @param {HTMLElement} head stays at the top while the rows scroll
   * @param {HTMLElement} measure in the head, as wide as the drawings; the marks of all rows are put into it, too
   * @param {number[]} failures instants of failures [s], which are marked by a line through all rows
   */
  constructor(view, head, measure, failures) {
    this.view = view;
    this.failures = failures.map((seconds) => ({
      seconds,
      line: h("div.failure-line"),
      mark: h("div.failure-line", { "aria-hidden": "true" }),
    }));
    this.measure = measure;
    this.line = h("div.cursor-line", { "aria-hidden": "true", hidden: true });
    this.selection = h("div.selection", { "aria-hidden": "true", hidden: true });
    this.body = h("div.stack-body");
    const failureLines = this.failures.map(({ line }) => line);
    this.clip = h("div.stack-overlay", { "aria-hidden": "true" }, ...failureLines, this.line, this.selection);
    this.element = h("div.stack", {}, head, this.body, this.clip);
    this.mark = h("div.cursor-line", { "aria-hidden": "true", hidden: true });
    measure.append(...this.failures.map(({ mark }) => mark), this.mark);
    this.observer = new IntersectionObserver((entries) => this.#onSight(entries), { rootMargin: "300px" });
    new ResizeObserver(() => this.redraw()).observe(this.body);
    view.addEventListener("view", () => this.redraw());
    view.addEventListener("cursor", () => this.#placeLines());
    this.#listen();
  }

  /** @param {Row} row @param {HTMLElement} [parent] of the row, if it is not at the end of the stack */
  add(row, parent = this.body) {
    if (!row.element.isConnected && row.element.parentElement !== parent) parent.append(row.element);
    this.#rows.set(row.element, row);
    this.#dirty.add(row);
    this.observer.observe(row.element);
  }

  /** Width of the drawings [px]. */
  get width() {
    return this.measure.clientWidth;
  }

  /** Draws all visible rows; the others when they become visible. */
  redraw() {
    for (const row of this.#rows.values()) this.#dirty.add(row);
    this.#drawVisible();
    this.#placeLines();
  }

  redrawRow(row) {
    this.#dirty.add(row);
    this.#drawVisible();
  }

  /** Draws all rows, for paper. */
  drawEverything() {
    for (const row of this.#rows.values()) {
      row.draw(this.width);
      row.print?.();
    }
  }

  #onSight(entries) {
    for (const { target, isIntersecting } of entries) {
      const row = this.#rows.get(target);
      if (isIntersecting) this.#visible.add(row);
      else this.#visible.delete(row);
    }
    this.#drawVisible();
  }

  #drawVisible() {
    const { width } = this;
    if (width <= kGutter) return;
    for (const row of this.#dirty) {
      if (!this.#visible.has(row)) continue;
      row.draw(width);
      this.#dirty.delete(row);
    }
  }

  #placeLines() {
    for (const { seconds, line, mark } of this.failures) [line, mark].forEach((each) => this.#place(each, seconds));
    for (const line of [this.line, this.mark]) {
      this.#place(line, this.view.cursor);
      line.classList.toggle("held", this.view.isHeld);
    }
    this.clip.style.width = `${this.width}px`;
  }

  /** Moves a line to a time [s], or hides it if that is out of sight or null. */
  #place(line, seconds) {
    const share = seconds === null ? -1 : this.view.shareOf(seconds);
    line.hidden = !(share >= 0 && share <= 1);
    line.style.transform = `translateX(${kGutter + share * (this.width - kGutter)}px)`;
  }

  /** The time under the pointer [s], and whether the pointer is over drawings. */
  #timeAt(event) {
    const x = event.clientX - this.element.getBoundingClientRect().left;
    const share = (x - kGutter) / (this.width - kGutter);
    const time = this.view.from + Math.min(1, Math.max(0, share)) * this.view.span;
    return { x, time, isInside: x >= kGutter && x <= this.width };
  }

  #listen() {
    this.element.addEventListener("pointerdown", (event) => this.#onDown(event));
    this.element.addEventListener("pointermove", (event) => this.#onMove(event));
    this.element.addEventListener("pointerup", (event) => this.#onUp(event));
    this.element.addEventListener("pointercancel", () => this.#endDrag());
    this.element.addEventListener("pointerleave", () => this.#onLeave());
    this.element.addEventListener("dblclick", (event) => this.#onDoubleClick(event));
    this.element.addEventListener("wheel", (event) => this.#onWheel(event), { passive: false });
  }

  #onDown(event) {
    const place = this.#timeAt(event);
    const isPlot = event.target.closest(".plot") !== null && event.target.closest("button") === null;
    if (event.button !== 0 || !place.isInside || !isPlot) return;
    const isScrub = event.target.closest(".film-track") !== null;
    const kind = isScrub || event.pointerType === "touch" ? "scrub" : event.shiftKey ? "pan" : "zoom";
    this.drag = { kind, start: place, from: this.view.from, until: this.view.until };
    if (kind === "scrub") this.view.holdCursor(place.time);
    this.element.setPointerCapture(event.pointerId);
  }

  #onMove(event) {
    const place = this.#timeAt(event);
    if (!this.drag && hasOwnMouse(event)) return;
    if (!this.drag) {
      if (!this.view.isHeld) this.view.moveCursor(place.isInside ? place.time : null);
      return;
    }
    const { kind, start, from, until } = this.drag;
    if (kind === "scrub") this.view.holdCursor(place.time);
    if (kind === "zoom") this.#select(start.x, place.x);
    if (kind === "pan") {
      const shift = ((start.x - place.x) / (this.width - kGutter)) * (until - from);
      this.view.show(from + shift, until + shift);
    }
  }

  #onUp(event) {
    if (!this.drag) return;
    const { kind, start } = this.drag;
    const place = this.#timeAt(event);
    this.#endDrag();
    if (kind !== "zoom") return;
    if (Math.abs(place.x - start.x) < kClick) this.view.holdCursor(start.time);
    else this.view.show(Math.min(start.time, place.time), Math.max(start.time, place.time));
  }

  #onLeave() {
    if (!this.drag && !this.view.isHeld) this.view.moveCursor(null);
  }

  #endDrag() {
    this.drag = undefined;
    this.selection.hidden = true;
  }

  #select(one, other) {
    const left = Math.max(kGutter, Math.min(one, other));
    const right = Math.min(this.width, Math.max(one, other));
    this.selection.hidden = right - left < kClick;
    this.selection.style.left = `${left}px`;
    this.selection.style.width = `${Math.max(0, right - left)}px`;
  }

  #onDoubleClick(event) {
    if (this.#timeAt(event).isInside && !hasOwnMouse(event)) this.view.showWhole();
  }

  #onWheel(event) {
    const place = this.#timeAt(event);
    if (!place.isInside || hasOwnMouse(event) || !(event.ctrlKey || event.shiftKey)) return;
    event.preventDefault();
    const turn = event.deltaY || event.deltaX;
    if (event.ctrlKey) this.view.zoom(kWheel ** turn, place.time);
    else this.view.pan(turn / 1000);
  }
}
