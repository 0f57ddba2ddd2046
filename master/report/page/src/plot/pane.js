// One pane: curves of one unit of measure, drawn by uPlot. Zoom, cursor and legend are the page's own, since all panes share
// them.
import uPlot from "uplot";
import { color, curveColor, curveDash } from "./colors.js";
import { kGutter } from "./layout.js";
import { timeTicks } from "./ruler.js";
import { finiteExtremes, intoRange, linearRange, logarithmicRange } from "./scale.js";
import { shadeIntervals } from "./shade.js";
import { groupTimes, groupValues, rowGroups } from "./thin.js";
import { commonExponent, powerText, ticks, valueTickTexts } from "./ticks.js";

const kHeight = 132;
const kFont = "11px system-ui, sans-serif";
/** Pixels between the numbers of the vertical axis, at least. */
const kTickDistance = 24;

export class Pane {
  /**
   * @param {object} context report and view
   * @param {import("../data/report.js").Column[]} columns of one unit of measure
   * @param {boolean} isLogarithmic
   */
  constructor({ report, view }, columns, isLogarithmic) {
    this.report = report;
    this.view = view;
    this.columns = columns;
    this.hidden = new Set();
    this.highlighted = null;
    this.isLogarithmic = isLogarithmic;
    this.range = [0, 1];
    this.exponent = 0;
    this.box = document.createElement("div");
    this.box.className = "pane-canvas";
  }

  /** Draws what is shown now. @param {number} width [px] */
  draw(width) {
    if (!this.plot) this.#create(width);
    else if (this.plot.width !== width) this.plot.setSize({ width, height: kHeight });
    const plotted = width - kGutter;
    const { seconds } = this.report;
    const groups = rowGroups(seconds, this.view.from, this.view.until, plotted * (window.devicePixelRatio || 1));
    const drawn = this.columns.map((column) => (this.hidden.has(column) ? [] : groupValues(column.pyramid, groups)));
    this.#fit(drawn);
    this.pointCount = groups.length === 0 ? 0 : Math.max(0, ...drawn.map((values) => values.length));
    const times = groupTimes(seconds, groups);
    const curves = drawn.map((values) => (values.length > 0 ? intoRange(values, this.range) : times.map(() => null)));
    this.plot.batch(() => {
      this.plot.setData([times, ...curves], false);
      this.plot.setScale("x", { min: this.view.from, max: this.view.until });
      this.plot.setScale("y", { min: this.range[0], max: this.range[1] });
    });
  }

  setLogarithmic(isLogarithmic) {
    this.isLogarithmic = isLogarithmic;
    this.plot?.destroy();
    this.plot = undefined;
  }

  /** Brings one curve to the front, or none. */
  highlight(column) {
    this.highlighted = column;
    this.plot?.redraw(false);
  }

  #fit(drawn) {
    const extremes = finiteExtremes(drawn);
    this.range = this.isLogarithmic ? logarithmicRange(extremes) : linearRange(extremes);
    const largest = Math.max(Math.abs(extremes.least), Math.abs(extremes.most));
    this.exponent = this.isLogarithmic ? 0 : commonExponent(Number.isFinite(largest) ? largest : 0);
  }

  /** What stands over the vertical axis. */
  get axisLabel() {
    const { unit } = this.columns[0];
    return this.exponent === 0 ? unit : `${powerText(this.exponent)}${unit ? ` ${unit}` : ""}`;
  }

  #create(width) {
    const options = {
      width,
      height: kHeight,
      padding: [10, 0, 6, 0],
      legend: { show: false },
      cursor: { show: false },
      scales: {
        x: { time: false, auto: false },
        y: { auto: false, distr: this.isLogarithmic ? 3 : 1 },
      },
      axes: [this.#timeAxis(), this.#valueAxis()],
      series: [{}, ...this.columns.map((column, index) => this.#series(column, index))],
      hooks: { drawClear: [(plot) => this.#shadeIdleTime(plot)], draw: [(plot) => this.#nameAxis(plot)] },
    };
    this.plot = new uPlot(options, [[], ...this.columns.map(() => [])], this.box);
  }

  #timeAxis() {
    return {
      size: 0,
      ticks: { show: false },
      grid: { stroke: () => color("--grid"), width: 1 },
      splits: (plot) => timeTicks(this.view, plot.width - kGutter).values,
      values: (plot, splits) => splits.map(() => null),
    };
  }

  #valueAxis() {
    return {
      size: kGutter,
      gap: 6,
      font: kFont,
      stroke: () => color("--quiet-text"),
      ticks: { show: false },
      grid: { stroke: () => color("--grid"), width: 1 },
      splits: () => (this.isLogarithmic ? decades(this.range) : ticks(...this.range, kHeight / kTickDistance - 1).values),
      filter: (plot, splits) => splits,
      values: (plot, splits) =>
        this.isLogarithmic
          ? splits.map((value) => powerText(Math.round(Math.log10(value))))
          : valueTickTexts(splits, this.exponent),
    };
  }

  #series(column, index) {
    const isFaint = () => this.highlighted !== null && this.highlighted !== column;
    return {
      scale: "y",
      width: 1.5,
      stroke: () => color(curveColor(index)) + (isFaint() ? "40" : ""),
      dash: curveDash(index),
      points: { show: false },
      paths: column.stepped ? uPlot.paths.stepped({ align: 1 }) : uPlot.paths.linear(),
    };
  }

  #shadeIdleTime({ ctx, bbox }) {
    shadeIntervals(ctx, this.report.idle, this.view, bbox, color("--idle-shade"));
  }

  #nameAxis({ ctx, bbox }) {
    const ratio = window.devicePixelRatio || 1;
    ctx.save();
    ctx.font = `${11 * ratio}px system-ui, sans-serif`;
    ctx.fillStyle = color("--quiet-text");
    ctx.textAlign = "left";
    ctx.textBaseline = "top";
    ctx.fillText(this.axisLabel, 2 * ratio, bbox.top - 4 * ratio);
    ctx.restore();
  }
}

function decades([bottom, top]) {
  const first = Math.round(Math.log10(bottom));
  const last = Math.round(Math.log10(top));
  const step = Math.max(1, Math.ceil((last - first) / (kHeight / kTickDistance - 1)));
  const found = [];
  for (let exponent = first; exponent <= last; exponent += step) found.push(10 ** exponent);
  return found;
}
