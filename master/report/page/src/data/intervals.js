// The activity of a unit over time: consecutive intervals, and the share of a time range that they cover.
import { lastAtOrBefore } from "./exact_time.js";

export class Intervals {
  /**
   * @param {Float64Array} from [s], ascending
   * @param {Float64Array} until [s], each at or after its `from`
   */
  constructor(from, until) {
    this.from = from;
    this.until = until;
    this.covered = new Float64Array(from.length + 1);
    for (let i = 0; i < from.length; ++i) this.covered[i + 1] = this.covered[i] + (until[i] - from[i]);
  }

  get count() {
    return this.from.length;
  }

  /** The covered time before `time` [s], if no two overlap. */
  coveredBefore(time) {
    const last = lastAtOrBefore(this.from, time);
    if (last < 0) return 0;
    return this.covered[last] + Math.min(time, this.until[last]) - this.from[last];
  }

  /** The covered share of the time from `from` until `until`, 0 to 1. */
  share(from, until) {
    if (!(until > from)) return 0;
    return Math.min(1, Math.max(0, (this.coveredBefore(until) - this.coveredBefore(from)) / (until - from)));
  }

  /** The number that begin in [from, until). */
  countWithin(from, until) {
    return lastBefore(this.from, until) - lastBefore(this.from, from);
  }

  /** The number that begin in [from, until]. */
  countThrough(from, until) {
    return lastAtOrBefore(this.from, until) - lastBefore(this.from, from);
  }

  /** The index of the interval that contains `time`, or -1. */
  at(time) {
    const last = lastAtOrBefore(this.from, time);
    return last >= 0 && time <= this.until[last] ? last : -1;
  }
}

/** The ends of intervals as instants, ascending: of steps that were made again, an earlier one can end later. */
export function endsOf({ until }) {
  const ends = Float64Array.from(until).sort();
  return new Intervals(ends, ends);
}

/** The pixels of the view in which intervals begin; the end of the view is in the last pixel. */
export function pixelsWith(intervals, { from, until }, width) {
  const perPixel = (until - from) / width;
  const pixels = [];
  for (let x = 0; x < width; ++x) {
    const left = from + x * perPixel;
    const count = x + 1 < width ? intervals.countWithin(left, left + perPixel) : intervals.countThrough(left, until);
    if (count > 0) pixels.push(x);
  }
  return pixels;
}

function lastBefore(times, time) {
  let index = lastAtOrBefore(times, time);
  while (index >= 0 && times[index] === time) --index;
  return index;
}

/**
 * The intersection of all of them.
 * @param {Intervals[]} all each without overlaps
 */
export function commonIntervals(all) {
  if (all.length === 0) return new Intervals(new Float64Array(0), new Float64Array(0));
  return all.slice(1).reduce(intersection, all[0]);
}

function intersection(one, other) {
  const from = [];
  const until = [];
  for (let i = 0, j = 0; i < one.count && j < other.count;) {
    const start = Math.max(one.from[i], other.from[j]);
    const end = Math.min(one.until[i], other.until[j]);
    if (start < end) {
      from.push(start);
      until.push(end);
    }
    if (one.until[i] < other.until[j]) ++i;
    else ++j;
  }
  return new Intervals(Float64Array.from(from), Float64Array.from(until));
}
