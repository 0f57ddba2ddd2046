import assert from "node:assert/strict";
import test from "node:test";
import {
  byComponent,
  gatherCrowds,
  kBar,
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

const placeIn = (width) => (each) => (each.seconds / 10) * width;
const gathered = (messages, width) => gatherCrowds(layOut(messages, kView, width), placeIn(width));

test("marks that stand close, for many messages each, are a crowd with bars", () => {
  const messages = Array.from({ length: 400 }, (_, i) => message(2 + i / 100)).concat(message(9));
  const [crowd, alone, ...others] = gathered(messages, 1000);
  assert.deepEqual(others, []);
  assert.deepEqual([crowd.x, crowd.width, crowd.messages.length], [200, 400, 400]);
  assert.deepEqual(crowd.bars.slice(0, 2), [
    { x: 0, count: 4 },
    { x: kBar, count: 4 },
  ]);
  assert.equal(alone.text, "identify");
});

test("a few marks, or marks of single messages, are none", () => {
  const burst = Array.from({ length: 30 }, (_, i) => message(5 + i / 100));
  assert.ok(gathered(burst, 1000).every(({ bars }) => bars === undefined));
  const row = Array.from({ length: 60 }, (_, i) => message(i / 6));
  assert.ok(gathered(row, 1000).every(({ bars, messages }) => bars === undefined && messages.length === 1));
});

test("no message is lost in a crowd, and each has its place in a bar", () => {
  const random = randomNumbers(9);
  for (let i = 0; i < 100; ++i) {
    const count = Math.floor(random() * 3000);
    const messages = Array.from({ length: count }, () => message(random() * random() * 10));
    messages.sort((a, b) => a.seconds - b.seconds);
    const width = 100 + random() * 1500;
    const entries = gathered(messages, width);
    assert.deepEqual(
      entries.flatMap((entry) => entry.messages),
      messages,
    );
    for (const { x, width: wide, messages: held, bars } of entries.filter((entry) => entry.bars)) {
      assert.equal(
        bars.reduce((sum, bar) => sum + bar.count, 0),
        held.length,
      );
      assert.ok(x <= placeIn(width)(held[0]) && placeIn(width)(held.at(-1)) < x + wide);
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
