import assert from "node:assert/strict";
import test from "node:test";
import { Column } from "../../../../../../master/report/page/src/campaign/data/column.js";

test("an axis is a little longer than the range of the numbers, and infinities are at its ends", () => {
  const column = new Column("a", "parameter", [-50, 50, NaN, Infinity]);
  assert.deepEqual(column.range, [-53, 53]);
  assert.equal(column.shareOf(-53), 0);
  assert.equal(column.shareOf(0), 0.5);
  assert.equal(column.shareOf(Infinity), 1);
  assert.ok(Number.isNaN(column.shareOf(NaN)));
  assert.equal(column.valueAt(0.5), 0);
  assert.ok(column.varies);
  assert.ok(!new Column("a", "parameter", [3, 3, NaN]).varies);
  assert.deepEqual(new Column("a", "parameter", [10, 10]).range, [9, 11]);
  assert.deepEqual(new Column("a", "parameter", [NaN]).range, [0, 1]);
});

test("a place on an axis has no more digits than can be seen", () => {
  assert.equal(new Column("a", "parameter", [0, 1 / 3]).valueAt(0.5), 0.16667);
  assert.equal(new Column("a", "parameter", [1e9, 4e9]).valueAt(1 / 3), 1_970_000_000);
  assert.equal(new Column("a", "parameter", [1e-30, 3e-30]).valueAt(0.5), 2e-30);
});

test("texts are in an order that counts", () => {
  const column = Column.ofTexts("a", "parameter", [0, 1, 2, 0], ["b10", "b9", "a"]);
  assert.deepEqual(column.categories, ["a", "b9", "b10"]);
  assert.deepEqual([...column.values], [2, 1, 0, 2]);
  assert.equal(column.textAt(0), "b10");
  assert.deepEqual(column.range, [-0.5, 2.5]);
  assert.equal(column.bins(8).of(column.values[1]), 1);
});

test("few numbers have a bin each, many have bins of equal width", () => {
  const few = new Column("a", "parameter", [0.1, 0.3, 0.1]).bins(8);
  assert.deepEqual(few.texts, ["0.1", "0.3"]);
  assert.equal(few.of(0.3), 1);
  assert.equal(few.of(0.2), -1);
  const numbers = Array.from({ length: 101 }, (_, i) => i);
  const many = new Column("a", "parameter", numbers).bins(4);
  assert.equal(many.texts[1], "25 – 50");
  assert.deepEqual([0, 24, 25, 99, 100].map(many.of), [0, 0, 1, 3, 3]);
  assert.deepEqual([NaN, Infinity].map(many.of), [-1, -1]);
});

test("bins of numbers that are nearly alike have all digits", () => {
  const { texts } = new Column("a", "parameter", [1.000001, 1.000002]).bins(8);
  assert.deepEqual(texts, ["1.000001", "1.000002"]);
});

test("what a case leaves as it is in the scenario is said so, of parameters only", () => {
  assert.equal(new Column("a", "parameter", [NaN]).textAt(0), "(as in the scenario)");
  assert.equal(new Column("a", "aggregate", [NaN]).briefAt(0), "");
});

test("an empty text is shown, and is the first one in order", () => {
  const column = Column.ofTexts("a", "parameter", [0, 1], ["b", ""]);
  assert.deepEqual(column.bins(8).texts, ["(empty)", "b"]);
  assert.equal(column.textAt(1), "(empty)");
});
