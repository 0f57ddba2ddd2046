import assert from "node:assert/strict";
import test from "node:test";
import { apartText, labelOf, linesOf } from "../../../../../master/report/page/src/coverage/section.js";

const point = { at_least: 2 };

test("a bin says how often it was visited, and when first", () => {
  assert.deepEqual(linesOf({ name: "[0, 1)", count: 3, first: 1.25 }, point), ["[0, 1)", "3 visits", "first at 1.25 s"]);
  assert.deepEqual(linesOf({ name: "on", count: 1, first: 0, case: 7 }, point), [
    "on",
    "1 visit",
    "not visited often enough",
    "first at 0 s of case 7",
  ]);
});

test("a bin that was not visited, or does not count, says so", () => {
  assert.deepEqual(linesOf({ name: "on", count: 0 }, point), ["on", "not visited"]);
  assert.deepEqual(linesOf({ name: "NaN", count: 0, ignored: true }, point), ["NaN", "does not count"]);
});

test("points of one name are told apart by their definitions", () => {
  const points = [
    { name: "y", definition: "0123456789abcdef" },
    { name: "y", definition: "fedcba9876543210" },
    { name: "u", definition: "0011223344556677" },
  ];
  assert.deepEqual(
    points.map((entry) => labelOf(entry, points)),
    ["y@01234567", "y@fedcba98", "u"],
  );
});

test("a point that not all runs have alike says in how many it is, and why", () => {
  const why = "others define it otherwise";
  assert.equal(apartText({ runs: 3, first_case: 4, why }, { cases: 8 }), `3 of 8 cases, from case 4 on: ${why}`);
  assert.equal(apartText({ runs: 1, why }, { runs: 2 }), `1 of 2 runs: ${why}`);
  assert.equal(apartText({ runs: 1, first_case: 0, why }, { runs: 9, cases: 8 }), `1 of 9 runs, from case 0 on: ${why}`);
});
