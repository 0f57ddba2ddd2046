// Arrays in the report's format: little-endian, the bytes of the elements transposed, deflated, in base64.

/**
 * @typedef {object} Packed
 * @property {"float64"|"int128"|"int64"|"int32"|"uint8"|"strings"} type
 * @property {number} [count]
 * @property {string} [data] base64
 * @property {string[]} [values] of type "strings": the distinct ones
 * @property {Packed} [indices] of type "strings": the index of each element in `values`
 */

const kArrays = { float64: Float64Array, int64: BigInt64Array, int32: Int32Array, uint8: Uint8Array };

/**
 * Characters of base64 that are decoded at once: a multiple of 4, and few enough for no noticeable delay.
 */
const kPiece = 1 << 20;

function bytesOf(base64) {
  const binary = atob(base64);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

function compressedStream(base64) {
  let position = 0;
  return new ReadableStream({
    pull(controller) {
      if (position >= base64.length) return controller.close();
      controller.enqueue(bytesOf(base64.slice(position, position + kPiece)));
      position += kPiece;
    },
  });
}

/** The inflated bytes; throws if their number is not the expected one. */
async function inflate(base64, size) {
  const bytes = new Uint8Array(size);
  const reader = compressedStream(base64).pipeThrough(new DecompressionStream("deflate-raw")).getReader();
  let filled = 0;
  for (let piece = await reader.read(); !piece.done; piece = await reader.read()) {
    if (filled + piece.value.length > size) throw new Error(`an array has more than its ${size} bytes`);
    bytes.set(piece.value, filled);
    filled += piece.value.length;
  }
  if (filled !== size) throw new Error(`an array has ${filled} bytes, expected ${size}`);
  return bytes;
}

/** Reverts the transposition: byte `k` of element `i` is at `k * count + i`. */
export function untransposed(bytes, count, width) {
  if (width === 1) return bytes;
  const elements = new Uint8Array(bytes.length);
  for (let k = 0; k < width; ++k) {
    const from = k * count;
    for (let i = 0, to = k; i < count; ++i, to += width) elements[to] = bytes[from + i];
  }
  return elements;
}

/** @param {BigInt64Array} halves of each number the low one, then the high one */
function joined(halves) {
  const numbers = [];
  for (let i = 0; i < halves.length; i += 2) numbers.push((halves[i + 1] << 64n) | BigInt.asUintN(64, halves[i]));
  return numbers;
}

/**
 * The array of a packed one that does not contain strings.
 * @param {Packed} packed
 * @returns {Promise<Float64Array|BigInt64Array|bigint[]|Int32Array|Uint8Array>}
 */
export async function unpack(packed) {
  if (packed.type === "int128") {
    const bytes = await inflate(packed.data, packed.count * 16);
    return joined(new BigInt64Array(untransposed(bytes, packed.count, 16).buffer));
  }
  const type = kArrays[packed.type];
  if (!type) throw new Error(`an array is of the unknown type "${packed.type}"`);
  const width = type.BYTES_PER_ELEMENT;
  const bytes = await inflate(packed.data, packed.count * width);
  return new type(untransposed(bytes, packed.count, width).buffer);
}
