// Parallel coordinates: an axis for each column, a line for each case. A brush on an axis selects.
import { h, sizedContext } from "../../dom.js";
import { color } from "../../plot/colors.js";
import { kOutcomes } from "../data/outcomes.js";
import { axisTicks, axisTitle, fitted, fittedName } from "../plot/axis.js";
import { Brush } from "./brush.js";

const kHeight = 340;
const kTop = 40;
const kBottom = 14;
const kSide = 70;
const kRoom = 110;
const kFont = "11px system-ui, sans-serif";
const kMostAxes = 30;
/** More lines than these are no picture. */
const kMostLines = 20_000;
/** Lines that are drawn at once: more are faster, fewer show better how many lines there are. */
const kAtOnce = 20;

const kInner = kHeight - kTop - kBottom;

/** How much a line covers what is below it: the more lines, the less. */
const opacity = (count) => Math.min(0.85, Math.max(0.03, 130 / (count + 1)));

/** Rows that are drawn at once, in one colour. */
function bundled(rows, name) {
  const alpha = opacity(rows.length);
  const bundles = [];
  for (let first = 0; first < rows.length; first += kAtOnce) {
    bundles.push({ rows: rows.slice(first, first + kAtOnce), name, alpha });
  }
  return bundles;
}

export class Parallel {
  constructor({ report, selection }) {
    Object.assign(this, { report, selection });
    const all = [...report.parameters, ...report.aggregates, ...report.times].filter((column) => column.varies);
    this.columns = all.slice(0, kMostAxes);
    this.step = Math.ceil(report.count / kMostLines);
    this.canvas = h("canvas", { role: "img" });
    this.brushes = this.columns.map((column) => new Brush(column, selection, kTop, kInner));
    this.plot = h("div.plot.parallel", {}, this.canvas, ...this.brushes.map(({ box }) => box));
    const left = all.length - this.columns.length;
    this.box = h(
      "section",
      { "aria-label": "Parallel coordinates" },
      h("h2", {}, "All at once"),
      h(
        "p.note",
        {},
        "A line for each case. Drag along an axis to select, click on it to release.",
        this.step > 1 ? ` Each ${this.step}th case is drawn.` : "",
        left > 0 ? ` ${left} further columns are left out.` : "",
      ),
      h("div.scroll", {}, this.plot),
      h(
        "details.by-values",
        {},
        h("summary", {}, "Select by values"),
        h("div.fields", {}, ...this.brushes.map(({ fields }) => fields.box)),
      ),
    );
    selection.addEventListener("change", () => this.redraw());
  }

  redraw() {
    this.due ??= requestAnimationFrame(() => {
      this.due = undefined;
      this.draw();
    });
  }

  draw() {
    const { columns } = this;
    const room = this.plot.parentElement.clientWidth;
    this.width = Math.max(room, 2 * kSide + (columns.length - 1) * kRoom);
    const pen = sizedContext(this.canvas, this.width, kHeight);
    const gap = columns.length > 1 ? (this.width - 2 * kSide) / (columns.length - 1) : 0;
    this.places = columns.map((_, i) => (columns.length > 1 ? kSide + i * gap : this.width / 2));
    this.#drawLines(pen);
    this.#drawAxes(pen, Math.max(gap, kRoom) - 10);
    this.brushes.forEach((brush, i) => brush.place(this.places[i]));
    const words = `${this.selection.count.toLocaleString("en")} cases over ${columns.map(({ name }) => name).join(", ")}`;
    this.canvas.setAttribute("aria-label", words);
  }

  #drawLines(pen) {
    const { report, selection, columns, step } = this;
    const { outcomes } = report.cases;
    const shares = columns.map((column) => {
      const [bottom, top] = column.range;
      return { values: column.values, bottom, scale: kInner / (top - bottom) };
    });
    const rows = (isDrawn) => {
      const found = [];
      for (let i = 0; i < report.count; i += step) if (isDrawn(i)) found.push(i);
      return found;
    };
    if (!selection.isWhole) {
      const others = rows((i) => !selection.mask[i] && !selection.hidden.has(outcomes[i]));
      this.#stroke(pen, bundled(others, "--unselected"), shares);
    }
    const bundles = kOutcomes.flatMap(({ color }, outcome) =>
      bundled(
        rows((i) => selection.mask[i] && outcomes[i] === outcome),
        color,
      ),
    );
    this.#stroke(pen, bundles, shares);
    pen.globalAlpha = 1;
  }

  /** In the order of the cases, so that no outcome hides another one. */
  #stroke(pen, bundles, shares) {
    pen.lineWidth = 1;
    for (const { rows, name, alpha } of bundles.sort((a, b) => a.rows[0] - b.rows[0])) {
      pen.strokeStyle = color(name);
      pen.globalAlpha = alpha;
      pen.beginPath();
      for (const row of rows) this.#trace(pen, row, shares);
      pen.stroke();
    }
  }

  /** A gap where a value is not known. */
  #trace(pen, row, shares) {
    let isOpen = false;
    shares.forEach(({ values, bottom, scale }, i) => {
      const value = values[row];
      if (Number.isNaN(value)) return void (isOpen = false);
      const y = kTop + kInner - Math.min(kInner, Math.max(0, (value - bottom) * scale));
      if (isOpen) pen.lineTo(this.places[i], y);
      else pen.moveTo(this.places[i], y);
      isOpen = true;
    });
  }

  #drawAxes(pen, room) {
    pen.font = kFont;
    pen.textBaseline = "middle";
    this.columns.forEach((column, i) => {
      const x = Math.round(this.places[i]) + 0.5;
      pen.strokeStyle = color("--quiet-text");
      pen.lineWidth = 1;
      pen.strokeRect(x, kTop, 0, kInner);
      pen.textAlign = "left";
      pen.lineWidth = 4;
      pen.lineJoin = "round";
      for (const { share, text } of axisTicks(column, 6)) {
        const y = kTop + kInner * (1 - share);
        const short = fitted(pen, text, Math.min(room - 12, 90));
        pen.strokeStyle = color("--page");
        pen.strokeText(short, x + 6, y);
        pen.fillStyle = color("--quiet-text");
        pen.fillText(short, x + 6, y);
        pen.fillRect(x - 3, Math.round(y), 6, 1);
      }
      pen.fillStyle = color("--text");
      pen.textAlign = "center";
      pen.fillText(
        fittedName(pen, axisTitle(column), Math.min(room, 2 * kSide - 6)),
        x,
        14 + (i % 2 && room < 130 ? 14 : 0),
      );
    });
  }
}
