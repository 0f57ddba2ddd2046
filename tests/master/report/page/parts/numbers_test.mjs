import assert from "node:assert/strict";
import test from "node:test";
import { idleShare, keyNumbers } from "../../../../../master/report/page/src/parts/numbers.js";

const kRun = {
  start: 0,
  reached: 10,
  wall_time: 2,
  communication_steps: 12345,
  units: [{ rejections: 1, idle: { skipped: 5 } }, { rejections: 2 }],
};

test("the share of time that was skipped is of all units", () => {
  assert.equal(idleShare(kRun), 0.25);
  assert.equal(idleShare({ ...kRun, units: [{}] }), null);
});

test("the numbers of a run", () => {
  const messages = [{ direction: "sent" }, { direction: "received" }];
  const numbers = new Map(keyNumbers({ run: kRun, messages, times: new Array(7) }));
  assert.equal(numbers.get("simulated"), "10 s");
  assert.equal(numbers.get("speed"), "5 × real time");
  assert.equal(numbers.get("suspended"), "25.0 % of the units’ time");
  assert.equal(numbers.get("steps"), "12,345");
  assert.equal(numbers.get("messages sent"), "1");
  assert.equal(numbers.get("rejected steps"), "3");
});

test("what is not known is left out", () => {
  const names = keyNumbers({ run: {}, messages: [], times: [] }).map(([name]) => name);
  assert.deepEqual(names, ["messages sent", "samples"]);
});
