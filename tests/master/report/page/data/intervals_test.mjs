import assert from "node:assert/strict";
import test from "node:test";
import {
  commonIntervals,
  endsOf,
  Intervals,
  pixelsWith,
} from "../../../../../master/report/page/src/data/intervals.js";
import { randomNumbers } from "../random.mjs";

const intervals = (...pairs) =>
  new Intervals(Float64Array.from(pairs.map(([from]) => from)), Float64Array.from(pairs.map(([, until]) => until)));

test("the covered share of any time", () => {
  const some = intervals([1, 2], [3, 5], [5, 6]);
  assert.equal(some.share(0, 1), 0);
  assert.equal(some.share(1, 2), 1);
  assert.equal(some.share(0, 4), 0.5);
  assert.equal(some.share(4, 6), 1);
  assert.equal(some.share(1.25, 1.5), 1);
  assert.equal(some.share(6, 9), 0);
  assert.equal(some.share(2, 2), 0);
});

test("instants are counted where they begin", () => {
  const some = intervals([1, 1], [2, 2], [2, 2], [3, 3]);
  assert.equal(some.countWithin(0, 1), 0);
  assert.equal(some.countWithin(1, 2), 1);
  assert.equal(some.countWithin(2, 3), 2);
  assert.equal(some.countWithin(0, 99), 4);
});

test("no instant is lost or counted twice between pixels", () => {
  const random = randomNumbers(2);
  const times = Array.from({ length: 500 }, random).sort((a, b) => a - b);
  const some = intervals(...times.map((time) => [time, time]));
  let count = 0;
  for (let i = 0; i < 100; ++i) count += some.countWithin(i / 100, (i + 1) / 100);
  assert.equal(count, 500);
});

test("an instant at the very end is in the last pixel", () => {
  const some = intervals([0, 0], [5, 5], [10, 10]);
  assert.deepEqual(pixelsWith(some, { from: 0, until: 10 }, 100), [0, 50, 99]);
  assert.deepEqual(pixelsWith(some, { from: 0, until: 10 }, 99.5), [0, 49, 99]);
  assert.deepEqual(pixelsWith(some, { from: 1, until: 9 }, 8), [4]);
});

test("the time that all cover", () => {
  const common = commonIntervals([intervals([0, 4], [6, 9]), intervals([1, 2], [3, 8]), intervals([0, 10])]);
  assert.deepEqual([...common.from], [1, 3, 6]);
  assert.deepEqual([...common.until], [2, 4, 8]);
  assert.equal(commonIntervals([]).count, 0);
  assert.equal(commonIntervals([intervals([0, 1]), intervals()]).count, 0);
});

test("ends are instants, in their order", () => {
  const ends = endsOf(intervals([0, 5], [1, 4], [6, 7]));
  assert.deepEqual([...ends.from], [4, 5, 7]);
  assert.deepEqual([...ends.until], [4, 5, 7]);
  assert.deepEqual(pixelsWith(ends, { from: 0, until: 10 }, 10), [4, 5, 7]);
});
