import assert from "node:assert/strict";
import test from "node:test";
import { fitted, fittedName } from "../../../../../master/report/page/src/campaign/plot/axis.js";

const pen = { measureText: (text) => ({ width: text.length }) };

test("a text is cut at its end, a name at its beginning", () => {
  assert.equal(fitted(pen, "arm.offset.wrist_1", 18), "arm.offset.wrist_1");
  assert.equal(fittedName(pen, "arm.offset.wrist_1", 18), "arm.offset.wrist_1");
  assert.equal(fitted(pen, "arm.offset.wrist_1", 8), "arm.off…");
  assert.equal(fittedName(pen, "arm.offset.wrist_1", 8), "…wrist_1");
  assert.equal(fittedName(pen, "arm", 1), "…m");
});
