import assert from "node:assert/strict";
import test from "node:test";
import { Column } from "../../../../../master/report/page/src/data/report.js";
import { isAlike, keepRow, takeOver } from "../../../../../master/report/page/src/live/update.js";
import { View } from "../../../../../master/report/page/src/view.js";

globalThis.requestAnimationFrame = () => {};

/** A run up to this number of samples, a second apart. */
function reportOf(count, { messages = [], type = "Float64", outcome = "running" } = {}) {
  const seconds = Float64Array.from({ length: count }, (_, i) => i);
  const column = new Column({ name: "tank.level", type, stepped: false }, seconds.map((t) => 2 * t), undefined, seconds);
  return {
    run: { outcome },
    columns: new Map([[column.name, column]]),
    seconds,
    plots: [],
    units: ["tank"],
    messages,
    activity: new Map(),
    films: [{ component: "world", frames: Array.from({ length: count }, (_, i) => `picture ${i}`) }],
    whole: { from: 0, until: count - 1 },
  };
}

test("a report takes over what a later one has, and its columns and films stay the same", () => {
  const report = reportOf(3);
  const column = report.columns.get("tank.level");
  const [film] = report.films;
  const later = reportOf(5);
  assert.ok(isAlike(report, later));
  takeOver(report, later);
  assert.equal(report.columns.get("tank.level"), column);
  assert.deepEqual([...column.values], [0, 2, 4, 6, 8]);
  assert.equal(column.seconds, report.seconds);
  assert.deepEqual(column.pyramid.extremes(0, 5), { least: 0, most: 8 });
  assert.equal(report.films[0], film);
  assert.equal(film.frames.length, 5);
  assert.equal(report.whole.until, 4);
});

test("what needs other parts of the page is not alike", () => {
  const message = { direction: "sent", seconds: 1 };
  const intervention = { direction: "intervention", seconds: 1 };
  const report = reportOf(3);
  assert.ok(!isAlike(report, reportOf(3, { messages: [message] })), "the first message");
  assert.ok(!isAlike(report, reportOf(3, { type: "Int32" })), "another type");
  assert.ok(!isAlike(report, reportOf(3, { outcome: "completed" })), "the end");
  assert.ok(!isAlike(reportOf(0), reportOf(1)), "the first picture");
  const one = reportOf(3, { messages: [message] });
  assert.ok(isAlike(one, reportOf(4, { messages: [message, message] })), "a second message");
  assert.ok(!isAlike(one, reportOf(4, { messages: [message, intervention] })), "the first intervention");
});

test("the cursor stays at its row", () => {
  const view = new View({ from: 0, until: 2 });
  const before = Float64Array.from([0, 1, 1, 2]); // two rows that doubles do not distinguish
  view.holdCursor(1, { of: before, index: 1 });
  const now = Float64Array.from([0, 1, 1, 2, 3]);
  keepRow(view, before, now);
  assert.deepEqual(view.row, { of: now, index: 1 });
  keepRow(view, now, Float64Array.from([0, 2, 3]));
  assert.equal(view.row, null, "rows were left out");
});
