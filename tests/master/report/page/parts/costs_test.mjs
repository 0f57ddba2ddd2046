import assert from "node:assert/strict";
import test from "node:test";
import { idleText, linkTexts } from "../../../../../master/report/page/src/parts/costs.js";

test("the idle time of a unit keeps its zeros", () => {
  const textOf = (skipped) => idleText({ idle: { skipped } });
  assert.equal(textOf(0), "0");
  assert.equal(textOf(2.5), "2.5");
  assert.equal(textOf(30), "30");
  assert.equal(textOf(1000), "1,000");
  assert.equal(textOf(3600), "3,600");
  assert.equal(idleText({}), "");
});

test("a unit on another machine has a line with what its link cost", () => {
  const link = { round_trips: 2004, sent: 123456, received: 98765, lost_time: 1.5 };
  const units = [{ name: "here" }, { name: "hosted", host: {} }, { name: "sensor", host: { machine: "me@box", link } }];
  assert.deepEqual(linkTexts(units), [
    "sensor ran on me@box: 2,004 round trips (123.5 kB there, 98.77 kB back), 1.500 s lost to the network.",
  ]);
  assert.deepEqual(linkTexts([{ name: "here" }]), []);
});
