import assert from "node:assert/strict";
import test from "node:test";
import { rowsOf, sorted } from "../../../../../../master/report/page/src/campaign/data/case_list.js";

const kCases = { outcomes: [0, 1, 4, 5, 1], reasons: ["", "Low: at 3 s", "it took longer", "", "high: at 3 s"] };
const kAll = [1, 1, 1, 1, 1];

test("the table has those that have not passed, all, or those of an outcome", () => {
  assert.deepEqual(rowsOf(kCases, kAll, "failed"), [1, 2, 4]);
  assert.deepEqual(rowsOf(kCases, kAll, ""), [0, 1, 2, 3, 4]);
  assert.deepEqual(rowsOf(kCases, kAll, "0"), [0]);
  assert.deepEqual(rowsOf(kCases, [1, 0, 1, 1, 1], "failed"), [2, 4]);
});

test("all words must be in the reason, in whatever case", () => {
  assert.deepEqual(rowsOf(kCases, kAll, "failed", "AT low"), [1]);
  assert.deepEqual(rowsOf(kCases, kAll, "", "3"), [1, 4]);
});

test("what is not known is last, and equal ones keep their order", () => {
  const values = [2, NaN, 1, 2, 3];
  assert.deepEqual(sorted([0, 1, 2, 3, 4], values, false), [2, 0, 3, 4, 1]);
  assert.deepEqual(sorted([0, 1, 2, 3, 4], values, true), [4, 0, 3, 2, 1]);
});
