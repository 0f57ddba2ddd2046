import assert from "node:assert/strict";
import test from "node:test";
import { keepView } from "../../../../../master/report/page/src/live/kept.js";
import { View } from "../../../../../master/report/page/src/view.js";

globalThis.requestAnimationFrame = () => {};

/** The view of a page that opens at a failure. */
function atFailure() {
  const view = new View({ from: 0, until: 30 });
  view.show(18, 24);
  view.holdCursor(21);
  return view;
}

const shown = ({ from, until, cursor, isHeld }) => ({ from, until, cursor, isHeld });

test("a page that nobody has zoomed or held the cursor of opens as it does by itself", () => {
  const before = new View({ from: 0, until: 20 });
  const view = atFailure();
  keepView(view, before);
  assert.deepEqual(shown(view), { from: 18, until: 24, cursor: 21, isHeld: true });
  before.moveCursor(3); // the mouse rests there
  keepView(view, before);
  assert.deepEqual(shown(view), { from: 18, until: 24, cursor: 21, isHeld: true });
});

test("a cursor that follows the mouse stays where the page does not open elsewhere", () => {
  const before = new View({ from: 0, until: 20 });
  before.moveCursor(3);
  const view = new View({ from: 0, until: 30 });
  keepView(view, before);
  assert.deepEqual(shown(view), { from: 0, until: 30, cursor: 3, isHeld: false });
});

test("what was chosen stays, and a failure does not take its place", () => {
  const before = new View({ from: 0, until: 20 });
  before.holdCursor(3);
  const view = atFailure();
  keepView(view, before);
  assert.deepEqual(shown(view), { from: 0, until: 30, cursor: 3, isHeld: true });
  before.releaseCursor();
  before.show(4, 6);
  keepView(view, before);
  assert.deepEqual(shown(view), { from: 4, until: 6, cursor: null, isHeld: false });
});
