// Activity of one unit over time: idle time shaded, events and early returns as ticks, rejections and rollbacks red.
import { endsOf, pixelsWith } from "../data/intervals.js";
import { briefText } from "../data/number_text.js";
import { h, sizedContext } from "../dom.js";
import { color } from "../plot/colors.js";
import { kGutter } from "../plot/layout.js";
import { shadeIntervals } from "../plot/shade.js";

const kHeight = 18;

/**
 * Drawn in this order; rare and important kinds last. Shares of the lane's height, from the top. A tick is where the
 * activity begins, that of an early return where the unit stopped.
 */
const kTicks = [
  { kind: "event", color: "--event", top: 0.45, bottom: 1 },
  { kind: "early return", color: "--early-return", top: 0, bottom: 0.45, isAtEnd: true },
  { kind: "undone", color: "--bad", top: 0, bottom: 1 },
  { kind: "rejection", color: "--bad", top: 0, bottom: 1 },
];

export class ActivityLane {
  constructor({ report, view }, component) {
    this.report = report;
    this.view = view;
    this.component = component;
    this.canvas = h("canvas", { role: "img" });
    this.box = h("div.activity-lane", {}, h("span.lane-name", { title: component }, component), this.canvas);
    this.update();
  }

  /** Takes what the report has now. */
  update() {
    this.activity = this.report.activity.get(this.component) ?? new Map();
    this.ticks = kTicks
      .filter(({ kind }) => this.activity.has(kind))
      .map((ticks) => {
        const intervals = this.activity.get(ticks.kind);
        return { ...ticks, instants: ticks.isAtEnd ? endsOf(intervals) : intervals };
      });
    this.canvas.setAttribute("aria-label", `${this.component}: ${this.summary}`);
  }

  /** As text: "idle 5.9 s, 1 event, 2 rejections". */
  get summary() {
    const parts = [];
    const idle = this.activity.get("idle");
    if (idle) parts.push(`idle ${briefText(idle.covered.at(-1))} s`);
    for (const { kind } of kTicks) {
      const count = this.activity.get(kind)?.count ?? 0;
      if (count > 0) parts.push(countText(kind, count));
    }
    return parts.join(", ") || "always stepped";
  }

  draw(width) {
    const plotted = width - kGutter;
    const context = sizedContext(this.canvas, plotted, kHeight);
    const box = { left: 0, top: 0, width: plotted, height: kHeight };
    context.fillStyle = color("--lane");
    context.fillRect(0, 0, plotted, kHeight);
    if (this.activity.has("idle")) shadeIntervals(context, this.activity.get("idle"), this.view, box, color("--idle"));
    for (const ticks of this.ticks) this.#drawTicks(context, ticks, plotted);
  }

  #drawTicks(context, { instants, color: name, top, bottom }, width) {
    context.fillStyle = color(name);
    for (const x of pixelsWith(instants, this.view, width)) {
      context.fillRect(x, Math.floor(top * kHeight), 1.5, Math.ceil((bottom - top) * kHeight));
    }
  }
}

function countText(kind, count) {
  if (kind === "undone") return `${count} undone ${count === 1 ? "step" : "steps"}`;
  return `${count.toLocaleString("en")} ${kind}${count === 1 ? "" : "s"}`;
}
