import assert from "node:assert/strict";
import test from "node:test";
import { Column } from "../../../../../master/report/page/src/data/report.js";
import { summaryOf, summaryText } from "../../../../../master/report/page/src/plot/summary.js";

const column = (values, description = {}, texts = undefined) =>
  new Column({ name: "a.b", unit: "V", type: "Float64", stepped: false, ...description }, values, texts, [1, 2, 3, 4]);

test("the value at the beginning of what is shown counts, those after its end do not", () => {
  const { last, least, most } = summaryOf(column([5, 9, 7, 8]), { from: 1.5, until: 3.5 });
  assert.deepEqual([last, least, most], [2, 5, 9]);
  assert.equal(summaryOf(column([5, 9, 7, 8]), { from: 0, until: 0.5 }), null);
});

test("texts are short, and have all digits in the tip", () => {
  const values = column([0.123456, NaN, 2, 1 / 3]);
  assert.deepEqual(summaryText(values, { from: 0, until: 9 }), {
    text: "last 0.3333 · min 0.1235 · max 2 V",
    title: "last 0.3333333333333333, min 0.123456, max 2 V",
  });
  assert.equal(summaryText(column([NaN, NaN, NaN, NaN]), { from: 0, until: 9 }).text, "last nan V");
  assert.equal(summaryText(values, { from: 0, until: 0.5 }).text, "–");
});

test("of states there is the last one", () => {
  const view = { from: 0, until: 3 };
  assert.equal(summaryText(column([0, 1, 1, 0], { type: "Boolean" }), view).text, "last true");
  assert.equal(summaryText(column([0, 1, 0, 1], { type: "String" }, ["on", "off"]), view).text, "last on");
});
