import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";
import { actionOf, kBindings } from "../../../../master/report/page/src/keys.js";
import { kMouse } from "../../../../master/report/page/src/parts/help.js";
import { kWorldMouse } from "../../../../master/report/page/src/world/mouse.js";

const documented = () => readFileSync(new URL("../../../../docs/report.md", import.meta.url), "utf8");

test("arrows move by samples, by ten with Shift", () => {
  assert.deepEqual(actionOf({ key: "ArrowRight" }), { action: "moveBySamples", argument: 1 });
  assert.deepEqual(actionOf({ key: "ArrowLeft", shiftKey: true }), { action: "moveBySamples", argument: -10 });
});

test("letters and signs mean what the help says", () => {
  assert.deepEqual(actionOf({ key: "n" }), { action: "moveByMessages", argument: 1 });
  assert.deepEqual(actionOf({ key: "p" }), { action: "moveByMessages", argument: -1 });
  assert.deepEqual(actionOf({ key: "+", shiftKey: true }), { action: "zoom", argument: 0.5 });
  assert.deepEqual(actionOf({ key: "-" }), { action: "zoom", argument: 2 });
  assert.deepEqual(actionOf({ key: "0" }), { action: "showWhole", argument: undefined });
  assert.deepEqual(actionOf({ key: "?", shiftKey: true }), { action: "showHelp", argument: undefined });
});

test("what the browser needs is left to it", () => {
  assert.equal(actionOf({ key: "0", ctrlKey: true }), undefined);
  assert.equal(actionOf({ key: "ArrowLeft", altKey: true }), undefined);
  assert.equal(actionOf({ key: "Tab" }), undefined);
  assert.equal(actionOf({ key: "ArrowDown" }), undefined);
});

test("no key means two things", () => {
  const keys = kBindings.flatMap((binding) => binding.keys);
  assert.equal(new Set(keys).size, keys.length);
});

test("docs/report.md has all keys", () => {
  const rows = documented().match(/^\| `[^|]*\|/gm);
  const keys = rows.flatMap((row) => [...row.matchAll(/`([^`]+)`/g)].map(([, key]) => key));
  assert.deepEqual(keys.sort(), kBindings.map(({ shown }) => shown).sort());
});

/** The first column of the table in docs/report.md that begins with this head. */
function firstColumn(head) {
  const [, table] = documented().match(new RegExp(`^\\| ${head} \\|.*\\n\\|---.*\\n((?:\\|.*\\n)+)`, "m"));
  return [...table.matchAll(/^\| ([^|]+) \|/gm)].map(([, what]) => what);
}

test("docs/report.md and the help have all that the mouse does", () => {
  const names = kMouse.map(([what]) => what.replace(" + ", " and "));
  assert.ok(names.includes("Shift and wheel"));
  assert.deepEqual(firstColumn("mouse"), names);
  assert.deepEqual(
    firstColumn("in the world"),
    kWorldMouse.map(([what]) => what.replace(" + ", " and ")),
  );
});
