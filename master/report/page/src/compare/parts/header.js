// The top of the page: which runs are compared, whether they differ, and where first.
import { numberText } from "../../data/number_text.js";
import { clipped, h } from "../../dom.js";
import { timeLink } from "../../parts/verdicts.js";

const countText = (count, what) => `${count.toLocaleString("en")} ${what}${count === 1 ? "" : "s"}`;

/** "tolerance 0.001 and 1e-6 of the value in B" */
function toleranceText({ absolute, relative }) {
  const parts = [
    absolute > 0 ? numberText(absolute) : "",
    relative > 0 ? `${numberText(relative)} of the value in B` : "",
  ].filter(Boolean);
  return parts.length === 0 ? "no tolerance" : `tolerance ${parts.join(" and ")}`;
}

/**
 * What counted as equal.
 * @returns {string}
 */
export function settingsText({ time, signals, only, ignored, golden, ...all }) {
  const parts = [toleranceText(all), ...signals.map((rule) => `${rule.signal}: ${toleranceText(rule)}`)];
  if (time !== null) parts.push(`instants within ${numberText(time)} s`);
  if (only.length > 0) parts.push(`only ${only.join(", ")}`);
  if (ignored.length > 0) parts.push(`without ${ignored.join(", ")}`);
  if (golden) parts.push("B is a reference: only what it has is compared");
  return parts.join("; ");
}

/** A message that is both sent and received counts twice. */
const comparedText = (compared) =>
  `${["signal", "row", "message"].map((what) => countText(compared[`${what}s`], what)).join(", ")} sent or received`;

/** One line for each. */
function origin({ comparison, version }) {
  const { a, b, compared, settings } = comparison;
  const lines = [
    ["A", a],
    ["B", b],
    ["compared", comparedText(compared)],
    ["equal within", settingsText(settings)],
    ["version", `stride ${version}`],
  ];
  return h("dl.origin", {}, ...lines.flatMap(([name, text]) => [h("dt", {}, name), clipped("dd", text)]));
}

function banner(differences, view) {
  if (differences.length === 0) return h("p.banner.good", { role: "status" }, h("strong", {}, "Nothing differs"));
  const first = differences.find(({ time }) => time !== null) ?? differences[0];
  const at = first.time === null ? [] : [" at ", timeLink(view, first.time)];
  const text = `${differences.length === 1 ? "One thing differs" : `${countText(differences.length, "thing")} differ`}`;
  return h(
    "p.banner.clipped.bad",
    { role: "status" },
    h("strong", {}, text),
    " – first",
    ...at,
    `: ${first.kind} ${first.name}`,
  );
}

/** What was different before the runs began. */
function inputTable(inputs) {
  if (inputs === null) return h("p.note", {}, "What the runs were made from is not known: one has no run.json.");
  if (inputs.length === 0) return h("p.note", {}, "They were made from the same inputs.");
  const row = ({ kind, name, a, b }) =>
    h("tr", {}, h("td", {}, kind), h("th", { scope: "row" }, name), ...[a, b].map((text) => h("td.value-of", {}, text || "none")));
  const heads = ["input", "", "A", "B"].map((text) => h("th", { scope: "col" }, text));
  return h(
    "section",
    { "aria-label": "Inputs" },
    h("h2", {}, "They were made from other inputs"),
    h("div.scroll", {}, h("table.inputs", {}, h("thead", {}, h("tr", {}, ...heads)), h("tbody", {}, ...inputs.map(row)))),
  );
}

/** The last parts of the paths in which they differ: of "x/before" and "x/after" these are "before" and "after". */
export function shortNames(a, b) {
  const [one, other] = [a, b].map((path) => path.split("/").filter((part) => part !== "" && part !== "."));
  let same = 0;
  while (same < Math.min(one.length, other.length) - 1 && one[same] === other[same]) ++same;
  return [one, other].map((parts) => parts.slice(same).join("/") || "/");
}

export function header(context) {
  const { comparison, view } = context;
  const { differences, inputs } = comparison.comparison;
  const [a, b] = shortNames(comparison.comparison.a, comparison.comparison.b);
  const hasFailed = differences.length > 0;
  const names = [h("span.run-a", {}, a), h("span.against", {}, " and "), h("span.run-b", {}, b)];
  return h(
    "header",
    {},
    h("h1", {}, ...names, " ", hasFailed ? h("strong.failed", {}, "DIFFER") : h("span.outcome", {}, "equal")),
    origin(comparison),
    banner(differences, view),
    inputTable(inputs),
  );
}
