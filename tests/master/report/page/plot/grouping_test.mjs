import assert from "node:assert/strict";
import test from "node:test";
import { groupIntoPanes, groupOthers } from "../../../../../master/report/page/src/plot/grouping.js";

const column = (name, unit, isState = false) => [name, { name, unit, isState }];

test("a pane has one unit of measure; states have rows of their own", () => {
  const columns = new Map([column("a", "V"), column("b", "W"), column("c", "V"), column("on", "", true)]);
  const panes = groupIntoPanes({ plots: [{ title: "Power", signals: ["a", "b", "on", "c", "unknown"] }], columns });
  const found = panes.map(({ title, isStates, columns }) => [title, isStates, columns.map(({ name }) => name)]);
  assert.deepEqual(found, [
    ["Power", false, ["a", "c"]],
    ["Power", false, ["b"]],
    ["Power", true, ["on"]],
  ]);
});

test("what is checked and in no plot has panes of its own, failed first", () => {
  const columns = new Map([column("a", "V"), column("b", "V"), column("c", "V"), column("d", "V")]);
  const checks = [
    { passed: true, limits: { signal: "a" } },
    { passed: true, limits: { signal: "b" } },
    { passed: false, limits: { signal: "c" } },
    { passed: false },
  ];
  const report = { run: { checks }, plots: [{ title: "X", signals: ["a"] }], columns, units: [] };
  const found = (panes) => panes.map(({ title, columns }) => [title, columns.map(({ name }) => name)]);
  assert.deepEqual(found(groupIntoPanes(report)), [
    ["Failed checks", ["c"]],
    ["X", ["a"]],
    ["Checks", ["b"]],
  ]);
  assert.deepEqual(found(groupOthers(report)), [["d", ["d"]]]);
});

test("a system does not take the signals of what it holds, whichever is told first", () => {
  const columns = new Map([column("a.b.x", "V"), column("a.y", "V"), column("z", "")]);
  for (const units of [["a.b", "a"], ["a", "a.b"]]) {
    const titles = groupOthers({ plots: [], columns, units }).map(({ title }) => title);
    assert.deepEqual(titles, ["a.b", "a", "z"]);
  }
});

test("signals that no plot shows are gathered by component", () => {
  const columns = new Map([column("a.x", "V"), column("a.y", "V"), column("b.c.z", ""), column("b.w", "")]);
  const panes = groupOthers({ plots: [{ title: "X", signals: ["a.x"] }], columns, units: ["a", "b", "b.c"] });
  const found = panes.map(({ title, columns }) => [title, columns.map(({ name }) => name)]);
  assert.deepEqual(found, [
    ["a", ["a.y"]],
    ["b.c", ["b.c.z"]],
    ["b", ["b.w"]],
  ]);
});
