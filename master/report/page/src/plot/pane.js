// One pane: curves of one unit of measure, drawn by uPlot. Zoom, cursor and legend are the page's own, since all panes
// share them.
import uPlot from "uplot";
import { color, curveColor, curveDash } from "./colors.js";
import { kGutter } from "./layout.js";
import { drawLimits, limitsOf, shadeBeyond, shadeViolations, withLimits } from "./limits.js";
import { timeTicks } from "./ruler.js";
import {
  finiteExtremes,
  hasNothingNegative,
  intoRange,
  isMostlySmall,
  linearRange,
  logarithmicRange,
} from "./scale.js";
import { shadeIntervals } from "./shade.js";
import { groupTimes, groupValues, rowGroups } from "./thin.js";
import { trace, Tracer } from "./trace.js";
import { commonExponent, powerText, ticks, valueTickTexts } from "./ticks.js";

const kHeight = 132;
const kFont = "11px system-ui, sans-serif";
/** Width of curves [px]. */
const kLine = 1.5;
/** Samples are drawn as dots if they are this far apart at least [px]. */
const kDotDistance = 14;
/** uPlot draws no data itself. */
const kNothing = [null, null];
/** The maximum number of ticks on the vertical axis. */
const kMostTicks = 6;

export class Pane {
  /**
   * @param {object} context report and view
   * @param {import("../data/report.js").Column[]} columns of one unit of measure
   * @param {number} firstColor of its curves; the colours before it are those of the panes above
   */
  constructor({ report, view }, columns, firstColor) {
    this.report = report;
    this.view = view;
    this.columns = columns;
    this.limits = new Map(columns.map((column) => [column, limitsOf(report, column)]));
    this.firstColor = firstColor;
    this.hidden = new Set();
    this.highlighted = null;
    /** Whether all values are whole numbers. */
    this.isWhole = columns.every(({ type }) => !type.startsWith("Float"));
    this.canBeLogarithmic = !this.isWhole && columns.every(hasNothingNegative);
    this.isLogarithmic = this.canBeLogarithmic && columns.some(isMostlySmall);
    this.range = [0, 1];
    this.exponent = 0;
    /** The drawing of each curve: its points, and the bars made of them. */
    this.drawn = columns.map(() => ({ groups: [], times: [], values: [] }));
    this.bars = [];
    this.box = document.createElement("div");
    this.box.className = "pane-canvas";
  }

  /** Draws the present view. @param {number} width [px] */
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
    this.drawn = drawn.map((values) => ({ groups, times, values: intoRange(values, this.range) }));
    this.plot.batch(() => {
      this.plot.setData([[this.view.from, this.view.until], ...drawn.map(() => kNothing)], false);
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
    const values = finiteExtremes(drawn);
    const extremes = this.isLogarithmic ? values : withLimits(values, this.#shownLimits());
    this.range = this.isLogarithmic ? logarithmicRange(extremes) : linearRange(extremes);
    const largest = Math.max(Math.abs(extremes.least), Math.abs(extremes.most));
    this.exponent = this.isLogarithmic ? 0 : commonExponent(Number.isFinite(largest) ? largest : 0);
  }

  /** The label above the vertical axis. */
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
      series: [{}, ...this.columns.map((column, index) => this.#series(index))],
      hooks: {
        drawClear: [(plot) => this.#shade(plot)],
        drawSeries: [(plot, series) => this.#fillBars(plot, series - 1)],
        draw: [(plot) => this.#drawLimits(plot), (plot) => this.#nameAxis(plot)],
      },
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
      splits: () =>
        this.isLogarithmic ? decades(this.range) : ticks(...this.range, kMostTicks, this.isWhole ? 1 : 0).values,
      filter: (plot, splits) => splits,
      values: (plot, splits) =>
        this.isLogarithmic
          ? splits.map((value) => powerText(Math.round(Math.log10(value))))
          : valueTickTexts(splits, this.exponent),
    };
  }

  #series(index) {
    return {
      scale: "y",
      width: kLine,
      stroke: () => this.#curveColor(index),
      dash: curveDash(index),
      points: { show: false },
      paths: (plot) => this.#paths(plot, index),
    };
  }

  /** uPlot provides positions, scales and axes; so many rows are drawn by our own code. */
  #paths({ bbox, scales }, index) {
    const ratio = window.devicePixelRatio || 1;
    const points = this.drawn[index];
    const line = new Path2D();
    const bars = (this.bars[index] = []);
    const sink = {
      moveTo: (x, y) => line.moveTo(x, y),
      lineTo: (x, y) => line.lineTo(x, y),
      rect: (...box) => bars.push(box.map(Math.round)),
    };
    const hasDots = points.groups.length / 2 < bbox.width / (kDotDistance * ratio);
    const tracer = new Tracer(sink, { isStepped: this.columns[index].stepped, hasDots, width: kLine * ratio });
    if (points.values.length > 0) trace(tracer, points, places(bbox, scales, this.isLogarithmic));
    return { stroke: line, fill: null, clip: null, band: null, gaps: null, flags: 0 };
  }

  /** Filled one by one, because a browser takes much longer to fill them all as one path. */
  #fillBars({ ctx, bbox }, index) {
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    ctx.fillStyle = this.#curveColor(index);
    for (const box of this.bars[index] ?? []) ctx.fillRect(...box);
    ctx.restore();
  }

  #curveColor(index) {
    const isFaint = this.highlighted !== null && this.highlighted !== this.columns[index];
    return color(curveColor(this.firstColor + index)) + (isFaint ? "40" : "");
  }

  #shade({ ctx, bbox, scales }) {
    shadeIntervals(ctx, this.report.idle, this.view, bbox, color("--idle-shade"));
    const limits = this.#shownLimits();
    shadeViolations(ctx, limits, this.view, bbox, { ground: color("--bad-ground"), bad: color("--bad") });
    shadeBeyond(ctx, limits, bbox, places(bbox, scales, this.isLogarithmic), color("--bad"));
  }

  /** Of the curves that are not hidden. */
  #shownLimits() {
    return this.columns.filter((column) => !this.hidden.has(column)).flatMap((column) => this.limits.get(column));
  }

  #drawLimits({ ctx, bbox, scales }) {
    const place = places(bbox, scales, this.isLogarithmic);
    const colorOf = ({ isFailed }) => color(isFailed ? "--bad" : "--quiet-text");
    drawLimits(ctx, this.#shownLimits(), bbox, place, colorOf);
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

/** The positions of times and values in the picture [device px]. */
function places(bbox, { x, y }, isLogarithmic) {
  const measure = isLogarithmic ? Math.log10 : (value) => value;
  const [bottom, top] = [measure(y.min), measure(y.max)];
  return {
    x: (time) => bbox.left + ((time - x.min) / (x.max - x.min)) * bbox.width,
    y: (value) => bbox.top + (1 - (measure(value) - bottom) / (top - bottom)) * bbox.height,
  };
}

function decades([bottom, top]) {
  const first = Math.round(Math.log10(bottom));
  const last = Math.round(Math.log10(top));
  const step = Math.max(1, Math.ceil((last - first) / kMostTicks));
  const found = [];
  for (let exponent = first; exponent <= last; exponent += step) found.push(10 ** exponent);
  return found;
}
