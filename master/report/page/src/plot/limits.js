// The limits of the checks of a signal: dashed lines as long as they hold, and shades where they are violated.
import { Intervals, pixelsWith } from "../data/intervals.js";
import { shadeIntervals } from "./shade.js";

/** Where a violation begins there is a line of this width, however short it is [px]. */
const kOnset = 2;
/** Opacities over what is beneath. */
const kOnsetOpacity = 0.35;
const kBeyondOpacity = 0.07;
/** A limit that holds at one instant is a line of this length [px]. */
const kShortest = 14;

/**
 * @typedef {object} Limits of a check
 * @property {string} name
 * @property {boolean} isFailed
 * @property {number[]} lines
 * @property {{least: number, most: number}|null} allowed values are in it; null if they are outside of it, or no numbers
 * @property {number} from [s]
 * @property {number} until [s]
 * @property {Intervals} violated
 */

/** @returns {Limits[]} those of all checks of a column */
export function limitsOf({ run, seconds, whole }, column) {
  const checks = (run.checks ?? []).filter(({ limits }) => limits?.signal === column.name);
  return checks.map((check) => {
    const until = check.limits.to ?? whole.until;
    const from = check.kind === "final" ? until : (check.limits.from ?? whole.from);
    const times = { from, until };
    return {
      name: check.name ?? "",
      isFailed: check.passed === false,
      lines: column.isState ? [] : linesOf(check.limits),
      allowed: column.isState || check.kind === "never" ? null : allowedBy(check.limits),
      ...times,
      violated: new Intervals(...violations(check, column, seconds, times)),
    };
  });
}

function linesOf({ min, max, above, below, equals, tolerance }) {
  const around = tolerance ? [equals - tolerance, equals + tolerance] : [equals];
  return [min, max, above, below, ...around].filter(Number.isFinite);
}

function allowedBy({ min, max, above, below, equals, tolerance = 0 }) {
  const finite = (values, other) => values.filter(Number.isFinite).concat(other);
  return {
    least: Math.max(...finite([min, above, equals - tolerance], -Infinity)),
    most: Math.min(...finite([max, below, equals + tolerance], Infinity)),
  };
}

/** Whether a row's value is as the condition has it; NaN never is. */
function condition({ min = -Infinity, max = Infinity, above, below, equals, tolerance = 0 }, column) {
  if (column.texts) return (value) => column.texts[value] === equals;
  if (column.type === "Boolean") return (value) => Boolean(value) === equals;
  const exact = column.type === "Float32" ? Math.fround : (value) => value;
  return (value) => {
    const number = exact(value);
    if (!(number >= min && number <= max) || number <= above || number >= below) return false;
    return equals === undefined || Math.abs(number - equals) <= tolerance;
  };
}

/** The beginnings and ends of what a check has failed by: from the sample that is not as it should be to the next. */
function violations({ kind, passed, limits }, column, seconds, { from, until }) {
  if (passed !== false) return [[], []];
  if (kind === "final") return [[until], [until]];
  if (kind === "eventually") return [[from], [until]];
  const holds = condition(limits, column);
  const isBad = kind === "never" ? (value) => holds(value) || Number.isNaN(value) : (value) => !holds(value);
  const [starts, ends] = [[], []];
  for (let i = 0; i < seconds.length && seconds[i] <= until; ++i) {
    if (seconds[i] < from || !isBad(column.values[i])) continue;
    if (ends.at(-1) !== seconds[i]) starts.push(seconds[i]);
    else ends.pop();
    ends.push(Math.min(until, seconds[i + 1] ?? seconds[i]));
  }
  return [starts, ends];
}

/**
 * The range of values that a pane shows, with the limits that have failed, and those that are no further away than the
 * values are apart; on a logarithmic axis no further than a decade.
 */
export function withLimits(extremes, limits, isLogarithmic = false) {
  const { least, most, leastPositive } = extremes;
  if (!(least <= most)) return extremes;
  const isNear = (isLogarithmic ? nearDecades : near)(extremes);
  const shown = limits.flatMap(({ lines, isFailed }) => lines.filter((line) => isFailed || isNear(line)));
  return {
    least: Math.min(least, ...shown),
    most: Math.max(most, ...shown),
    leastPositive: Math.min(leastPositive, ...shown.filter((line) => line > 0)),
  };
}

function near({ least, most }) {
  const reach = most - least || Math.max(Math.abs(least), Math.abs(most)) || 1;
  return (line) => line >= least - reach && line <= most + reach;
}

/** No further than a decade, and zero where there are zeros. */
function nearDecades({ least, most, leastPositive }) {
  return (line) => (line > 0 ? line >= leastPositive / 10 && line <= most * 10 : line >= least);
}

/** @param {{ground: string, bad: string}} colors behind violations, and where they begin */
export function shadeViolations(context, limits, view, box, colors) {
  for (const { violated } of limits) {
    shadeIntervals(context, violated, view, box, colors.ground);
    markOnsets(context, violated, view, box, colors.bad);
  }
}

/** So that a violation of one sample in a million can be seen. */
function markOnsets(context, violated, view, { left, top, width, height }, fill) {
  if (violated.count === 0) return;
  const ratio = window.devicePixelRatio || 1;
  context.save();
  context.fillStyle = fill;
  context.globalAlpha = kOnsetOpacity;
  for (const x of pixelsWith(violated, view, Math.round(width))) {
    context.fillRect(left + Math.min(x, width - kOnset * ratio), top, kOnset * ratio, height);
  }
  context.restore();
}

/** Shades the values that checks which have failed do not allow, as long as they are in force. */
export function shadeBeyond(context, limits, { left, top, width, height }, place, fill) {
  const right = left + width;
  const bottom = top + height;
  const inside = (x) => Math.min(right, Math.max(left, x));
  context.save();
  context.fillStyle = fill;
  context.globalAlpha = kBeyondOpacity;
  for (const { isFailed, allowed, from, until } of limits) {
    if (!isFailed || allowed === null) continue;
    const [begin, end] = [inside(place.x(from)), inside(place.x(until))];
    const high = Number.isFinite(allowed.most) ? place.y(allowed.most) : top;
    const low = Number.isFinite(allowed.least) ? place.y(allowed.least) : bottom;
    context.fillRect(begin, top, end - begin, Math.max(0, Math.min(high, bottom) - top));
    const lowTop = Math.max(top, low);
    context.fillRect(begin, lowTop, end - begin, Math.max(0, bottom - lowTop));
  }
  context.restore();
}

/**
 * @param {{left: number, top: number, width: number, height: number}} box of the drawing [device px]
 * @param {{x: (time: number) => number, y: (value: number) => number, has: (value: number) => boolean}} place
 * @param {(limits: Limits) => string} colorOf
 */
export function drawLimits(context, limits, box, place, colorOf) {
  const ratio = window.devicePixelRatio || 1;
  context.save();
  context.beginPath();
  context.rect(box.left, box.top, box.width, box.height);
  context.clip();
  context.lineWidth = ratio;
  context.setLineDash([5 * ratio, 3 * ratio]);
  for (const each of limits) {
    context.strokeStyle = colorOf(each);
    context.beginPath();
    for (const line of each.lines.filter(place.has)) {
      const y = Math.round(place.y(line)) + 0.5;
      const right = place.x(each.until);
      context.moveTo(Math.min(place.x(each.from), right - kShortest * ratio), y);
      context.lineTo(right, y);
    }
    context.stroke();
  }
  context.restore();
}
