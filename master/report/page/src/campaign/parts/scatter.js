// Cases as points over two columns. Dragging selects those in a rectangle, a click leads to a case.
import { briefText } from "../../data/number_text.js";
import { h, sizedContext } from "../../dom.js";
import { color } from "../../plot/colors.js";
import { kDrawingOrder, kOutcomes } from "../data/outcomes.js";
import { axisTicks, axisTitle, fitted, fittedName } from "../plot/axis.js";
import { markPicture, rampColor } from "../plot/marks.js";
import { columnChoice } from "./choice.js";

const kHeight = 400;
const kLeft = 74;
const kBottom = 44;
const kTop = 10;
const kRight = 12;
const kShades = 32;
const kFont = "11px system-ui, sans-serif";
/** More points than these are dots. */
const kMostMarks = 20_000;
/** How near the pointer has to be to a point [px]. */
const kReach = 10;
/** A drag that is shorter is a click [px]. */
const kClick = 4;

/** Between -0.5 and 0.5, the same each time: cases of one category are side by side. */
const scattered = (row) => ((row * 0.6180339887498949) % 1) - 0.5;

const radiusOf = (count) => (count < 300 ? 4 : count < 3000 ? 3 : 2);

export class Scatter {
  constructor({ report, selection, tip, showCase }) {
    Object.assign(this, { report, selection, tip, showCase });
    const { parameters, aggregates, margins, times } = report;
    this.columns = [...parameters, ...aggregates, ...margins, ...times];
    const varying = parameters.filter((column) => column.varies);
    this.x = varying[0] ?? this.columns[0];
    this.y = aggregates[0] ?? varying[1] ?? times.at(-1) ?? this.x;
    this.shade = null;
    this.canvas = h("canvas", { role: "img" });
    this.frame = h("div.selection", { hidden: true });
    this.plot = h("div.plot", {}, this.canvas, this.frame);
    this.scale = h("p.note.scale-note", {});
    this.box = h(
      "section",
      { "aria-label": "Scatter" },
      h("h2", {}, "Each case as a point"),
      h("div.filter", {}, ...this.#choices()),
      this.plot,
      this.scale,
    );
    this.#listen();
    selection.addEventListener("change", () => this.redraw());
  }

  #choices() {
    const { columns } = this;
    const shown = (key) => (column) => {
      this[key] = column;
      this.redraw();
    };
    const numbers = columns.filter((column) => column.isNumber);
    return [
      columnChoice("x", columns, shown("x"), { chosen: this.x }),
      columnChoice("y", columns, shown("y"), { chosen: this.y }),
      columnChoice("colour", numbers, shown("shade"), { first: "outcome" }),
    ];
  }

  /** Draws when the browser does so next. */
  redraw() {
    this.due ??= requestAnimationFrame(() => {
      this.due = undefined;
      this.draw();
    });
  }

  draw() {
    this.width = this.plot.clientWidth;
    const pen = sizedContext(this.canvas, this.width, kHeight);
    this.#place();
    this.#drawAxes(pen);
    this.#drawPoints(pen);
    const count = this.selection.count.toLocaleString("en");
    this.canvas.setAttribute("aria-label", `${this.y.name} over ${this.x.name} of ${count} cases`);
    this.scale.textContent = [this.#shadeText(), this.#absentText()].filter(Boolean).join(" ");
  }

  #shadeText() {
    if (!this.shade) return "Drag to select a part, click on a point for its case.";
    const { name, least, most } = this.shade;
    return `From pale to strong: ${name} from ${briefText(least)} to ${briefText(most)}.`;
  }

  /** What is not known has no place. */
  #absentText() {
    let absent = 0;
    for (let i = 0; i < this.report.count; ++i) {
      if (this.selection.mask[i] && Number.isNaN(this.xs[i] + this.ys[i])) ++absent;
    }
    return absent === 0 ? "" : `Without a value here: ${absent.toLocaleString("en")}.`;
  }

  #place() {
    const { x, y, report, width } = this;
    this.xs = new Float32Array(report.count);
    this.ys = new Float32Array(report.count);
    const wide = x.isNumber ? 0 : 0.6;
    const high = y.isNumber ? 0 : 0.6;
    for (let i = 0; i < report.count; ++i) {
      this.xs[i] = kLeft + x.shareOf(x.values[i] + wide * scattered(i)) * (width - kLeft - kRight);
      this.ys[i] = kHeight - kBottom - y.shareOf(y.values[i] + high * scattered(i * 7)) * (kHeight - kTop - kBottom);
    }
  }

  #drawAxes(pen) {
    const [right, bottom] = [this.width - kRight, kHeight - kBottom];
    pen.font = kFont;
    pen.lineWidth = 1;
    pen.strokeStyle = color("--grid");
    pen.fillStyle = color("--quiet-text");
    pen.textAlign = "center";
    const room = this.x.isNumber ? 80 : 70;
    for (const { share, text } of axisTicks(this.x, Math.max(2, Math.floor((right - kLeft) / room)))) {
      const x = Math.round(kLeft + share * (right - kLeft)) + 0.5;
      pen.strokeRect(x, kTop, 0, bottom - kTop);
      pen.fillText(fitted(pen, text, room + 10), x, bottom + 15);
    }
    pen.textAlign = "right";
    pen.textBaseline = "middle";
    for (const { share, text } of axisTicks(this.y, 8)) {
      const y = Math.round(bottom - share * (bottom - kTop)) + 0.5;
      pen.strokeRect(kLeft, y, right - kLeft, 0);
      pen.fillText(fitted(pen, text, kLeft - 26), kLeft - 6, y);
    }
    pen.fillStyle = color("--text");
    pen.textAlign = "center";
    pen.fillText(fittedName(pen, axisTitle(this.x), right - kLeft), (kLeft + right) / 2, kHeight - 10);
    pen.save();
    pen.translate(9, (kTop + bottom) / 2);
    pen.rotate(-Math.PI / 2);
    pen.fillText(fittedName(pen, axisTitle(this.y), bottom - kTop), 0, 0);
    pen.restore();
  }

  #drawPoints(pen) {
    const { outcomes } = this.report.cases;
    const radius = radiusOf(this.report.count);
    const isHidden = this.selection.hidden;
    const others = markPicture("circle", radius * 0.7, color("--unselected"));
    this.#copy(pen, others, (i) => !this.selection.mask[i] && !isHidden.has(outcomes[i]));
    for (const outcome of kDrawingOrder) {
      const isDrawn = (i) => this.selection.mask[i] && outcomes[i] === outcome;
      const { mark, color: name } = kOutcomes[outcome];
      if (!this.shade) {
        pen.globalAlpha = outcome === 0 && this.report.count > 300 ? 0.6 : 0.9;
        this.#copy(pen, markPicture(mark, radius, color(name)), isDrawn);
        continue;
      }
      pen.globalAlpha = 1;
      const pictures = this.#shades(mark, radius);
      this.#copy(pen, (i) => pictures[this.#shadeOf(i)], isDrawn);
    }
    pen.globalAlpha = 1;
  }

  #shades(mark, radius) {
    const shades = Array.from({ length: kShades }, (_, i) => markPicture(mark, radius, rampColor(i / (kShades - 1))));
    return [...shades, markPicture("ring", radius, color("--missing"))];
  }

  #shadeOf(row) {
    const value = this.shade.values[row];
    if (Number.isNaN(value)) return kShades;
    return Math.round(this.shade.shareOf(value) * (kShades - 1));
  }

  #copy(pen, picture, isDrawn) {
    for (let i = 0; i < this.report.count; ++i) {
      if (!isDrawn(i) || !(this.xs[i] + this.ys[i] < Infinity)) continue;
      const { canvas, size, paint } = typeof picture === "function" ? picture(i) : picture;
      if (this.report.count > kMostMarks) {
        pen.fillStyle = paint;
        pen.fillRect(this.xs[i] - 1, this.ys[i] - 1, 2, 2);
        continue;
      }
      pen.drawImage(canvas, this.xs[i] - size / 2, this.ys[i] - size / 2, size, size);
    }
  }

  /** The selected case near a place, or -1. */
  nearest(x, y) {
    let found = -1;
    let least = kReach ** 2;
    for (let i = 0; i < this.report.count; ++i) {
      const distance = (this.xs[i] - x) ** 2 + (this.ys[i] - y) ** 2;
      if (!(distance <= least) || !this.selection.mask[i]) continue;
      [found, least] = [i, distance];
    }
    return found;
  }

  #listen() {
    let start = null;
    const at = (event) => {
      const box = this.plot.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    this.plot.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      start = at(event);
      this.plot.setPointerCapture(event.pointerId);
    });
    this.plot.addEventListener("pointermove", (event) => {
      const [x, y] = at(event);
      if (start) this.#showFrame(start, [x, y]);
      else this.#showTip(this.nearest(x, y), event);
    });
    this.plot.addEventListener("pointerup", (event) => {
      if (start) this.#end(start, at(event));
      start = null;
    });
    this.plot.addEventListener("pointercancel", () => {
      start = null;
      this.frame.hidden = true;
    });
    this.plot.addEventListener("pointerleave", () => this.tip.hide());
  }

  #showFrame([x, y], [toX, toY]) {
    const style = {
      left: Math.min(x, toX),
      top: Math.min(y, toY),
      width: Math.abs(toX - x),
      height: Math.abs(toY - y),
    };
    for (const [name, value] of Object.entries(style)) this.frame.style[name] = `${value}px`;
    this.frame.hidden = false;
  }

  #end([x, y], [toX, toY]) {
    this.frame.hidden = true;
    if (Math.hypot(toX - x, toY - y) < kClick) {
      const row = this.nearest(x, y);
      if (row >= 0) this.showCase(row);
      return;
    }
    const across = (place) => (place - kLeft) / (this.width - kLeft - kRight);
    const up = (place) => (kHeight - kBottom - place) / (kHeight - kTop - kBottom);
    const limits = (column, one, other) => [column.valueAt(Math.min(one, other)), column.valueAt(Math.max(one, other))];
    const [chosenX, chosenY] = [limits(this.x, across(x), across(toX)), limits(this.y, up(y), up(toY))];
    this.selection.brush(this.x, chosenX);
    if (this.y !== this.x) this.selection.brush(this.y, chosenY);
  }

  #showTip(row, event) {
    if (row < 0) return this.tip.hide();
    const { cases } = this.report;
    const shown = [...new Set([this.x, this.y, ...(this.shade ? [this.shade] : [])])];
    const anchor = {
      getBoundingClientRect: () => ({ left: event.clientX + 6, top: event.clientY, bottom: event.clientY }),
    };
    this.tip.show(anchor, [
      `case ${cases.indices[row]}: ${kOutcomes[cases.outcomes[row]].name}`,
      ...shown.map((column) => `${column.name} = ${column.textAt(row)}`),
      ...(cases.reasons[row] ? [cases.reasons[row].split("\n")[0]] : []),
    ]);
  }
}
