// Rows of states, one for each signal: a bar while a Boolean is true, boxes with the values of a text.
import { nameWithin } from "../data/components.js";
import { sizedContext } from "../dom.js";
import { color, curveColor } from "./colors.js";
import { kGutter } from "./layout.js";
import { limitsOf, shadeViolations } from "./limits.js";
import { rowGroups } from "./thin.js";

const kRow = 20;
const kBar = 12;
const kFont = "11px system-ui, sans-serif";
/** A text is shown if its box has this width at least [px]. */
const kTextRoom = 24;

export class StatesPane {
  /** @param {import("../data/report.js").Column[]} columns Booleans and texts @param {number} firstColor of the bars */
  constructor({ report, view }, columns, firstColor) {
    this.report = report;
    this.view = view;
    this.columns = columns;
    this.limits = new Map(columns.map((column) => [column, limitsOf(report, column)]));
    this.components = new Set(report.units);
    this.firstColor = firstColor;
    this.hidden = new Set();
    this.box = document.createElement("canvas");
    this.box.className = "states-canvas";
  }

  highlight() {}

  /** @param {number} width [px] */
  draw(width) {
    const shown = this.columns.filter((column) => !this.hidden.has(column));
    const context = sizedContext(this.box, width, shown.length * kRow + 8);
    context.font = kFont;
    shown.forEach((column, row) => this.#drawRow(context, column, row * kRow + 4, width));
  }

  #drawRow(context, column, top, width) {
    const scale = (width - kGutter) / this.view.span;
    const place = (time) => Math.min(width, Math.max(kGutter, kGutter + (time - this.view.from) * scale));
    this.#drawName(context, column, top, width);
    const row = { left: kGutter, top, width: width - kGutter, height: kRow };
    shadeViolations(context, this.limits.get(column), this.view, row, {
      ground: color("--bad-ground"),
      bad: color("--bad"),
    });
    const middle = { top: top + (kRow - kBar) / 2, height: kBar };
    const groups = rowGroups(column.seconds, this.view.from, this.view.until, width - kGutter);
    for (const state of states(column, groups)) {
      const box = { ...middle, left: place(state.from), right: place(state.until ?? this.view.whole.until) };
      if (column.texts) drawText(context, box, state, column);
      else drawBoolean(context, box, state, curveColor(this.firstColor));
    }
  }

  #drawName(context, column, top, width) {
    const name = nameWithin(column.name, this.components);
    context.fillStyle = color("--grid");
    context.fillRect(kGutter, top + kRow / 2 + kBar / 2, width - kGutter, 1);
    context.fillStyle = color("--quiet-text");
    context.textAlign = "right";
    context.textBaseline = "middle";
    context.fillText(shortened(context, name, kGutter - 10), kGutter - 6, top + kRow / 2);
  }
}

/**
 * The consecutive states: the value, or that there are several within one pixel.
 * @returns {{from: number, until?: number, value: number, isMixed: boolean}[]}
 */
export function states(column, groups) {
  const { seconds } = column;
  const found = [];
  for (let g = 0; g < groups.length; g += 2) {
    const { least, most } = column.pyramid.extremes(groups[g], groups[g + 1]);
    const value = column.values[groups[g + 1] - 1];
    append(found, { from: seconds[groups[g]], value: least === most ? least : value, isMixed: least !== most });
    const last = found.at(-1);
    if (last.isMixed) append(found, { from: seconds[groups[g + 1] - 1], value, isMixed: false });
  }
  return found;
}

function append(found, state) {
  const last = found.at(-1);
  if (last && !last.isMixed && !state.isMixed && last.value === state.value) return;
  if (last) last.until = state.from;
  found.push(state);
}

function drawBoolean(context, { left, right, top, height }, { value, isMixed }, colorName) {
  if (!isMixed && !value) return;
  context.fillStyle = color(isMixed ? "--quiet-text" : colorName);
  context.fillRect(left, top, Math.max(1, right - left), height);
}

function drawText(context, { left, right, top, height }, { value, isMixed }, column) {
  const width = Math.max(1, right - left);
  context.fillStyle = color(isMixed ? "--quiet-text" : "--state");
  context.fillRect(left, top, width, height);
  context.fillStyle = color("--text");
  context.fillRect(left, top, 1, height);
  if (width < kTextRoom || isMixed) return;
  context.textAlign = "left";
  context.textBaseline = "middle";
  context.fillText(shortened(context, column.texts[value], width - 8), left + 4, top + height / 2 + 0.5);
}

/** The part of a text that fits. */
export function shortened(context, text, room) {
  if (context.measureText(text).width <= room) return text;
  let end = text.length;
  while (end > 0 && context.measureText(`${text.slice(0, end)}…`).width > room) --end;
  return end > 0 ? `${text.slice(0, end)}…` : "";
}
