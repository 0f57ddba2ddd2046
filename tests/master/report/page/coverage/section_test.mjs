import assert from "node:assert/strict";
import test from "node:test";
import { linesOf } from "../../../../../master/report/page/src/coverage/section.js";

const point = { at_least: 2 };

test("a bin says how often it was visited, and when first", () => {
  assert.deepEqual(linesOf({ name: "[0, 1)", count: 3, first: 1.25 }, point), ["[0, 1)", "3 visits", "first at 1.25 s"]);
  assert.deepEqual(linesOf({ name: "on", count: 1, first: 0, case: 7 }, point), [
    "on",
    "1 visit",
    "not visited often enough",
    "first at 0 s of case 7",
  ]);
});

test("a bin that was not visited, or does not count, says so", () => {
  assert.deepEqual(linesOf({ name: "on", count: 0 }, point), ["on", "not visited"]);
  assert.deepEqual(linesOf({ name: "NaN", count: 0, ignored: true }, point), ["NaN", "does not count"]);
});
