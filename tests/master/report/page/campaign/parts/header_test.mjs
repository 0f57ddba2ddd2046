import assert from "node:assert/strict";
import test from "node:test";
import { verdictOf } from "../../../../../../master/report/page/src/campaign/parts/header.js";

const verdict = (...cases) => verdictOf(cases.map((count) => ({ cases: count })));

test("the page says first whether all have passed", () => {
  assert.deepEqual(verdict(8, 0, 0, 0, 0, 0), { kind: "good", text: "All 8 cases passed" });
  assert.deepEqual(verdict(1, 0, 0, 0, 0, 0), { kind: "good", text: "The case passed" });
  assert.deepEqual(verdict(0, 0, 0, 0, 0, 3), { kind: "open", text: "No case has been run" });
  assert.deepEqual(verdict(2, 0, 0, 0, 0, 1), { kind: "open", text: "All 2 cases that have been run passed" });
  assert.deepEqual(verdict(9996, 0, 1, 0, 0, 3), { kind: "bad", text: "1 of 10,000 cases has not passed" });
  assert.deepEqual(verdict(0, 1, 0, 1, 1, 0), { kind: "bad", text: "3 of 3 cases have not passed" });
});
