// What a run is of, in words: when and by which command it began, its settings, what was changed, and the versions.
import { numberText } from "../data/number_text.js";
import { h, clipped } from "../dom.js";

const isText = (value) => typeof value === "string" && value !== "";
const listOf = (value) => (Array.isArray(value) ? value : []);
const secondsText = (seconds) => `${numberText(seconds)} s`;

/** "2026-11-25 23:59:59 UTC on left" */
function beganText({ date, host }) {
  if (!isText(date)) return "";
  const utc = date.replace(/^(\d{4}-\d\d-\d\d)T(\d\d:\d\d:\d\d)Z$/, "$1 $2 UTC");
  return isText(host) ? `${utc} on ${host}` : utc;
}

/** "fixed steps of 0.001 s, coupling jacobi, …" */
function settingsText({ start, stop, step, threads }) {
  const parts = [];
  if (Number.isFinite(start) && Number.isFinite(stop)) parts.push(`${numberText(start)} to ${secondsText(stop)}`);
  if (step) {
    parts.push(`${step.policy} steps of ${secondsText(step.size)}`);
    if (Number.isFinite(step.maximum)) parts.push(`${secondsText(step.maximum)} at most`);
    if (Number.isFinite(step.relative_tolerance)) {
      parts.push(`tolerance ${numberText(step.relative_tolerance)} and ${numberText(step.absolute_tolerance)}`);
    }
    parts.push(`coupling ${step.coupling}`, `extrapolation ${step.extrapolation}`);
  }
  if (threads > 1) parts.push(`${threads} threads`);
  return parts.join(", ");
}

/** "force gauge.u = 0.2 from 20 s to 40 s" */
function interventionText({ kind, variable, from, until, value, delay, bits }) {
  const what = [
    isText(value) ? ` = ${value}` : "",
    Number.isFinite(delay) ? ` by ${secondsText(delay)}` : "",
    Number.isFinite(bits) ? ` in ${bits} ${bits === 1 ? "bit" : "bits"}` : "",
  ];
  const when = kind === "set" ? `at ${secondsText(from)}` : `from ${secondsText(from)}`;
  return `${kind} ${variable}${what.join("")} ${when}${Number.isFinite(until) ? ` to ${secondsText(until)}` : ""}`;
}

/** "stride 0.1.0, 5 units of FMI 3.0, 1 unit of FMI 2.0" */
function versionsText(run, page) {
  const counts = new Map();
  for (const { fmi_version: version } of listOf(run.units)) {
    if (isText(version)) counts.set(version, (counts.get(version) ?? 0) + 1);
  }
  const units = [...counts].map(([version, count]) => `${count} ${count === 1 ? "unit" : "units"} of FMI ${version}`);
  const made = run.provenance?.version;
  const stride = isText(made) ? [`stride ${made}`] : [];
  if (isText(page) && page !== made) stride.push(stride.length > 0 ? `page by stride ${page}` : `stride ${page}`);
  return [...stride, ...units].join(", ");
}

/**
 * What is known of it.
 * @param {{run: object, version: string}} report `version`: of the stride that made the page
 * @returns {[string, string][]} names and texts
 */
export function originOf({ run, version }) {
  const { commands, swaps, values, ...provenance } = run.provenance ?? {};
  const [first, ...others] = listOf(commands).map(({ text }) => text);
  const found = [
    ["scenario", run.scenario],
    ["began", beganText(provenance)],
    ["by", first],
    ...others.map((text) => ["and then", text]),
    ["settings", settingsText(run)],
    ["swapped", listOf(swaps).join(", ")],
    ["set", listOf(values).join(", ")],
    ["interventions", listOf(run.interventions).map(interventionText).join(", ")],
    ["versions", versionsText(run, version)],
  ];
  return found.filter(([, text]) => isText(text));
}

/** One line for each. */
export function origin(report) {
  const lines = originOf(report).flatMap(([name, text]) => [h("dt", {}, name), clipped("dd", text)]);
  return h("dl.origin", {}, ...lines);
}
