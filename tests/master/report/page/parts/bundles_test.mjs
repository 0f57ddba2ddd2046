import assert from "node:assert/strict";
import test from "node:test";
import { bundles } from "../../../../../master/report/page/src/parts/bundles.js";

const kComponents = ["world", "arm", "arm.motor"].map((name) => ({ name }));
const connect = (from, to, kind = "value") => ({ from, to, kind });

test("connections between the same two components are one bundle, messages another", () => {
  const connections = [
    connect("world.site.x", "arm.x"),
    connect("world.site.y", "arm.y"),
    connect("arm.x", "world.x"),
    connect("world.frame", "arm.frame", "message"),
    connect("world.tick", "arm.tick", "clock"),
  ];
  const found = bundles({ components: kComponents, connections });
  assert.deepEqual(
    found.map(({ from, to, isMessage, connections }) => [from, to, isMessage, connections.length]),
    [
      ["world", "arm", false, 2],
      ["arm", "world", false, 1],
      ["world", "arm", true, 1],
    ],
  );
});

test("a component in a system is found by its whole name", () => {
  const [found] = bundles({ components: kComponents, connections: [connect("arm.motor.torque", "arm.load")] });
  assert.deepEqual([found.from, found.to], ["arm.motor", "arm"]);
});

test("a connector of the whole system is not a component", () => {
  assert.deepEqual(bundles({ components: kComponents, connections: [connect("outside", "arm.x")] }), []);
});
