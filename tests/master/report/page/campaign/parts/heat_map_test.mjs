import assert from "node:assert/strict";
import test from "node:test";
import { Column } from "../../../../../../master/report/page/src/campaign/data/column.js";
import { mappable } from "../../../../../../master/report/page/src/campaign/parts/heat_map.js";

test("an axis is what varies and has no more than some texts", () => {
  const number = new Column("n", "parameter", [1, 2]);
  const constant = new Column("c", "parameter", [1, 1]);
  const texts = Column.ofTexts("t", "parameter", [0, 1], ["a", "b"]);
  const many = Array.from({ length: 100 }, (_, i) => i);
  const names = Column.ofTexts("m", "parameter", many, many.map(String));
  assert.deepEqual(mappable([number, constant, texts, names]), [number, texts]);
});
