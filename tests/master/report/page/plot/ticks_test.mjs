import assert from "node:assert/strict";
import test from "node:test";
import {
  commonExponent,
  powerText,
  roundStep,
  ticks,
  timeTickTexts,
  valueTickTexts,
} from "../../../../../master/report/page/src/plot/ticks.js";

test("steps are 1, 2 or 5 times a power of ten", () => {
  assert.equal(roundStep(10, 10), 1);
  assert.equal(roundStep(10, 6), 2);
  assert.equal(roundStep(10, 3), 5);
  assert.equal(roundStep(30, 4), 10);
});

test("ticks are in the range, and no more than wanted", () => {
  for (const [from, until] of [
    [0, 30],
    [14.2003, 14.2004],
    [-3, 5],
    [1e6, 1e6 + 1e-6],
    [-1e-9, 1e-9],
  ]) {
    const { values } = ticks(from, until, 8);
    assert.ok(values.length >= 2 && values.length <= 9, `${values.length} in ${from} to ${until}`);
    const room = (until - from) * 1e-6;
    for (const value of values) assert.ok(value >= from - room && value <= until + room);
  }
});

test("whole numbers are not divided", () => {
  assert.deepEqual(
    ticks(-0.1, 2.1, 6, 1).values.map((value) => value + 0),
    [0, 1, 2],
  );
});

test("times have as many decimals as tell them apart", () => {
  const { values, step } = ticks(14.2, 14.2004, 4);
  assert.deepEqual(timeTickTexts(values, step), ["14.2000", "14.2001", "14.2002", "14.2003", "14.2004"]);
  assert.deepEqual(timeTickTexts([0, 5, 10], 5), ["0", "5", "10"]);
});

test("small and large numbers have their power of ten over the axis", () => {
  assert.equal(commonExponent(5e-4), -6);
  assert.equal(commonExponent(8e-3), -3);
  assert.equal(commonExponent(5), 0);
  assert.equal(commonExponent(2e6), 6);
  assert.equal(commonExponent(0), 0);
  assert.deepEqual(valueTickTexts([0, 0.002, 0.004], -3), ["0", "2", "4"]);
  assert.deepEqual(valueTickTexts([-0.5, -0.0, 0.5], 0), ["-0.5", "0.0", "0.5"]);
  assert.equal(powerText(-12), "10⁻¹²");
});
