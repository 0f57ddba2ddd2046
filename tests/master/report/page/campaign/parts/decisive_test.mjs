import assert from "node:assert/strict";
import test from "node:test";
import { byStrength, isClear } from "../../../../../../master/report/page/src/campaign/parts/decisive.js";

const found = (value, low, high) => ({ value, confidence: low === undefined ? null : [low, high] });

test("a correlation is clear whose interval does not contain 0", () => {
  assert.ok(isClear(found(0.5, 0.1, 0.8)));
  assert.ok(isClear(found(-0.5, -0.8, -0.1)));
  assert.ok(!isClear(found(0.5, -0.1, 0.8)));
  assert.ok(!isClear(found(1)));
});

test("what decides most of failures is first, then of aggregates and margins, then what is not known", () => {
  const entry = (parameter, failure, ...numbers) => ({
    parameter,
    failure: found(failure),
    aggregates: numbers.slice(0, 1).map((value) => found(value)),
    margins: numbers.slice(1).map((value) => found(value)),
  });
  const order = (...entries) => byStrength(entries).map(({ parameter }) => parameter);
  assert.deepEqual(order(entry(0, 0.1, 1), entry(1, -0.9, 0)), [1, 0]);
  assert.deepEqual(
    order(entry(0, null, null), entry(1, null, 0.1, -0.3), entry(2, null, 0.2), entry(3, 0)),
    [3, 1, 2, 0],
  );
});
