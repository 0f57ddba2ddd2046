// A choice of a column.
import { h } from "../../dom.js";

const kGroups = { parameter: "parameters", aggregate: "aggregates", margin: "margins", time: "times" };

function groupOf(role, options) {
  const found = options.filter(({ column }) => column.role === role);
  if (found.length === 0) return null;
  const entries = found.map(({ column, place }) => h("option", { value: String(place) }, column.name));
  return h("optgroup", { label: kGroups[role] }, ...entries);
}

/**
 * @param {string} label
 * @param {import("../data/column.js").Column[]} columns
 * @param {(column: any) => void} choose called with the column, or null for the first entry, if that has a text
 * @param {{first?: string, chosen?: import("../data/column.js").Column}} [options]
 */
export function columnChoice(label, columns, choose, { first, chosen } = {}) {
  const options = columns.map((column, place) => ({ column, place }));
  const select = h(
    "select",
    { "aria-label": label, onchange: () => choose(select.value === "" ? null : columns[Number(select.value)]) },
    first === undefined ? null : h("option", { value: "" }, first),
    ...Object.keys(kGroups).map((role) => groupOf(role, options)),
  );
  if (chosen) select.value = String(columns.indexOf(chosen));
  return h("label.choice", {}, `${label} `, select);
}
