import assert from "node:assert/strict";
import test from "node:test";
import { Pyramid } from "../../../../../master/report/page/src/plot/pyramid.js";
import { groupTimes, groupValues, rowGroups, rowsInView } from "../../../../../master/report/page/src/plot/thin.js";
import { randomNumbers } from "../random.mjs";

/** Rows at times that are dense here and rare there, with spikes and gaps. */
function makeRows(count, random) {
  const times = new Float64Array(count);
  const values = new Float64Array(count);
  let time = 0;
  for (let i = 0; i < count; ++i) {
    times[i] = time;
    time += random() < 0.01 ? random() * 100 : random() ** 4 + 1e-9;
    const kind = random();
    values[i] = kind < 0.02 ? NaN : kind < 0.03 ? (random() - 0.5) * 1e6 : random();
  }
  return { times, values };
}

function bruteExtremes(values, begin, end) {
  const numbers = [...values.slice(begin, end)].filter((value) => !Number.isNaN(value));
  return { least: Math.min(...numbers), most: Math.max(...numbers) };
}

test("least and most of any rows are those that one finds by looking at all", () => {
  const random = randomNumbers(3);
  for (const count of [1, 3, 4, 5, 16, 17, 63, 64, 65, 1000, 4097]) {
    const { values } = makeRows(count, random);
    const pyramid = new Pyramid(values);
    for (let i = 0; i < 300; ++i) {
      const begin = Math.floor(random() * count);
      const end = begin + Math.floor(random() * (count - begin + 1));
      assert.deepEqual(pyramid.extremes(begin, end), bruteExtremes(values, begin, end));
    }
  }
});

test("rows that are all NaN have neither", () => {
  const { least, most } = new Pyramid(new Float64Array(100).fill(NaN)).extremes(0, 100);
  assert.ok(least > most);
});

/** For each view: the groups, and what is drawn of them. */
function views(count, seed) {
  const random = randomNumbers(seed);
  const { times, values } = makeRows(count, random);
  const pyramid = new Pyramid(values);
  return Array.from({ length: 60 }, (_, i) => {
    const whole = times[count - 1];
    const from = i === 0 ? 0 : random() * whole;
    const until = i === 0 ? whole : from + (whole - from) * random() ** 3 + 1e-6;
    const pixels = 1 + Math.floor(random() * 800);
    const groups = rowGroups(times, from, until, pixels);
    return {
      times,
      values,
      from,
      until,
      pixels,
      groups,
      points: groupValues(pyramid, groups),
      at: groupTimes(times, groups),
    };
  });
}

test("the groups are all rows in view, each once, none across two pixels", () => {
  for (const { times, from, until, pixels, groups } of views(5000, 4)) {
    const { begin, end } = rowsInView(times, from, until);
    assert.equal(groups[0], begin);
    assert.equal(groups.at(-1), end);
    const width = (until - from) / pixels;
    for (let g = 0; g < groups.length; g += 2) {
      assert.ok(groups[g + 1] > groups[g]);
      if (g > 0) assert.equal(groups[g], groups[g - 1]);
      assert.ok(times[groups[g + 1] - 1] - times[groups[g]] <= width * (1 + 1e-9));
    }
  }
});

test("a view draws four points for each pixel at most", () => {
  for (const { points, at, pixels } of views(20000, 5)) {
    assert.equal(points.length, at.length);
    assert.ok(points.length <= 4 * (pixels + 3), `${points.length} points on ${pixels} pixels`);
  }
});

test("no view hides a spike", () => {
  for (const { values, groups, points } of views(20000, 6)) {
    const drawn = points.filter((value) => value !== null);
    const inView = bruteExtremes(values, groups[0], groups.at(-1));
    assert.equal(Math.min(...drawn), inView.least);
    assert.equal(Math.max(...drawn), inView.most);
  }
});

test("each group begins and ends with its own first and last value, and has its extremes between", () => {
  for (const { times, values, groups, points, at } of views(8000, 7)) {
    let p = 0;
    for (let g = 0; g < groups.length; g += 2) {
      const [begin, end] = [groups[g], groups[g + 1]];
      const size = end - begin === 1 ? 1 : 4;
      const shown = points.slice(p, p + size).map((value) => value ?? NaN);
      assert.deepEqual([at[p], at[p + size - 1]], [times[begin], times[end - 1]]);
      assert.deepEqual([shown[0], shown.at(-1)], [values[begin], values[end - 1]]);
      const { least, most } = bruteExtremes(values, begin, end);
      const numbers = shown.filter((value) => !Number.isNaN(value));
      if (numbers.length > 0) assert.deepEqual([Math.min(...numbers), Math.max(...numbers)], [least, most]);
      p += size;
    }
    assert.equal(p, points.length);
  }
});

test("where there are few rows they are drawn as they are, gaps included", () => {
  const times = Float64Array.of(0, 1, 2, 3, 4);
  const groups = rowGroups(times, 0, 4, 100);
  assert.deepEqual(groupTimes(times, groups), [0, 1, 2, 3, 4]);
  assert.deepEqual(groupValues(new Pyramid(Float64Array.of(1, NaN, 3, 4, NaN)), groups), [1, null, 3, 4, null]);
});

test("a pixel that is NaN throughout is a gap", () => {
  const times = Float64Array.from({ length: 100 }, (_, i) => i);
  const values = Float64Array.from(times, (time) => (time >= 50 ? NaN : time));
  const points = groupValues(new Pyramid(values), rowGroups(times, 0, 100, 2));
  assert.deepEqual(points, [0, 0, 49, 49, null, null, null, null]);
});

test("lines go on beyond both ends of the view", () => {
  const times = Float64Array.of(0, 10, 20, 30);
  assert.deepEqual(rowsInView(times, 12, 18), { begin: 1, end: 3 });
  assert.deepEqual(rowsInView(times, 0, 30), { begin: 0, end: 4 });
  assert.deepEqual(rowGroups(new Float64Array(0), 0, 1, 10), []);
});
