import assert from "node:assert/strict";
import test from "node:test";
import {
  byComponent,
  kMarkWidth,
  layOut,
  shortText,
} from "../../../../../master/report/page/src/lanes/message_layout.js";
import { randomNumbers } from "../random.mjs";

const message = (seconds, content = "identify") => ({ seconds, content, payload: "00" });
const kView = { from: 0, until: 10 };

test("messages apart have their own marks and texts", () => {
  const marks = layOut([message(1), message(5, "set_led 1")], kView, 1000);
  assert.deepEqual(
    marks.map(({ x, text, more }) => [x, text, more]),
    [
      [100, "identify", ""],
      [500, "set_led 1", ""],
    ],
  );
});

test("messages at one place share a mark that tells how many there are", () => {
  const [mark] = layOut([message(1, "first"), message(1), message(1.001)], kView, 1000);
  assert.deepEqual([mark.text, mark.more, mark.messages.length], ["first", "+2", 3]);
});

test("a text that has no room is left out, the mark is not", () => {
  const marks = layOut([message(1), message(1.2)], kView, 1000);
  assert.deepEqual(
    marks.map(({ text }) => text),
    ["", "identify"],
  );
});

test("what is out of sight has no mark", () => {
  assert.equal(layOut([message(-1), message(11)], kView, 1000).length, 0);
});

test("no message is lost, and no mark lies on another or on its text", () => {
  const random = randomNumbers(8);
  for (let i = 0; i < 200; ++i) {
    const count = Math.floor(random() * 300);
    const messages = Array.from({ length: count }, () => message(random() * 10)).sort((a, b) => a.seconds - b.seconds);
    const marks = layOut(messages, kView, 100 + random() * 1500);
    assert.deepEqual(
      marks.flatMap((mark) => mark.messages),
      messages,
    );
    for (const [m, mark] of marks.entries()) {
      assert.equal(mark.more, mark.messages.length > 1 ? `+${mark.messages.length - 1}` : "");
      if (m > 0) assert.ok(mark.x - marks[m - 1].x >= kMarkWidth + (marks[m - 1].more ? 7 : 0));
      if (m > 0 && marks[m - 1].text) assert.ok(marks[m - 1].x + kMarkWidth + marks[m - 1].room <= mark.x);
    }
  }
});

test("bytes stand for what nobody knows to read, cut where they are many", () => {
  assert.equal(shortText({ content: "", payload: "00e8" }), "00e8");
  assert.equal(shortText({ content: "", payload: "00e83066e90500006a00" }), "00e83066e9050000…");
});

test("each component has its own messages", () => {
  const lanes = byComponent([{ component: "a" }, { component: "b" }, { component: "a" }]);
  assert.deepEqual(
    [...lanes].map(([name, messages]) => [name, messages.length]),
    [
      ["a", 2],
      ["b", 1],
    ],
  );
});
