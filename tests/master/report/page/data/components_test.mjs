import assert from "node:assert/strict";
import test from "node:test";
import { componentOf, nameWithin, ownerOf } from "../../../../../master/report/page/src/data/components.js";

const kComponents = new Set(["a.b", "a"]);

test("a name belongs to the longest component that it begins with", () => {
  assert.equal(componentOf("a.b.x", kComponents), "a.b");
  assert.equal(componentOf("a.c.x", kComponents), "a");
  assert.equal(componentOf("a.bx", kComponents), "a");
  assert.equal(componentOf("ab.x", kComponents), null);
  assert.equal(componentOf("a", kComponents), null);
});

test("without a component it is what stands before the first point", () => {
  assert.equal(ownerOf("a.b.x", kComponents), "a.b");
  assert.equal(ownerOf("c.d.x", kComponents), "c");
  assert.equal(ownerOf("x", kComponents), "x");
});

test("what a name is called within its component", () => {
  assert.equal(nameWithin("a.b.x", kComponents), "x");
  assert.equal(nameWithin("a.c.x", kComponents), "c.x");
  assert.equal(nameWithin("c.x", kComponents), "x");
  assert.equal(nameWithin("x", kComponents), "x");
});
