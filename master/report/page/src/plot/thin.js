// The rows that are drawn: each, if it has a pixel of its own; else the first, the minimum, the maximum and the last
// of each pixel, which gives the same picture as all rows, without loss of a spike.
import { lastAtOrBefore } from "../data/exact_time.js";

/** The first row at or after `from` whose time is at or after `time`. The step grows, since the row is mostly near. */
function rowAtOrAfter(times, time, from) {
  let step = 1;
  let low = from;
  while (low + step < times.length && times[low + step] < time) {
    low += step;
    step *= 2;
  }
  if (low >= times.length || times[low] >= time) return low;
  let high = Math.min(times.length, low + step);
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] < time) low = middle;
    else high = middle;
  }
  return high;
}

/**
 * The rows from the last one before the view to the first one after it, so that lines continue at both ends:
 * [begin, end).
 */
export function rowsInView(times, from, until) {
  const begin = Math.max(0, lastAtOrBefore(times, from));
  const end = Math.min(times.length, lastAtOrBefore(times, until) + 2);
  return { begin, end };
}

/**
 * The groups of rows that share a pixel, as a flat list of begin, end, begin, end, …
 * @param {Float64Array} times [s]
 */
export function rowGroups(times, from, until, pixels) {
  const { begin, end } = rowsInView(times, from, until);
  const groups = [];
  const width = (until - from) / pixels;
  for (let row = begin; row < end;) {
    const pixel = Math.floor((times[row] - from) / width);
    let next = rowAtOrAfter(times, from + (pixel + 1) * width, row);
    next = Math.min(end, Math.max(row + 1, next));
    groups.push(row, next);
    row = next;
  }
  return groups;
}

/**
 * The instants at which points are drawn, for all columns alike.
 * @returns {number[]}
 */
export function groupTimes(times, groups) {
  const points = [];
  for (let g = 0; g < groups.length; g += 2) {
    const begin = groups[g];
    const end = groups[g + 1];
    if (end - begin === 1) points.push(times[begin]);
    else points.push(times[begin], times[begin], times[end - 1], times[end - 1]);
  }
  return points;
}

/**
 * The values at these instants; null if there is none, which leaves a gap.
 * @param {import("./pyramid.js").Pyramid} pyramid
 * @returns {(number|null)[]}
 */
export function groupValues(pyramid, groups) {
  const { values } = pyramid;
  const points = [];
  for (let g = 0; g < groups.length; g += 2) {
    const begin = groups[g];
    const end = groups[g + 1];
    if (end - begin === 1) {
      points.push(orGap(values[begin]));
      continue;
    }
    const { least, most } = pyramid.extremes(begin, end);
    const isGap = least > most;
    points.push(orGap(values[begin]), isGap ? null : least, isGap ? null : most, orGap(values[end - 1]));
  }
  return points;
}

const orGap = (value) => (Number.isNaN(value) ? null : value);
