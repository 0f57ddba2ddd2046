import assert from "node:assert/strict";
import test from "node:test";
import { Pyramid } from "../../../../../master/report/page/src/plot/pyramid.js";
import {
  finiteExtremes,
  hasNothingNegative,
  hasPositive,
  isMostlySmall,
  linearRange,
  logarithmicDecades,
} from "../../../../../master/report/page/src/plot/scale.js";

const column = (...values) => ({ values, pyramid: new Pyramid(values) });

test("gaps and infinities do not widen the axis", () => {
  const extremes = finiteExtremes([
    [1, null, Infinity],
    [-Infinity, 3],
  ]);
  assert.deepEqual(extremes, { least: 1, most: 3, leastPositive: 1 });
});

test("a linear axis has room at both ends, also for a constant", () => {
  for (const [least, most] of [
    [1, 3],
    [5, 5],
    [0, 0],
    [-2, -2],
  ]) {
    const [bottom, top] = linearRange({ least, most });
    assert.ok(bottom < least && top > most);
  }
  assert.deepEqual(linearRange({ least: Infinity, most: -Infinity }), [0, 1]);
});

test("a logarithmic axis has whole decades, not without end", () => {
  assert.deepEqual(logarithmicDecades({ most: 9e-3, leastPositive: 2e-7 }), [-7, -2]);
  assert.deepEqual(logarithmicDecades({ most: 1, leastPositive: 1 }), [0, 1]);
  assert.deepEqual(logarithmicDecades({ most: 1, leastPositive: 1e-300 }), [-12, 0]);
  assert.deepEqual(logarithmicDecades({ most: 0, leastPositive: Infinity }), [-1, 0]);
});

test("an axis is logarithmic where most would lie at the bottom", () => {
  assert.ok(isMostlySmall(column(0, 1e-6, 2e-6, 1e-6, 5e-3)));
  assert.ok(!isMostlySmall(column(0, 1, 2, 3, 4)));
  assert.ok(!isMostlySmall(column(0, 0, 0)));
  assert.ok(hasNothingNegative(column(0, NaN, 1)));
  assert.ok(!hasNothingNegative(column(1, -1e-9)));
  assert.ok(hasPositive(column(-1, NaN, 1)));
  assert.ok(!hasPositive(column(-1, 0)));
});
