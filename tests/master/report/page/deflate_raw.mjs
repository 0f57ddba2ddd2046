// What browsers have and Node.js before 20.12 has not: streams that inflate data without a header.
import { Duplex } from "node:stream";
import { createInflateRaw } from "node:zlib";

try {
  new DecompressionStream("deflate-raw");
} catch {
  globalThis.DecompressionStream = class {
    constructor() {
      return Duplex.toWeb(createInflateRaw());
    }
  };
}
