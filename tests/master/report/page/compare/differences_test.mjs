import assert from "node:assert/strict";
import test from "node:test";
import { mostImportant } from "../../../../../master/report/page/src/compare/parts/differences.js";

test("how the runs ended, and what was demanded of them, come first, and the others in their order", () => {
  const kinds = ["message", "signal", "check", "event", "verdict", "signal", "outcome", "file"];
  const differences = kinds.map((kind, place) => ({ kind, place }));
  assert.deepEqual(
    mostImportant(differences).map(({ place }) => place),
    [2, 4, 6, 0, 1, 3, 5, 7],
  );
});
