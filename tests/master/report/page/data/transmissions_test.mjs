import assert from "node:assert/strict";
import test from "node:test";
import { transmissionsOf } from "../../../../../master/report/page/src/data/transmissions.js";
import { randomNumbers } from "../random.mjs";

const message = (time, name, direction, payload = "01", index = 1) => {
  const [component, variable] = name.split(".");
  return { time: BigInt(time), seconds: time, index, component, variable, direction, payload };
};
const link = (from, to, kind = "message") => ({ from, to, kind });
const kLinks = [link("a.out", "b.in"), link("a.out", "c.in"), link("d.out", "b.in")];

/** "a.out → b.in, c.in" for each. */
const ends = (messages, links = kLinks) =>
  transmissionsOf(messages, links).map(({ sent, received, intervention }) => {
    const name = (each) => `${each.component}.${each.variable}`;
    return intervention ? name(intervention) : `${sent ? name(sent) : ""} → ${received.map(name).join(", ")}`;
  });

test("a message that is sent and received is one, however many receive it", () => {
  const messages = [message(1, "a.out", "sent"), message(1, "b.in", "received"), message(1, "c.in", "received")];
  assert.deepEqual(ends(messages), ["a.out → b.in, c.in"]);
});

test("what goes to another variable, at another instant, or has other bytes is not the same", () => {
  const sent = message(1, "a.out", "sent");
  for (const other of [
    message(1, "d.in", "received"),
    message(2, "b.in", "received"),
    message(1, "b.in", "received", "01", 2),
    message(1, "b.in", "received", "02"),
  ]) {
    assert.equal(ends([sent, other]).length, 2);
  }
  assert.deepEqual(ends([sent]), ["a.out → "]);
  assert.deepEqual(ends([message(2, "b.in", "received")]), [" → b.in"]);
});

test("a variable that receives two equal messages at an instant has one from each sender", () => {
  const messages = [
    message(1, "a.out", "sent"),
    message(1, "d.out", "sent"),
    message(1, "b.in", "received"),
    message(1, "b.in", "received"),
  ];
  assert.deepEqual(ends(messages), ["a.out → b.in", "d.out → b.in"]);
});

test("without connections another component with the same bytes is the receiver", () => {
  const messages = [message(1, "a.out", "sent"), message(1, "a.in", "received"), message(1, "z.in", "received")];
  assert.deepEqual(ends(messages, []), ["a.out → z.in", " → a.in"]);
  assert.deepEqual(ends(messages, [link("a.x", "z.x", "value")]), ["a.out → z.in", " → a.in"]);
});

test("an intervention is for itself", () => {
  assert.deepEqual(ends([message(1, "a.out", "intervention"), message(1, "a.out", "sent")]), ["a.out", "a.out → "]);
});

test("no message is lost, and none is shown twice", () => {
  const random = randomNumbers(4);
  const names = ["a.out", "d.out", "b.in", "c.in"];
  const messages = Array.from({ length: 500 }, (_, i) => {
    const name = names[Math.floor(random() * 4)];
    return message(Math.floor(i / 6), name, name.endsWith("out") ? "sent" : "received", random() < 0.5 ? "01" : "02");
  });
  const found = transmissionsOf(messages, kLinks).flatMap(({ sent, received }) => [sent, ...received].filter(Boolean));
  assert.equal(found.length, messages.length);
  assert.deepEqual(new Set(found), new Set(messages));
});
