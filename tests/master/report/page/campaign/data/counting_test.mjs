import assert from "node:assert/strict";
import test from "node:test";
import { Column } from "../../../../../../master/report/page/src/campaign/data/column.js";
import { countFailures, countOutcomes } from "../../../../../../master/report/page/src/campaign/data/counting.js";

const kX = new Column("x", "parameter", [1, 1, 2, 2, 2, NaN]);
const kY = new Column("y", "parameter", [5, 6, 5, 5, 6, 5]);
const kOutcomes = [0, 1, 3, 0, 5, 1];

test("outcomes are counted by bins, those of selected cases only", () => {
  const bins = kX.bins(8);
  assert.deepEqual(countOutcomes(kX, bins, kOutcomes, [1, 1, 1, 1, 1, 1]), [
    [1, 1, 0, 0, 0, 0],
    [1, 0, 0, 1, 0, 1],
  ]);
  assert.deepEqual(countOutcomes(kX, bins, kOutcomes, [0, 1, 0, 0, 0, 0])[0], [0, 1, 0, 0, 0, 0]);
});

test("whatever has not passed is a failure, and what is missing is no case", () => {
  const cells = countFailures([kX, kX.bins(8)], [kY, kY.bins(8)], kOutcomes, [1, 1, 1, 1, 1, 1]);
  assert.deepEqual(cells, [
    [
      { cases: 1, failed: 0 },
      { cases: 2, failed: 1 },
    ],
    [
      { cases: 1, failed: 1 },
      { cases: 0, failed: 0 },
    ],
  ]);
});
