import assert from "node:assert/strict";
import test from "node:test";
import { coveredOf, depthOf, matrixOf, stateOf } from "../../../../../master/report/page/src/coverage/bins.js";

const named = (...names) => names.map((name) => ({ name, count: 0 }));

test("pairs are a matrix, in the order in which their parts appear", () => {
  const bins = named("low × on", "low × off", "high × on", "high × off");
  const { down, across, at } = matrixOf({ kind: "cross", bins });
  assert.deepEqual(down, ["low", "high"]);
  assert.deepEqual(across, ["on", "off"]);
  assert.equal(at.get("high").get("on"), bins[2]);
  assert.deepEqual(matrixOf({ kind: "transitions", bins: named("a -> b", "b -> a") }).down, ["a", "b"]);
});

test("what is no pair, or would be mostly empty, is a row", () => {
  assert.equal(matrixOf({ kind: "values", bins: named("a -> b", "b -> a") }), undefined);
  assert.equal(matrixOf({ kind: "cross", bins: named("a × b × c", "a × b × d") }), undefined);
  assert.equal(matrixOf({ kind: "sequences", bins: named("a -> b", "a -> c") }), undefined);
  const diagonal = Array.from({ length: 5 }, (_, i) => `${i} -> ${i}`);
  assert.equal(matrixOf({ kind: "sequences", bins: named(...diagonal) }), undefined);
});

test("ignored bins do not count, and at_least visits are wanted", () => {
  const bins = [{ count: 3 }, { count: 1 }, { count: 0 }, { count: 9, ignored: true }];
  assert.deepEqual(coveredOf({ bins, at_least: 2 }), { covered: 1, all: 3 });
  assert.deepEqual(
    bins.map((bin) => stateOf(bin, 2)),
    ["hit", "few", "missed", "ignored"],
  );
});

test("the depth of a bin grows with its visits up to 1", () => {
  assert.equal(depthOf(1, 1), 1);
  assert.equal(depthOf(100, 100), 1);
  assert.ok(depthOf(1, 100) > 0.1 && depthOf(1, 100) < depthOf(10, 100));
});
