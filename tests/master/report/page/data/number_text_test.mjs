import assert from "node:assert/strict";
import test from "node:test";
import { briefText, numberText } from "../../../../../master/report/page/src/data/number_text.js";
import { randomNumbers } from "../random.mjs";

// what std::to_chars writes of these doubles
const kTexts = [
  [0, "0"],
  [-0, "-0"],
  [1, "1"],
  [-2.5, "-2.5"],
  [0.1, "0.1"],
  [0.001, "0.001"],
  [0.0001, "1e-04"],
  [0.00012, "0.00012"],
  [0.00033, "0.00033"],
  [3.3e-5, "3.3e-05"],
  [6.5595934200032925e-6, "6.5595934200032925e-06"],
  [0.00032799967100016465, "0.00032799967100016465"],
  [9.999999999999999e-6, "9.999999999999999e-06"],
  [100, "100"],
  [1000, "1000"],
  [10000, "10000"],
  [100000, "1e+05"],
  [500000, "5e+05"],
  [123456, "123456"],
  [1234567.5, "1234567.5"],
  [1e21, "1e+21"],
  [1e22, "1e+22"],
  [123456789012345680, "123456789012345680"],
  [1e300, "1e+300"],
  [5e-324, "5e-324"],
  [1.7976931348623157e308, "1.7976931348623157e+308"],
  [9007199254740993, "9007199254740992"],
  [NaN, "nan"],
  [Infinity, "inf"],
  [-Infinity, "-inf"],
];

test("doubles are written as in signals.csv", () => {
  for (const [value, text] of kTexts) assert.equal(numberText(value), text);
});

test("numbers of single precision have their own shortest text", () => {
  assert.equal(numberText(Math.fround(0.1), true), "0.1");
  assert.equal(numberText(Math.fround(0.1)), "0.10000000149011612");
  assert.equal(numberText(3055711.25, true), "3055711.2");
  assert.equal(numberText(Math.fround(16777216), true), "16777216");
  assert.equal(numberText(Math.fround(3.4028234663852886e38), true), "3.4028235e+38");
});

test("each text is read back as its number", () => {
  const random = randomNumbers(1);
  for (let i = 0; i < 20000; ++i) {
    const value = (random() - 0.5) * 10 ** Math.floor(random() * 60 - 30);
    assert.equal(Number(numberText(value)), value);
    const single = Math.fround(value);
    assert.equal(Math.fround(Number(numberText(single, true))), single);
  }
});

test("for people four digits do", () => {
  assert.equal(briefText(30), "30");
  assert.equal(briefText(0.996774581), "0.9968");
  assert.equal(briefText(15234.56), "15,234.56");
  assert.equal(briefText(0.0000659), "0.0000659");
  assert.equal(briefText(0), "0");
});
