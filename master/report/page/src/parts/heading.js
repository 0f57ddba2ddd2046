// What a page is about, at its top and in its tab.
import { h } from "../dom.js";

/** The first words are all that a narrow tab has room for. @param {string} what "report" */
export const pageTitle = (name, hasFailed, what) => `${hasFailed ? "FAILED: " : ""}${name} – stride ${what}`;

/** @param {string} note beside the name; empty for none */
export function heading(name, hasFailed, note) {
  const failed = hasFailed ? [" ", h("strong.failed", {}, "FAILED")] : [];
  const beside = note === "" ? [] : [" ", h("span.outcome", {}, note)];
  return h("h1", {}, name, ...failed, ...beside);
}
