// What the use case has exercised of each component: a map of bins for each point.
import { briefText } from "../data/number_text.js";
import { h } from "../dom.js";
import { coveredOf, depthOf, matrixOf, stateOf } from "./bins.js";

const percent = (value) => (value === undefined || value === null ? "" : `${Math.floor(value * 10) / 10} %`);
const visits = (count) => (count === 1 ? "1 visit" : `${count.toLocaleString("en")} visits`);

const kStates = {
  ignored: "does not count",
  missed: "not visited",
  few: "not visited often enough",
};

/** What the tip says of a bin. */
export function linesOf(bin, point) {
  const lines = [bin.name];
  if (bin.count > 0) lines.push(visits(bin.count));
  const state = kStates[stateOf(bin, point.at_least)];
  if (state) lines.push(state);
  if (bin.first === undefined) return lines;
  const at = `first at ${briefText(bin.first)} s`;
  lines.push(bin.case === undefined ? at : `${at} of case ${bin.case}`);
  return lines;
}

/** @param {{tip: object, show: (bin: object) => void}} context `show` shows the first visit of a bin */
function cell(bin, point, most, { tip, show }) {
  if (bin === undefined) return h("span.bin.none");
  const lines = linesOf(bin, point);
  const cover = h(`button.bin.${stateOf(bin, point.at_least)}`, {
    type: "button",
    "aria-label": lines.join(", "),
    style: bin.count > 0 && !bin.ignored ? { "--depth": `${Math.round(35 + 65 * depthOf(bin.count, most))}%` } : {},
    onclick: () => bin.first !== undefined && show(bin),
    onmouseenter: () => tip.show(cover, lines),
    onmouseleave: () => tip.hide(),
    onfocus: () => tip.show(cover, lines),
    onblur: () => tip.hide(),
  });
  return cover;
}

function map(point, context) {
  const most = Math.max(1, ...point.bins.map(({ count }) => count));
  const matrix = matrixOf(point);
  if (matrix === undefined) return h("div.bins", {}, ...point.bins.map((bin) => cell(bin, point, most, context)));
  const row = (name) =>
    h(
      "tr",
      {},
      h("th", { scope: "row" }, name),
      ...matrix.across.map((other) => h("td", {}, cell(matrix.at.get(name).get(other), point, most, context))),
    );
  return h(
    "table.bin-matrix",
    {},
    h("thead", {}, h("tr", {}, h("td"), ...matrix.across.map((name) => h("th", { scope: "col" }, name)))),
    h("tbody", {}, ...matrix.down.map(row)),
  );
}

/** "field: values of field_power [W]" */
function meaningOf({ kind, signal, unit, of }) {
  if (kind === "cross") return `cross of ${of.join(" and ")}`;
  return `${kind} of ${signal}${unit ? ` [${unit}]` : ""}`;
}

/** The name, and behind it a part of the definition where another point has the same name. */
export function labelOf(point, points) {
  const isAlone = points.every((other) => other === point || other.name !== point.name);
  return isAlone ? point.name : `${point.name}@${point.definition.slice(0, 8)}`;
}

/** "3 of 8 cases, from case 4 on: …" of a point that not all runs have alike. */
export function apartText({ runs, first_case: first, why }, { runs: all, cases }) {
  const what = (all ?? cases) === cases ? "cases" : "runs";
  return `${runs} of ${all ?? cases ?? 1} ${what}${first === undefined ? "" : `, from case ${first} on`}: ${why}`;
}

function apartNote(point, component, coverage) {
  const apart = (coverage.told_apart ?? []).find(
    (entry) => entry.component === component && entry.definition === point.definition,
  );
  return apart === undefined ? null : h("span.there", {}, apartText(apart, coverage));
}

function pointRow(point, { component, points }, coverage, context) {
  const { covered, all } = coveredOf(point);
  const count = point.open ? `${covered}` : `${covered} of ${all}`;
  return h(
    "tr",
    {},
    h(
      "th",
      { scope: "row" },
      labelOf(point, points),
      h("span.there", {}, meaningOf(point)),
      apartNote(point, component, coverage),
    ),
    h("td.bin-cell", {}, point.bins.length === 0 ? h("span.there", {}, "nothing was seen") : map(point, context)),
    h("td.number", {}, count),
    h("td.number", {}, point.open ? h("span.there", {}, "open") : percent(point.percentage)),
  );
}

function group(covered, coverage, context) {
  const { component, goal, percentage, points } = covered;
  const isMissed = goal !== undefined && goal !== null && (percentage ?? 0) < goal;
  const goalText = goal === undefined || goal === null ? "" : ` of a goal of ${percent(goal)}`;
  return h(
    "div.covergroup",
    {},
    h(
      "h3",
      {},
      component,
      h(isMissed ? "span.group-share.bad" : "span.group-share", {}, `${percent(percentage)}${goalText}`),
    ),
    h(
      "div.scroll",
      { tabIndex: 0, role: "region", "aria-label": `Coverage of ${component}` },
      h(
        "table.coverage",
        {},
        h(
          "thead",
          {},
          h("tr", {}, ...["point", "bins", "covered", "share"].map((text) => h("th", { scope: "col" }, text))),
        ),
        h("tbody", {}, ...points.map((point) => pointRow(point, covered, coverage, context))),
      ),
    ),
  );
}

/**
 * @param {object|undefined} coverage as coverage.json has it
 * @param {{tip: object, show: (bin: object) => void, note: string}} context
 */
export function coverageSection(coverage, context) {
  if (coverage === undefined || coverage.groups.length === 0) return null;
  return h(
    "section.coverage-section",
    { "aria-label": "Coverage" },
    h("h2", {}, "Coverage"),
    h("p.note", {}, context.note),
    ...coverage.groups.map((entry) => group(entry, coverage, context)),
  );
}
