import assert from "node:assert/strict";
import test from "node:test";
import { endsOf, matching } from "../../../../../master/report/page/src/parts/message_table.js";

const message = (component, variable, direction, content = "", payload = "03") => ({
  component,
  variable,
  direction,
  content,
  payload,
});
const row = (time, parts) => ({ time, sent: null, received: [], intervention: null, ...parts });
const kRows = [
  row(14_200_000_000_000n, {
    sent: message("reader", "transmit.frame", "sent", "set_led 1"),
    received: [message("channel", "from_reader.frame", "received", "set_led 1")],
  }),
  row(15_050_000_000_000n, { received: [message("sensor", "receive.frame", "received", "", "ab")] }),
  row(16_000_000_000_000n, { sent: message("reader", "report.text", "sent", "no answer") }),
  row(17_000_000_000_000n, { intervention: message("reader", "transmit.frame", "intervention", "drop") }),
];
const found = (text, kind = "") => matching(kRows, text, kind).map((each) => kRows.indexOf(each));

test("all words must be there, in whatever case and order, of sender or receiver", () => {
  assert.deepEqual(found(""), [0, 1, 2, 3]);
  assert.deepEqual(found("LED channel"), [0]);
  assert.deepEqual(found("led sensor"), []);
  assert.deepEqual(found("reader.transmit"), [0, 3]);
  assert.deepEqual(found("15.05"), [1]);
  assert.deepEqual(found("ab"), [1]);
  assert.deepEqual(found("sent"), [0, 2]);
});

test("messages that nobody received can be found, and interventions", () => {
  assert.deepEqual(found("", "received"), [0, 1]);
  assert.deepEqual(found("", "lost"), [2]);
  assert.deepEqual(found("reader", "intervention"), [3]);
});

test("a row says from where to where", () => {
  assert.deepEqual(kRows.map(endsOf), [
    ["reader.transmit.frame", "channel.from_reader.frame"],
    ["–", "sensor.receive.frame"],
    ["reader.report.text", "–"],
    ["reader.transmit.frame", "intervention"],
  ]);
});
