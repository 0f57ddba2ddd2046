// Two runs, and where they differ, unpacked from the data that `stride compare` put into the page.
import { secondsOf } from "../data/exact_time.js";
import { Intervals } from "../data/intervals.js";
import { readReport } from "../data/report.js";

/**
 * The instants of both, each once.
 * @param {BigInt64Array|bigint[]} a ascending
 * @param {BigInt64Array|bigint[]} b ascending
 */
export function unitedTimes(a, b) {
  const isWide = Array.isArray(a) || Array.isArray(b);
  const times = isWide ? new Array(a.length + b.length) : new BigInt64Array(a.length + b.length);
  let count = 0;
  for (let i = 0, k = 0; i < a.length || k < b.length;) {
    const isOfA = k === b.length || (i < a.length && a[i] <= b[k]);
    const time = isOfA ? a[i++] : b[k++];
    if (count === 0 || times[count - 1] !== time) times[count++] = time;
  }
  return times.slice(0, count);
}

/**
 * The panes of a signal that differs: both curves in one, or one below the other where one of them is a text.
 * @param {import("../data/report.js").Column|undefined} a
 * @param {import("../data/report.js").Column|undefined} b
 */
export function overlay(name, a, b) {
  const columns = [a?.named("A"), b?.named("B")].filter(Boolean);
  const kinds = [columns.filter(({ isState }) => !isState), columns.filter(({ isState }) => isState)];
  return kinds
    .filter((kind) => kind.length > 0)
    .map((kind) => ({ title: name, unit: kind[0].unit, isStates: kind[0].isState, columns: kind }));
}

/** @param {(share: number) => void} progress called with the share that has been read, 0 to 1 */
export async function readComparison(data, progress) {
  const { format, stride } = data;
  const a = await readReport({ format, stride, ...data.a }, (share) => progress(share / 2));
  const b = await readReport({ format, stride, ...data.b }, (share) => progress(0.5 + share / 2));
  const times = unitedTimes(a.times, b.times);
  const differing = data.comparison.differences.filter(({ kind }) => kind === "signal").map(({ name }) => name);
  const overlays = differing.flatMap((name) => overlay(name, a.columns.get(name), b.columns.get(name)));
  /** What the time axis, and the panes of what does not differ, are made of. */
  const report = {
    ...a,
    run: {},
    times,
    seconds: secondsOf(times),
    whole: { from: Math.min(a.whole.from, b.whole.from), until: Math.max(a.whole.until, b.whole.until) },
    idle: new Intervals(new Float64Array(), new Float64Array()),
    plots: [{ title: "", signals: differing }],
  };
  return { comparison: data.comparison, version: stride, a, b, report, overlays };
}
