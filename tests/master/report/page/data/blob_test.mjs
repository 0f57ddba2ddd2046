import assert from "node:assert/strict";
import test from "node:test";
import { deflateRawSync } from "node:zlib";
import "../deflate_raw.mjs";
import { unpack, untransposed } from "../../../../../master/report/page/src/data/blob.js";

/** What the program does, element by element. */
function pack(type, array, perElement = 1) {
  const width = array.BYTES_PER_ELEMENT * perElement;
  const count = array.length / perElement;
  const plain = new Uint8Array(array.buffer);
  const bytes = [];
  for (let k = 0; k < width; ++k) for (let i = 0; i < count; ++i) bytes.push(plain[i * width + k]);
  return { type, count, data: deflateRawSync(Uint8Array.from(bytes)).toString("base64") };
}

test("doubles come back bit by bit", async () => {
  const values = Float64Array.of(0, -0, 1 / 3, NaN, Infinity, -Infinity, 5e-324, Number.MAX_VALUE);
  assert.deepEqual(new Uint8Array((await unpack(pack("float64", values))).buffer), new Uint8Array(values.buffer));
});

test("integers come back at their limits", async () => {
  const long = BigInt64Array.of(0n, -1n, 2n ** 63n - 1n, -(2n ** 63n), 14200358702064n);
  assert.deepEqual(await unpack(pack("int64", long)), long);
  const short = Int32Array.of(0, -1, 2 ** 31 - 1, -(2 ** 31));
  assert.deepEqual(await unpack(pack("int32", short)), short);
  const bytes = Uint8Array.of(0, 1, 255);
  assert.deepEqual(await unpack(pack("uint8", bytes)), bytes);
});

test("times that need more than 64 bits come back", async () => {
  const times = [3_155_760_000_000_000_000_001n, -3_155_760_000_000_000_000_001n, 0n, -1n, 2n ** 64n, 2n ** 63n - 1n];
  const halves = times.flatMap((time) => [BigInt.asIntN(64, time), time >> 64n]);
  assert.deepEqual(await unpack(pack("int128", BigInt64Array.from(halves), 2)), times);
});

test("no elements are no trouble", async () => {
  assert.equal((await unpack(pack("float64", new Float64Array(0)))).length, 0);
});

test("arrays longer than a piece of base64 come back", async () => {
  const values = Float64Array.from({ length: 400_000 }, (_, i) => Math.sin(i * i));
  const packed = pack("float64", values);
  assert.ok(packed.data.length > 2 << 20);
  assert.deepEqual(await unpack(packed), values);
});

test("an array of another length than it says is refused", async () => {
  const packed = pack("int32", Int32Array.of(1, 2, 3));
  await assert.rejects(unpack({ ...packed, count: 4 }), /12 bytes, expected 16/);
  await assert.rejects(unpack({ ...packed, count: 2 }), /more than its 8 bytes/);
});

test("an unknown type is refused by its name", async () => {
  await assert.rejects(unpack({ type: "float16", count: 0, data: "" }), /unknown type "float16"/);
});

test("the bytes of an element are gathered", () => {
  assert.deepEqual(untransposed(Uint8Array.of(1, 2, 3, 4, 5, 6), 3, 2), Uint8Array.of(1, 4, 2, 5, 3, 6));
});
