import assert from "node:assert/strict";
import test from "node:test";
import { idleText } from "../../../../../master/report/page/src/parts/costs.js";

test("the idle time of a unit keeps its zeros", () => {
  const textOf = (skipped) => idleText({ idle: { skipped } });
  assert.equal(textOf(0), "0");
  assert.equal(textOf(2.5), "2.5");
  assert.equal(textOf(30), "30");
  assert.equal(textOf(1000), "1,000");
  assert.equal(textOf(3600), "3,600");
  assert.equal(idleText({}), "");
});
