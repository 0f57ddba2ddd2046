import assert from "node:assert/strict";
import test from "node:test";
import {
  lastAtOrBefore,
  secondsOf,
  timeText,
  toSeconds,
} from "../../../../../master/report/page/src/data/exact_time.js";

test("no digit of a time is lost", () => {
  assert.equal(timeText(0n), "0");
  assert.equal(timeText(14200358702064n), "14.200358702064");
  assert.equal(timeText(24_000_000_000_000n), "24");
  assert.equal(timeText(1n), "0.000000000001");
  assert.equal(timeText(500_000_000_000n), "0.5");
  assert.equal(timeText(9223372036854775807n), "9223372.036854775807");
  assert.equal(timeText(3_155_760_000_000_000_000_001n), "3155760000.000000000001");
  assert.equal(timeText(-1_500_000_000_000n), "-1.5");
});

test("seconds are those of each instant", () => {
  const times = BigInt64Array.of(0n, 1n, 4294967295n, 4294967296n, 14200358702064n, 9223372036854775807n, -1n);
  const seconds = secondsOf(times);
  times.forEach((time, i) => assert.equal(seconds[i], toSeconds(time)));
  assert.deepEqual([...secondsOf([3_155_760_000_250_000_000_000n])], [3155760000.25]);
});

test("the last instant at or before a time", () => {
  const times = [1, 2, 2, 3];
  assert.equal(lastAtOrBefore(times, 0.5), -1);
  assert.equal(lastAtOrBefore(times, 1), 0);
  assert.equal(lastAtOrBefore(times, 2), 2);
  assert.equal(lastAtOrBefore(times, 2.5), 2);
  assert.equal(lastAtOrBefore(times, 99), 3);
  assert.equal(lastAtOrBefore([], 1), -1);
});
