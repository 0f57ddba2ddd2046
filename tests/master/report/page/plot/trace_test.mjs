import assert from "node:assert/strict";
import test from "node:test";
import { Pyramid } from "../../../../../master/report/page/src/plot/pyramid.js";
import { groupTimes, groupValues, rowGroups } from "../../../../../master/report/page/src/plot/thin.js";
import { trace, Tracer } from "../../../../../master/report/page/src/plot/trace.js";
import { randomNumbers } from "../random.mjs";

const kStyle = { isStepped: false, hasDots: false, width: 1 };

/** What is drawn of rows at 0, 1, 2, … on so many pixels; y grows downwards. */
function drawn(values, pixels, style = {}) {
  const times = Float64Array.from(values, (_, i) => i);
  const groups = rowGroups(times, 0, values.length - 1, pixels);
  const points = { groups, times: groupTimes(times, groups), values: groupValues(new Pyramid(values), groups) };
  const calls = [];
  const sink = Object.fromEntries(
    ["moveTo", "lineTo", "rect"].map((name) => [name, (...at) => calls.push([name, ...at])]),
  );
  const scale = pixels / (values.length - 1);
  trace(new Tracer(sink, { ...kStyle, ...style }), points, { x: (time) => time * scale, y: (value) => 100 - value });
  return calls;
}

test("few values are joined by lines", () => {
  assert.deepEqual(drawn([1, 5, 3], 20), [
    ["moveTo", 0, 99],
    ["lineTo", 10, 95],
    ["lineTo", 20, 97],
  ]);
});

test("what is stepped goes on level until the next value", () => {
  assert.deepEqual(drawn([1, 5], 10, { isStepped: true }), [
    ["moveTo", 0, 99],
    ["lineTo", 10, 99],
    ["lineTo", 10, 95],
  ]);
});

test("a gap parts lines, and a value alone between gaps is a dot", () => {
  const calls = drawn([1, 2, NaN, 7, NaN, 3, 4], 60);
  assert.deepEqual(
    calls.map(([name]) => name),
    ["moveTo", "lineTo", "moveTo", "rect", "moveTo", "lineTo"],
  );
});

test("many values of almost one height are a line", () => {
  const calls = drawn(
    Array.from({ length: 1001 }, (_, i) => i / 100),
    50,
  );
  assert.ok(calls.every(([name]) => name !== "rect"));
  assert.ok(calls.length <= 53);
});

test("a dense slope is a line from its first to its last value", () => {
  const calls = drawn(
    Array.from({ length: 1001 }, (_, i) => i),
    10,
  );
  assert.ok(calls.every(([name]) => name !== "rect"));
  const heights = calls.map(([, , y]) => y);
  assert.deepEqual([Math.max(...heights), Math.min(...heights)], [100, -900]);
});

test("a dense curve covers all its values and no others", () => {
  const random = randomNumbers(9);
  const values = Array.from({ length: 5001 }, () => 50 + 40 * (random() - 0.5));
  const bars = drawn(values, 100).filter(([name]) => name === "rect");
  const tops = bars.map(([, , top]) => top);
  const bottoms = bars.map(([, , top, , height]) => top + height);
  assert.equal(Math.min(...tops), 100 - Math.max(...values) - 0.5);
  assert.equal(Math.max(...bottoms), 100 - Math.min(...values) + 0.5);
});

test("bars side by side touch at the value between them", () => {
  // low in one pixel, high in the next, and the other way round: without a join there would be a hole
  const up = Array.from({ length: 201 }, (_, i) => (i < 100 ? 0 : 80) + ((i * 3) % 10));
  const [, second] = drawn(up, 2).filter(([name]) => name === "rect");
  assert.ok(second[2] + second[4] >= 100 - 9, "the second bar reaches down to the last value of the first one");
  const down = up.map((value) => 90 - value);
  const [, other] = drawn(down, 2).filter(([name]) => name === "rect");
  assert.ok(other[2] <= 100 - 81, "the second bar reaches up to the last value of the first one");
});

test("dots are drawn where they are wanted", () => {
  assert.equal(drawn([1, 2, 3], 100, { hasDots: true }).filter(([name]) => name === "rect").length, 3);
});
