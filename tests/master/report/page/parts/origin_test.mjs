import assert from "node:assert/strict";
import test from "node:test";
import { originOf } from "../../../../../master/report/page/src/parts/origin.js";

const kStep = { policy: "fixed", size: 0.001, minimum: 1e-9, coupling: "jacobi", extrapolation: "hold" };
const kRun = {
  scenario: "tank.ssd",
  start: 0,
  stop: 30,
  step: kStep,
  threads: 1,
  units: [{ fmi_version: "3.0" }, { fmi_version: "2.0" }, { fmi_version: "3.0" }],
  interventions: [],
  provenance: {
    version: "0.1.0",
    date: "2026-11-25T23:59:59Z",
    host: "left",
    commands: [{ text: "stride run tank.ssd", words: [], folder: "/a" }],
    swaps: [],
    values: [],
  },
};
const origin = (changes = {}, version = "0.1.0") => originOf({ run: { ...kRun, ...changes }, version });
const textOf = (name, ...rest) => Object.fromEntries(origin(...rest))[name];

test("what a run is of, from run.json", () => {
  assert.deepEqual(origin(), [
    ["scenario", "tank.ssd"],
    ["began", "2026-11-25 23:59:59 UTC on left"],
    ["by", "stride run tank.ssd"],
    ["settings", "0 to 30 s, fixed steps of 0.001 s, coupling jacobi, extrapolation hold"],
    ["versions", "stride 0.1.0, 2 units of FMI 3.0, 1 unit of FMI 2.0"],
  ]);
});

test("what was other than the scenario has it", () => {
  const provenance = { ...kRun.provenance, swaps: ["sensor=mine.fmu", "a=b.fmu"], values: ["tank.inflow=0.002"] };
  assert.equal(textOf("swapped", { provenance }), "sensor=mine.fmu, a=b.fmu");
  assert.equal(textOf("set", { provenance }), "tank.inflow=0.002");
  const interventions = [
    { kind: "set", variable: "a.x", from: 3, value: "0.2" },
    { kind: "force", variable: "a.x", from: 20, until: 40, value: "0.2" },
    { kind: "delay", variable: "b.m", from: 1, delay: 0.5 },
    { kind: "corrupt", variable: "b.m", from: 1, until: 2, bits: 1, header: 0, seed: 7 },
  ];
  assert.equal(
    textOf("interventions", { interventions }),
    "set a.x = 0.2 at 3 s, force a.x = 0.2 from 20 s to 40 s, delay b.m by 0.5 s from 1 s, " +
      "corrupt b.m in 1 bit from 1 s to 2 s",
  );
});

test("settings that are not the usual ones", () => {
  const step = { ...kStep, policy: "error", maximum: 0.1, relative_tolerance: 1e-4, absolute_tolerance: 1e-6 };
  assert.equal(
    textOf("settings", { step, threads: 4 }),
    "0 to 30 s, error steps of 0.001 s, 0.1 s at most, tolerance 1e-04 and 1e-06, coupling jacobi, " +
      "extrapolation hold, 4 threads",
  );
});

test("a run that was resumed has all its commands, a page made later its own version", () => {
  const commands = [...kRun.provenance.commands, { text: "stride resume results/tank" }];
  const names = origin({ provenance: { ...kRun.provenance, commands } }).map(([name]) => name);
  assert.deepEqual(names, ["scenario", "began", "by", "and then", "settings", "versions"]);
  assert.match(textOf("versions", {}, "0.2.0"), /^stride 0.1.0, page by stride 0.2.0, 2 units/);
});

test("what is not known is left out", () => {
  assert.deepEqual(originOf({ run: {}, version: "0.1.0" }), [["versions", "stride 0.1.0"]]);
  assert.deepEqual(originOf({ run: {}, version: undefined }), []);
  assert.equal(textOf("began", { provenance: { version: "1" } }), undefined);
});
