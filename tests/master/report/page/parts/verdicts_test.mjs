import assert from "node:assert/strict";
import test from "node:test";
import {
  failureTimes,
  firstFailure,
  judgements,
  summary,
} from "../../../../../master/report/page/src/parts/verdicts.js";

const check = (name, passed, time = null) => ({
  name,
  kind: "range",
  passed,
  text: `${name}…`,
  time,
  line: 7,
  values: [],
});

test("without anything that judges the page says so", () => {
  assert.deepEqual(summary({ outcome: "completed" }).kind, "none");
});

test("without run.json verdicts are not known", () => {
  assert.deepEqual(summary({}), { kind: "none", text: "Verdicts are not known: there is no run.json" });
});

test("all passed", () => {
  const run = {
    outcome: "completed",
    verdicts: [{ component: "truth", passed: true, text: "" }],
    checks: [check("a", true)],
  };
  assert.deepEqual(summary(run), { kind: "good", text: "All 2 passed" });
});

test("what failed is named, and the first instant of all is shown", () => {
  const run = {
    outcome: "completed",
    checks: [check("late", false, 9), check("fine", true), check("early", false, 3)],
  };
  const { kind, text, failed, first } = summary(run);
  assert.deepEqual([kind, text, first.time], ["bad", "2 of 3 failed", 3]);
  assert.deepEqual(
    failed.map(({ name }) => name),
    ["late", "early"],
  );
  assert.deepEqual(failureTimes(run), [9, 3]);
  assert.equal(firstFailure(run), 3);
  assert.deepEqual(
    judgements(run).map(({ name }) => name),
    ["late", "early", "fine"],
  );
});

test("the first failure is that of a check, or the end of a run that failed", () => {
  assert.equal(firstFailure({ outcome: "failed", reached: 2, checks: [check("a", false, 3)] }), 2);
  assert.equal(firstFailure({ outcome: "failed" }), null);
  assert.equal(firstFailure({ outcome: "completed", reached: 2, checks: [check("a", true)] }), null);
  assert.equal(firstFailure({ outcome: "completed", verdicts: [{ component: "t", passed: false, text: "" }] }), null);
});

test("margins are of checks that are decided, and never of units", () => {
  const margin = { value: 0.5, unit: "V", at: 2 };
  const checks = [{ ...check("a", true), margin }, { ...check("b", null), margin: null }, check("old", true)];
  const run = { outcome: "completed", verdicts: [{ component: "truth", passed: true, text: "" }], checks };
  const found = Object.fromEntries(judgements(run).map(({ name, margin: each }) => [name, each]));
  assert.deepEqual(found, { a: margin, b: null, old: null, truth: null });
});

test("undecided is neither passed nor failed", () => {
  assert.equal(summary({ outcome: "completed", checks: [check("a", null), check("b", true)] }).kind, "open");
});

test("a run that failed is not a success, whatever was judged until then", () => {
  assert.deepEqual(summary({ outcome: "failed", checks: [check("a", true)] }), { kind: "bad", text: "The run failed" });
  assert.equal(summary({ outcome: "interrupted", checks: [check("a", true)] }).kind, "open");
  assert.equal(summary({ outcome: "running", checks: [], verdicts: [] }).kind, "open");
  assert.equal(summary({ outcome: "interrupted", checks: [check("a", false, 1)] }).kind, "bad");
});
