import assert from "node:assert/strict";
import test from "node:test";
import { View } from "../../../../../master/report/page/src/view.js";
import { Player } from "../../../../../master/report/page/src/world/player.js";

globalThis.requestAnimationFrame ??= () => {};

/** A player and its clock; `pass` shows one picture after some time. */
function playerOf(whole = { from: 0, until: 10 }) {
  let now = 1000;
  let next;
  const view = new View(whole);
  const player = new Player(view, (step) => (next = step));
  const pass = (milliseconds) => {
    now += milliseconds;
    const step = next;
    next = undefined;
    step?.(now);
  };
  const start = () => {
    player.toggle();
    pass(0);
  };
  return { view, player, pass, start, isWaiting: () => next !== undefined };
}

const near = (found, expected) => assert.ok(Math.abs(found - expected) < 1e-9, `${found}, expected ${expected}`);

test("the cursor goes as fast as time, or so many times", () => {
  const { view, player, pass, start } = playerOf();
  start();
  assert.equal(view.cursor, 0);
  pass(16);
  near(view.cursor, 0.016);
  player.speed = 10;
  pass(20);
  near(view.cursor, 0.216);
  assert.ok(view.isHeld);
});

test("it begins at the cursor, or at the begin of what is shown where that is not inside", () => {
  for (const [cursor, begin] of [[3, 3], [null, 2], [1, 2], [9, 2], [8, 2]]) {
    const { view, start } = playerOf();
    view.show(2, 8);
    view.moveCursor(cursor);
    start();
    assert.equal(view.cursor, begin);
  }
});

test("it ends at the end of what is shown, and needs no more pictures", () => {
  const { view, player, pass, start, isWaiting } = playerOf();
  view.show(2, 3);
  player.speed = 5;
  start();
  for (let i = 0; i < 5; ++i) pass(100);
  assert.equal(view.cursor, 3);
  assert.equal(player.isPlaying, false);
  assert.equal(isWaiting(), false);
  assert.equal(view.from, 2);
});

test("a pause keeps the cursor; a cursor that was moved goes on from there; Escape ends it", () => {
  const { view, player, pass, start } = playerOf();
  start();
  pass(100);
  player.toggle();
  pass(100);
  near(view.cursor, 0.1);
  player.toggle();
  pass(0);
  view.holdCursor(7);
  pass(100);
  near(view.cursor, 7.1);
  view.releaseCursor();
  pass(100);
  assert.equal(view.cursor, null);
  assert.equal(player.isPlaying, false);
});

test("what a page in the background misses is not made up for", () => {
  const { view, pass, start } = playerOf();
  start();
  pass(60_000);
  near(view.cursor, 0.5);
});
