import assert from "node:assert/strict";
import test from "node:test";
import { Pyramid } from "../../../../../master/report/page/src/plot/pyramid.js";
import { states } from "../../../../../master/report/page/src/plot/states.js";
import { rowGroups } from "../../../../../master/report/page/src/plot/thin.js";

function statesOf(values, pixels) {
  const seconds = Float64Array.from(values, (_, i) => i);
  const column = { values, pyramid: new Pyramid(values), seconds };
  return states(column, rowGroups(seconds, 0, values.length - 1, pixels));
}

test("a state lasts until the next one", () => {
  const found = statesOf(Uint8Array.of(0, 0, 1, 1, 1, 0), 100);
  assert.deepEqual(
    found.map(({ from, until, value }) => [from, until, value]),
    [
      [0, 2, 0],
      [2, 5, 1],
      [5, undefined, 0],
    ],
  );
});

test("a short pulse among many rows is seen", () => {
  const values = new Uint8Array(10000);
  values[4321] = 1;
  const mixed = statesOf(values, 50).filter(({ isMixed }) => isMixed);
  assert.equal(mixed.length, 1);
  assert.ok(mixed[0].from <= 4321 && mixed[0].until >= 4321);
});
