import assert from "node:assert/strict";
import test from "node:test";
import { LinearAxis, LogarithmicAxis } from "../../../../../master/report/page/src/plot/value_axis.js";

const texts = (axis) => axis.ticks.map(({ text }) => text);
const near = (one, other) => assert.ok(Math.abs(one - other) < 1e-9, `${one} is not ${other}`);

test("what is beyond a linear axis is at its edge, and has no place on it", () => {
  const axis = new LinearAxis({ least: 0, most: 4 }, false);
  near(axis.shareOf(2), 0.5);
  assert.deepEqual(
    [-Infinity, Infinity, 100].map((value) => axis.shareOf(value)),
    [0, 1, 1],
  );
  assert.deepEqual(
    [0, 4, 100, -1].map((value) => axis.has(value)),
    [true, true, false, false],
  );
  assert.deepEqual(texts(axis), ["0", "1", "2", "3", "4"]);
});

test("the ticks of whole numbers are whole, and large numbers leave out a power of ten", () => {
  assert.deepEqual(texts(new LinearAxis({ least: 0, most: 1 }, true)), ["0", "1"]);
  const axis = new LinearAxis({ least: 0, most: 2e6 }, false);
  assert.equal(axis.exponent, 6);
  assert.deepEqual(texts(axis), ["0.0", "0.5", "1.0", "1.5", "2.0"]);
});

test("the largest numbers have a range", () => {
  const axis = new LinearAxis({ least: -1e308, most: 1e308 }, false);
  near(axis.shareOf(0), 0.5);
  assert.ok(axis.shareOf(1e308) > 0.9 && axis.shareOf(1e308) < 1);
  assert.deepEqual([axis.exponent, texts(axis).length > 2], [306, true]);
  const widest = new LinearAxis({ least: -Number.MAX_VALUE, most: Number.MAX_VALUE }, false);
  assert.deepEqual([widest.shareOf(-Number.MAX_VALUE), widest.shareOf(Number.MAX_VALUE)], [0, 1]);
});

test("small changes of a large value are counted from one of its ticks", () => {
  const axis = new LinearAxis({ least: 1, most: 1 + 1e-12 }, false);
  assert.deepEqual([axis.offset, axis.exponent], [1, -12]);
  assert.deepEqual(texts(axis), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
  const finest = new LinearAxis({ least: 1, most: 1 + 2 ** -52 }, false);
  assert.equal(new Set(texts(finest)).size, texts(finest).length);
});

test("a logarithmic axis of positive values has nothing but decades", () => {
  const axis = new LogarithmicAxis({ least: 1e-3, most: 10, leastPositive: 1e-3 });
  assert.deepEqual(texts(axis), ["10⁻³", "10⁻²", "10⁻¹", "10⁰", "10¹"]);
  near(axis.shareOf(1e-3), 0);
  near(axis.shareOf(0.1), 0.5);
  assert.deepEqual([axis.below, axis.has(0), axis.shareOf(0)], [0, false, 0]);
});

test("zeros have a place below the smallest positive value, negative values one below that", () => {
  const zeros = new LogarithmicAxis({ least: 0, most: 10, leastPositive: 1e-3 });
  assert.deepEqual(texts(zeros).slice(0, 2), ["0", "10⁻³"]);
  assert.ok(zeros.shareOf(0) > 0 && zeros.shareOf(1e-3) - zeros.shareOf(0) > 0.05);
  near(zeros.shareOf(10), 1);
  assert.deepEqual([zeros.has(0), zeros.has(-1)], [true, false]);
  const both = new LogarithmicAxis({ least: -1e5, most: 10, leastPositive: 1e-3 });
  assert.deepEqual(texts(both).slice(0, 3), ["< 0", "0", "10⁻³"]);
  const shares = [-1e5, 0, 1e-3].map((value) => both.shareOf(value));
  assert.ok(0 < shares[0] && shares[0] + 0.1 < shares[1] && shares[1] + 0.05 < shares[2]);
  assert.equal(both.shareOf(-1), shares[0]);
  assert.equal(both.shareOf(-Infinity), shares[0]);
});
