import assert from "node:assert/strict";
import test from "node:test";
import { moveByMessages, moveBySamples, rowAtCursor } from "../../../../master/report/page/src/cursor.js";
import { View } from "../../../../master/report/page/src/view.js";

globalThis.requestAnimationFrame = () => {};

const makeView = () => new View({ from: 0, until: 30 });

test("a view stays within the run", () => {
  const view = makeView();
  view.show(-10, 5);
  assert.deepEqual([view.from, view.until], [0, 15]);
  view.show(-100, 200);
  assert.ok(view.isWhole);
});

test("zooming leaves the cursor where it is", () => {
  const view = makeView();
  view.moveCursor(10);
  const share = view.shareOf(10);
  view.zoom(0.5);
  assert.deepEqual([view.from, view.until], [5, 20]);
  assert.equal(view.shareOf(10), share);
});

test("zooming in ends where doubles do, and zooming out at the whole run", () => {
  const view = makeView();
  for (let i = 0; i < 200; ++i) view.zoom(0.5, 14.2);
  assert.ok(view.span > 0 && view.span < 1e-9);
  assert.ok(view.from <= 14.2 && view.until >= 14.2);
  for (let i = 0; i < 200; ++i) view.zoom(2);
  assert.ok(view.isWhole);
});

test("a run that goes on is followed where the whole of it is shown", () => {
  const view = makeView();
  let told = 0;
  view.addEventListener("data", () => ++told);
  view.grow({ from: 0, until: 40 });
  assert.deepEqual([view.from, view.until, view.isWhole, told], [0, 40, true, 1]);
  view.show(10, 20);
  view.grow({ from: 0, until: 50 });
  assert.deepEqual([view.from, view.until, view.isWhole, told], [10, 20, false, 2]);
  view.showWhole();
  assert.deepEqual([view.from, view.until], [0, 50]);
});

test("moving along ends at the ends", () => {
  const view = makeView();
  view.show(10, 20);
  view.pan(0.5);
  assert.deepEqual([view.from, view.until], [15, 25]);
  view.pan(5);
  assert.deepEqual([view.from, view.until], [20, 30]);
});

test("a cursor that is put out of sight brings the view with it", () => {
  const view = makeView();
  view.show(0, 2);
  view.holdCursor(20);
  assert.deepEqual([view.from, view.until], [19, 21]);
  assert.ok(view.isHeld);
  view.releaseCursor();
  assert.equal(view.cursor, null);
});

test("changes are told once for each picture", () => {
  const view = makeView();
  const told = [];
  for (const name of ["view", "cursor"]) view.addEventListener(name, () => told.push(name));
  view.show(1, 2);
  view.show(1, 3);
  view.moveCursor(1.5);
  assert.deepEqual(told, []);
  view.flush();
  assert.deepEqual(told, ["view", "cursor"]);
});

const makeContext = (seconds, messages = []) => ({
  view: makeView(),
  report: { seconds: Float64Array.from(seconds), messages: messages.map((time) => ({ seconds: time })) },
});

test("the cursor goes from sample to sample, also where doubles are the same", () => {
  const context = makeContext([0, 1, 1, 2, 3]);
  moveBySamples(context, 1);
  const row = () => rowAtCursor(context.report, context.view);
  const rows = [row()];
  for (const step of [1, 1, -1, -1, 10, -10]) {
    moveBySamples(context, step);
    rows.push(row());
  }
  assert.deepEqual(rows, [1, 2, 3, 2, 1, 4, 0]);
});

test("the cursor goes from message to message", () => {
  const context = makeContext([0], [5, 5, 8, 12]);
  const places = [1, 1, 1, 1, -1, -1, -1].map((direction) => {
    moveByMessages(context, direction);
    return context.view.cursor;
  });
  assert.deepEqual(places, [5, 8, 12, 12, 8, 5, 5]);
});

test("before the first sample there are no values", () => {
  const { report, view } = makeContext([1, 2]);
  assert.equal(rowAtCursor(report, view), -1);
  view.moveCursor(0.5);
  assert.equal(rowAtCursor(report, view), -1);
  view.moveCursor(1.99);
  assert.equal(rowAtCursor(report, view), 0);
});

test("the row that the cursor was set to is one of its own report", () => {
  const { report, view } = makeContext([1, 2, 2]);
  view.holdCursor(2, { of: report.seconds, index: 1 });
  assert.equal(rowAtCursor(report, view), 1);
  assert.equal(rowAtCursor({ seconds: Float64Array.of(0, 1, 2, 3) }, view), 2);
});
