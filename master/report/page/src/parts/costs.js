// The cost of each unit, in wall-clock time.
import { briefText } from "../data/number_text.js";
import { h } from "../dom.js";

const kPhases = [
  ["initialization", "--cost-1"],
  ["steps", "--cost-2"],
  ["events", "--cost-3"],
];

const seconds = (value) => (value >= 0.0005 ? value.toFixed(3) : value > 0 ? "< 0.001" : "0");

/** The time for which a unit was suspended [s]. */
export const idleText = (unit) => (unit.idle ? briefText(unit.idle.skipped) : "");

const total = (unit) => kPhases.reduce((sum, [name]) => sum + (unit.wall_time?.[name] ?? 0), 0);

function bar(unit, most) {
  const parts = kPhases.map(([name, color]) => {
    const width = `${((unit.wall_time?.[name] ?? 0) / most) * 100}%`;
    return h("span", { style: { width, background: `var(${color})` }, title: name });
  });
  return h("div.bar", { "aria-hidden": "true" }, ...parts);
}

function row(unit, most) {
  const cells = kPhases.map(([name]) => h("td.number", {}, seconds(unit.wall_time?.[name] ?? 0)));
  const counts = [unit.calls, unit.steps, unit.events, unit.rejections, unit.rollbacks];
  return h(
    "tr",
    {},
    h("th", { scope: "row", title: unit.model ?? "" }, unit.name),
    h("td.bar-cell", {}, bar(unit, most)),
    h("td.number.total", {}, seconds(total(unit))),
    ...cells,
    ...counts.map((count) => h("td.number", {}, (count ?? 0).toLocaleString("en"))),
    h("td.number", {}, idleText(unit)),
  );
}

const bytes = (count) => `${briefText(count / 1000)} kB`;

/** Where the units ran that were on other machines, and what their links cost: a line for each. */
export function linkTexts(units) {
  const elsewhere = units.filter((unit) => unit.host?.link);
  return elsewhere.map(({ name, host: { machine, link } }) => {
    const traffic = `${bytes(link.sent)} there, ${bytes(link.received)} back`;
    const count = link.round_trips.toLocaleString("en");
    return `${name} ran on ${machine}: ${count} round trips (${traffic}), ${seconds(link.lost_time)} s lost to the network.`;
  });
}

/** The wall-clock time of the run that belongs to no unit: the master's own work. */
function restText(run) {
  if (!Number.isFinite(run.wall_time)) return "The run ended without its counts and times.";
  const rest = run.wall_time - run.units.reduce((sum, unit) => sum + total(unit), 0);
  const phases = Object.entries(run.phases ?? {}).map(([name, value]) => `${name} ${seconds(value)} s`);
  const texts = [`The run took ${seconds(run.wall_time)} s`];
  if (rest >= 0) texts.push(`, of which ${seconds(rest)} s were no unit’s`);
  texts.push(".");
  if (phases.length > 0) texts.push(` By phase: ${phases.join(", ")}.`);
  if (run.threads > 1) texts.push(" Units were stepped at the same time, so theirs add up to more than that.");
  return texts.join("");
}

export function costs(run) {
  const units = run.units ?? [];
  if (units.length === 0 || run.goesOn) return null;
  const most = Math.max(...units.map(total), Number.MIN_VALUE);
  const swatch = ([name, color]) =>
    h("th", { scope: "col" }, h("span.dot", { style: { background: `var(${color})` } }), `${name} [s]`);
  const rest = ["calls", "steps", "events", "rejected", "undone", "idle [s]"].map((text) =>
    h("th", { scope: "col" }, text),
  );
  const head = h(
    "tr",
    {},
    h("th", { scope: "col" }, "unit"),
    h("th", { scope: "col" }, "wall time"),
    h("th", { scope: "col" }, "all [s]"),
    ...kPhases.map(swatch),
    ...rest,
  );
  const table = h("table.costs", {}, h("thead", {}, head), h("tbody", {}, ...units.map((unit) => row(unit, most))));
  return h(
    "section",
    { "aria-label": "Cost" },
    h("h2", {}, "What each unit cost"),
    h("p.note", {}, restText(run)),
    ...linkTexts(units).map((text) => h("p.note", {}, text)),
    h("div.scroll", { tabIndex: 0 }, table),
  );
}
