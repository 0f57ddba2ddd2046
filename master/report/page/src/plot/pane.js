// One pane: curves of one unit of measure, drawn by uPlot. Zoom, cursor and legend are the page's own, since all panes
// share them.
import uPlot from "uplot";
import { numberText } from "../data/number_text.js";
import { color, curveColor, curveDash } from "./colors.js";
import { kGutter } from "./layout.js";
import { drawLimits, limitsOf, shadeBeyond, shadeViolations, withLimits } from "./limits.js";
import { timeTicks } from "./ruler.js";
import { finiteExtremes, hasNothingNegative, hasPositive, isMostlySmall } from "./scale.js";
import { shadeIntervals } from "./shade.js";
import { groupTimes, groupValues, rowGroups } from "./thin.js";
import { trace, Tracer } from "./trace.js";
import { powerText } from "./ticks.js";
import { LinearAxis, LogarithmicAxis } from "./value_axis.js";

const kHeight = 132;
const kFont = "11px system-ui, sans-serif";
/** Width of curves [px]. */
const kLine = 1.5;
/** Samples are drawn as dots if they are this far apart at least [px]. */
const kDotDistance = 14;
/** uPlot draws no data itself. */
const kNothing = [null, null];

const isWholeNumber = ({ type }) => !type.startsWith("Float");

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
    const isWhole = columns.every(isWholeNumber);
    this.canBeLogarithmic = !isWhole && columns.some(hasPositive);
    this.isLogarithmic = this.canBeLogarithmic && columns.every(hasNothingNegative) && columns.some(isMostlySmall);
    /** Whether each curve has its own scale, which makes curves of very different sizes visible together. */
    this.hasOwnScales = false;
    /** That of each column: the same for all, unless they have their own. */
    this.axes = columns.map(() => new LinearAxis({ least: 0, most: 1 }, isWhole));
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
    this.#collect(plotted * (window.devicePixelRatio || 1));
    this.#fit(this.drawn.map(({ values }) => values));
    this.plot.batch(() => {
      this.plot.setData([[this.view.from, this.view.until], ...this.columns.map(() => kNothing)], false);
      this.plot.setScale("x", { min: this.view.from, max: this.view.until });
      this.plot.setScale("y", { min: 0, max: 1 });
      this.plot.redraw(false, true); // the ticks, though uPlot's own scale stays the same
    });
  }

  /** Brings one curve to the front, or none. */
  highlight(column) {
    this.highlighted = column;
    this.plot?.redraw(false, this.hasOwnScales);
  }

  /** The points of each curve. Columns of one run have the same instants. @param {number} pixels of the drawing */
  #collect(pixels) {
    const instants = new Map();
    const instantsOf = ({ seconds }) => {
      if (!instants.has(seconds)) {
        const groups = rowGroups(seconds, this.view.from, this.view.until, pixels);
        instants.set(seconds, { groups, times: groupTimes(seconds, groups) });
      }
      return instants.get(seconds);
    };
    this.drawn = this.columns.map((column) => {
      const { groups, times } = instantsOf(column);
      return { groups, times, values: this.hidden.has(column) ? [] : groupValues(column.pyramid, groups) };
    });
  }

  #fit(drawn) {
    const limitsOf = (column) => (this.hidden.has(column) ? [] : this.limits.get(column));
    if (this.hasOwnScales) {
      this.axes = this.columns.map((column, i) => this.#axisOf([drawn[i]], limitsOf(column), isWholeNumber(column)));
      return;
    }
    const axis = this.#axisOf(drawn, this.columns.flatMap(limitsOf), this.columns.every(isWholeNumber));
    this.axes = this.columns.map(() => axis);
  }

  #axisOf(drawn, limits, isWhole) {
    const extremes = withLimits(finiteExtremes(drawn), limits, this.isLogarithmic);
    return this.isLogarithmic ? new LogarithmicAxis(extremes) : new LinearAxis(extremes, isWhole);
  }

  /** The axis whose ticks are shown: if all have their own, that of the highlighted curve. */
  get #shownAxis() {
    if (!this.hasOwnScales) return this.axes[0];
    return this.axes[this.columns.indexOf(this.highlighted)] ?? null;
  }

  /** The label above the vertical axis. */
  get axisLabel() {
    const axis = this.#shownAxis;
    if (axis === null) return "own scales";
    const { unit } = this.columns[0];
    const scale = axis.exponent === 0 ? "" : powerText(axis.exponent);
    if (axis.offset === 0) return [scale, unit].filter(Boolean).join(" ");
    return `${numberText(axis.offset)} + ${scale || "…"}${unit ? ` ${unit}` : ""}`;
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
        y: { auto: false },
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
      splits: () => (this.#shownAxis?.ticks ?? []).map(({ share }) => share),
      filter: (plot, splits) => splits,
      values: () => (this.#shownAxis?.ticks ?? []).map(({ text }) => text),
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
    if (points.values.length > 0) trace(tracer, points, places(bbox, scales, this.axes[index]));
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
    this.#shadeBelow(ctx, bbox);
    for (const [column, axis] of this.#shownColumns()) {
      const limits = this.limits.get(column);
      shadeViolations(ctx, limits, this.view, bbox, { ground: color("--bad-ground"), bad: color("--bad") });
      shadeBeyond(ctx, limits, bbox, places(bbox, scales, axis), color("--bad"));
    }
  }

  /** The places of zeros and negative values look different from the decades above. */
  #shadeBelow(ctx, { left, top, width, height }) {
    const below = Math.round((this.#shownAxis?.below ?? 0) * height);
    ctx.save();
    ctx.fillStyle = color("--lane");
    ctx.fillRect(left, top + height - below, width, below);
    ctx.restore();
  }

  /** Those that are not hidden, each with its axis. */
  #shownColumns() {
    return this.columns.map((column, i) => [column, this.axes[i]]).filter(([column]) => !this.hidden.has(column));
  }

  #drawLimits({ ctx, bbox, scales }) {
    const colorOf = ({ isFailed }) => color(isFailed ? "--bad" : "--quiet-text");
    for (const [column, axis] of this.#shownColumns()) {
      drawLimits(ctx, this.limits.get(column), bbox, places(bbox, scales, axis), colorOf);
    }
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

/** The positions of times and values in the picture [device px], and whether a value has one. */
function places(bbox, { x }, axis) {
  return {
    x: (time) => bbox.left + ((time - x.min) / (x.max - x.min)) * bbox.width,
    y: (value) => bbox.top + (1 - axis.shareOf(value)) * bbox.height,
    has: (value) => axis.has(value),
  };
}
