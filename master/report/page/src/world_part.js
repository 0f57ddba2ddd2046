// What pages with worlds have in addition to the others: a script, which is packed in their data.
import { unpack } from "./data/blob.js";
import { h } from "./dom.js";

/**
 * Runs it, once. Throws where this browser cannot.
 * @param {import("./data/blob.js").Packed} packed its text
 * @returns {Promise<typeof import("./world/main.js")>}
 */
export async function loadWorldPart(packed) {
  if (window.strideWorld) return window.strideWorld; // in a live page
  const bytes = await unpack(packed);
  document.head.append(h("script", { textContent: new TextDecoder().decode(bytes) }));
  if (!window.strideWorld) throw new Error("its script does not run in this browser");
  return window.strideWorld;
}
