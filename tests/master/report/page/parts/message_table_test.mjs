import assert from "node:assert/strict";
import test from "node:test";
import { matching } from "../../../../../master/report/page/src/parts/message_table.js";

const kMessages = [
  {
    time: 14_200_000_000_000n,
    component: "reader",
    variable: "transmit.frame",
    direction: "sent",
    content: "set_led 1",
    payload: "03",
  },
  {
    time: 15_050_000_000_000n,
    component: "sensor",
    variable: "receive.frame",
    direction: "received",
    content: "",
    payload: "ab",
  },
];
const found = (text, direction = "") => matching(kMessages, text, direction).map(({ component }) => component);

test("all words must be there, in whatever case and order", () => {
  assert.deepEqual(found(""), ["reader", "sensor"]);
  assert.deepEqual(found("LED reader"), ["reader"]);
  assert.deepEqual(found("led sensor"), []);
  assert.deepEqual(found("reader.transmit"), ["reader"]);
  assert.deepEqual(found("15.05"), ["sensor"]);
  assert.deepEqual(found("ab"), ["sensor"]);
});

test("one direction can be left out", () => {
  assert.deepEqual(found("", "sent"), ["reader"]);
});
