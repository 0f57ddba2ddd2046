import assert from "node:assert/strict";
import test from "node:test";
import { Column } from "../../../../../../master/report/page/src/campaign/data/column.js";
import { Selection } from "../../../../../../master/report/page/src/campaign/data/selection.js";

const kOutcomes = [0, 1, 0, 5];
const kColumn = new Column("a", "parameter", [1, 2, 3, NaN]);

test("a case is selected that is within all brushes and of a shown outcome", () => {
  const selection = new Selection(kOutcomes);
  assert.ok(selection.isWhole);
  let changes = 0;
  selection.addEventListener("change", () => ++changes);
  selection.brush(kColumn, [2, 3]);
  assert.deepEqual([...selection.mask], [0, 1, 1, 0]);
  selection.toggle(0);
  assert.deepEqual([...selection.mask], [0, 1, 0, 0]);
  assert.equal(selection.count, 1);
  selection.brush(kColumn, null);
  assert.deepEqual([...selection.mask], [0, 1, 0, 1]);
  selection.toggle(0);
  assert.ok(selection.isWhole);
  selection.toggle(1);
  selection.clear();
  assert.ok(selection.isWhole);
  assert.equal(changes, 6);
});

test("two brushes select what is in both", () => {
  const other = new Column("b", "aggregate", [0, 0, 1, 1]);
  const selection = new Selection(kOutcomes);
  selection.brush(kColumn, [-Infinity, 2]);
  selection.brush(other, [0, 0.5]);
  assert.deepEqual([...selection.mask], [1, 1, 0, 0]);
});
