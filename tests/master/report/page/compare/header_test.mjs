import assert from "node:assert/strict";
import test from "node:test";
import { settingsText, shortNames } from "../../../../../master/report/page/src/compare/parts/header.js";

test("folders are called by the parts of their paths in which they differ", () => {
  assert.deepEqual(shortNames("before", "after"), ["before", "after"]);
  assert.deepEqual(shortNames("/work/x/before/", "/work/x/after"), ["before", "after"]);
  assert.deepEqual(shortNames("cases/1/results", "cases/2/results"), ["1/results", "2/results"]);
  assert.deepEqual(shortNames("same", "./same"), ["same", "same"]);
  assert.deepEqual(shortNames("/", "/x"), ["/", "x"]);
});

const kExact = { absolute: 0, relative: 0, signals: [], time: null, only: [], ignored: [], golden: false };

test("what counts as equal is in words", () => {
  assert.equal(settingsText(kExact), "no tolerance");
  assert.equal(settingsText({ ...kExact, absolute: 0.5 }), "tolerance 0.5");
  const all = {
    absolute: 1e-9,
    relative: 1e-3,
    signals: [{ signal: "tank.*", absolute: 0, relative: 0.1 }],
    time: 0.01,
    only: ["a", "b"],
    ignored: ["c"],
    golden: true,
  };
  assert.equal(
    settingsText(all),
    "tolerance 1e-09 and 0.001 of the value in B; tank.*: tolerance 0.1 of the value in B; instants within 0.01 s; " +
      "only a, b; without c; B is a reference: only what it has is compared",
  );
});
