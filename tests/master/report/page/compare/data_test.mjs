import assert from "node:assert/strict";
import test from "node:test";
import { overlay, readComparison, unitedTimes } from "../../../../../master/report/page/src/compare/data.js";
import { Column } from "../../../../../master/report/page/src/data/report.js";

test("instants of both are there once, in their order", () => {
  const united = (a, b) => [...unitedTimes(BigInt64Array.from(a), BigInt64Array.from(b))];
  assert.deepEqual(united([0n, 2n, 5n], [1n, 2n, 7n, 8n]), [0n, 1n, 2n, 5n, 7n, 8n]);
  assert.deepEqual(united([], [3n]), [3n]);
  assert.deepEqual(united([3n, 3n], []), [3n]);
  assert.deepEqual(unitedTimes([2n ** 70n, 2n ** 71n], BigInt64Array.of(1n)), [1n, 2n ** 70n, 2n ** 71n]);
});

const column = (type, texts) => new Column({ name: "x.y", unit: "V", type, stepped: false }, [0, 1], texts, [0, 1]);

test("both curves share a pane, but not with texts", () => {
  const [pane, ...others] = overlay("x.y", column("Float64"), column("Float32"));
  assert.equal(others.length, 0);
  assert.deepEqual(pane.columns.map(({ name, type }) => `${name} ${type}`), ["A Float64", "B Float32"]);
  assert.deepEqual([pane.title, pane.unit, pane.isStates], ["x.y", "V", false]);
  const mixed = overlay("x.y", column("String", ["on", "off"]), column("Float64"));
  assert.deepEqual(mixed.map(({ isStates, columns }) => `${isStates} ${columns[0].name}`), ["false B", "true A"]);
});

test("a signal that only one has is shown alone", () => {
  assert.deepEqual(overlay("x.y", undefined, column("Boolean")).map(({ columns }) => columns.length), [1]);
});

test("an original keeps its name", () => {
  const original = column("Float64");
  assert.equal(overlay("x.y", original, undefined)[0].columns[0].textAt(1), "1");
  assert.equal(original.name, "x.y");
});

test("data of another format is refused", async () => {
  const data = { format: 99, comparison: { differences: [] }, a: {}, b: {} };
  await assert.rejects(readComparison(data, () => {}), /format 99/);
});
