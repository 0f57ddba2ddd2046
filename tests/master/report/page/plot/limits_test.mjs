import assert from "node:assert/strict";
import test from "node:test";
import { limitsOf, withLimits } from "../../../../../master/report/page/src/plot/limits.js";

const check = (kind, limits, passed = false) => ({
  kind,
  passed,
  limits: { signal: "a.b", from: null, to: null, ...limits },
});

/** Of samples at 0, 1, 2 … s. */
function limits(checks, values, description = {}) {
  const seconds = Float64Array.from(values, (_, i) => i);
  const report = { run: { checks }, seconds, whole: { from: 0, until: values.length - 1 } };
  return limitsOf(report, { name: "a.b", type: "Float64", isState: false, values, ...description });
}

function violated(one, values, description) {
  const [found] = limits([one], values, description);
  return [...found.violated.from].map((from, i) => [from, found.violated.until[i]]);
}

test("limits are those of the checks of this signal, with their interval", () => {
  const checks = [
    check("always", { min: 1, below: 5, to: 2 }, true),
    check("count", { signal: "c" }),
    { kind: "answer" },
  ];
  const found = limits(checks, [1, 2, 3, 9]);
  assert.equal(found.length, 1);
  assert.deepEqual(
    { ...found[0], violated: found[0].violated.count },
    {
      name: "",
      isFailed: false,
      lines: [1, 5],
      allowed: { least: 1, most: 5 },
      from: 0,
      until: 2,
      violated: 0,
    },
  );
  assert.deepEqual(limits([check("always", { equals: 3, tolerance: 1 })], [3])[0].lines, [2, 4]);
  assert.deepEqual(limits([check("never", { equals: 3 })], [4])[0].lines, [3]);
  assert.deepEqual(limits([check("always", { equals: true })], [1], { type: "Boolean", isState: true })[0].lines, []);
  assert.equal(limits([check("final", { equals: 3 })], [3, 4])[0].from, 1);
});

test("always is violated from a sample that is not within the limits until the next one", () => {
  assert.deepEqual(violated(check("always", { max: 3 }), [1, 4, 5, 2, 4, 3]), [
    [1, 3],
    [4, 5],
  ]);
  assert.deepEqual(violated(check("always", { above: 3 }), [4, 3, 4]), [[1, 2]]);
  assert.deepEqual(violated(check("always", { min: 3 }), [4, NaN, 4]), [[1, 2]]);
  assert.deepEqual(violated(check("always", { min: 3, from: 1, to: 2.5 }), [0, 4, 0, 0]), [[2, 2.5]]);
  assert.deepEqual(violated(check("always", { min: 3 }, null), [0, 0]), []);
});

test("never is violated where the condition holds, eventually in its whole interval, final at its instant", () => {
  assert.deepEqual(violated(check("never", { min: 3 }), [4, 2, 3, 1]), [
    [0, 1],
    [2, 3],
  ]);
  assert.deepEqual(violated(check("eventually", { min: 3, from: 1 }), [0, 1, 2]), [[1, 2]]);
  assert.deepEqual(violated(check("final", { min: 3 }), [0, 1, 2]), [[2, 2]]);
});

test("what a check allows is between its limits; never allows what is outside of them", () => {
  const allowed = (kind, condition) => limits([check(kind, condition)], [1])[0].allowed;
  assert.deepEqual(allowed("always", { min: 1, above: 2 }), { least: 2, most: Infinity });
  assert.deepEqual(allowed("final", { equals: 3, tolerance: 1, max: 3.5 }), { least: 2, most: 3.5 });
  assert.equal(allowed("never", { min: 1 }), null);
});

test("each type is compared as what it is", () => {
  assert.deepEqual(violated(check("always", { equals: true }), [1, 0, 1], { type: "Boolean" }), [[1, 2]]);
  assert.deepEqual(violated(check("always", { equals: "on" }), [0, 1, 0], { type: "String", texts: ["on", "off"] }), [
    [1, 2],
  ]);
  const tenth = Math.fround(0.1);
  assert.deepEqual(violated(check("always", { max: tenth }), [0.1, 0.2, 0.1], { type: "Float32" }), [[1, 2]]);
});

test("the range of a pane has limits in it that are near, or have failed", () => {
  const range = (least, most, limits) => {
    const found = withLimits({ least, most, leastPositive: Infinity }, limits);
    return [found.least, found.most];
  };
  const lines = (...lines) => [{ lines }];
  assert.deepEqual(range(1, 3, lines(4, 5.5, -2)), [1, 4]);
  assert.deepEqual(range(1, 3, [{ lines: [50], isFailed: true }]), [1, 50]);
  assert.deepEqual(range(2, 2, lines(0.5)), [0.5, 2]);
  assert.deepEqual(range(Infinity, -Infinity, lines(1)), [Infinity, -Infinity]);
});

test("on a logarithmic axis a limit is near within a decade, and zero where zeros are", () => {
  const range = (least, limits) => withLimits({ least, most: 1, leastPositive: 1e-3 }, limits, true);
  const lines = (...lines) => [{ lines }];
  assert.deepEqual(range(1e-3, lines(1e-5, 2e-4, 5, 20, 0)), { least: 2e-4, most: 5, leastPositive: 2e-4 });
  assert.deepEqual(range(0, lines(0, -1)), { least: 0, most: 1, leastPositive: 1e-3 });
  assert.deepEqual(range(1e-3, [{ lines: [0], isFailed: true }]), { least: 0, most: 1, leastPositive: 1e-3 });
});
