// The units' own verdicts and the scenario's checks, in one list.
import { clipped, h } from "../dom.js";
import { briefText, numberText } from "../data/number_text.js";

/**
 * @typedef {object} Judgement
 * @property {string} name
 * @property {boolean|null} passed null: undecided
 * @property {string} text
 * @property {number|null} time of the first failure [s]
 * @property {{value: number|string, unit: string, at: number}|null} margin to the other verdict
 * @property {{signal: string, value: any, unit?: string}[]} values there
 * @property {number} [line] of the scenario
 */

/** @returns {Judgement[]} failed ones first */
export function judgements(run) {
  const units = (run.verdicts ?? []).map(({ component, passed, text }) => {
    return { name: component, passed, text, time: null, margin: null, values: [] };
  });
  const checks = (run.checks ?? []).map((check) => ({ values: [], margin: null, ...check, time: check.time ?? null }));
  const rank = ({ passed }) => (passed === false ? 0 : passed === null ? 1 : 2);
  return [...checks, ...units].sort((a, b) => rank(a) - rank(b));
}

/** The time of the first failure [s] of each failed one, and the end of a run that failed. */
export function failureTimes(run) {
  const failed = judgements(run).filter(({ passed, time }) => passed === false && time !== null);
  const end = run.outcome === "failed" && Number.isFinite(run.reached) ? [run.reached] : [];
  return [...failed.map(({ time }) => time), ...end];
}

/** The first instant of failure [s]; null if nothing failed, or it is not known when. */
export function firstFailure(run) {
  const times = failureTimes(run);
  return times.length === 0 ? null : Math.min(...times);
}

/**
 * The verdict on the whole run.
 * @returns {{kind: "good"|"bad"|"open"|"none", text: string, failed?: Judgement[], first?: Judgement}} `first`: of those
 * that failed
 */
export function summary(run) {
  const all = judgements(run);
  const failed = all.filter(({ passed }) => passed === false);
  const open = all.filter(({ passed }) => passed === null);
  if (run.outcome === "failed") return { kind: "bad", text: "The run failed" };
  if (run.goesOn) return { kind: "none", text: "Not judged yet: the run goes on" };
  if (run.outcome === "running") return { kind: "open", text: "Not judged: the run was killed, or goes on" };
  if (failed.length > 0) {
    const timed = failed.filter(({ time }) => time !== null);
    const first = timed.length > 0 ? timed.reduce((a, b) => (b.time < a.time ? b : a)) : undefined;
    return { kind: "bad", text: `${failed.length} of ${all.length} failed`, failed, first };
  }
  if (run.outcome === "interrupted") return { kind: "open", text: "Interrupted; nothing failed until then" };
  if (open.length > 0) return { kind: "open", text: `${open.length} of ${all.length} undecided` };
  if (all.length === 0 && !run.outcome) return { kind: "none", text: "Verdicts are not known: there is no run.json" };
  if (all.length === 0) return { kind: "none", text: "Nothing was judged: no checks, and no unit with a verdict" };
  return { kind: "good", text: all.length === 1 ? "Passed" : `All ${all.length} passed` };
}

const kSigns = new Map([
  [true, ["✓", "passed", "good"]],
  [false, ["✗", "failed", "bad"]],
  [null, ["?", "undecided", "open"]],
]);

/** A number by this function, and any other value as it is, with its unit of measure. */
function withUnit({ value, unit }, textOf) {
  return `${typeof value === "number" ? textOf(value) : value}${unit ? ` ${unit}` : ""}`;
}

const valueText = (entry) => `${entry.signal} = ${withUnit(entry, numberText)}`;

/** A button that moves the cursor to a time. */
export function timeLink(view, seconds, text = `${numberText(seconds)} s`, title = "") {
  return h("button.time-link", { type: "button", title, onclick: () => view.holdCursor(seconds) }, text);
}

/** Short, with all digits in its title. */
function marginLink(margin, view) {
  const title = `${withUnit(margin, numberText)} at ${numberText(margin.at)} s`;
  return timeLink(view, margin.at, withUnit(margin, briefText), title);
}

function row({ name, passed, text, time, margin, values, line }, view) {
  const [sign, word, kind] = kSigns.get(passed);
  const there = values.length > 0 ? clipped("div.there", values.map(valueText).join(", ")) : null;
  return h(
    "tr",
    {},
    h(`td.sign.${kind}`, {}, h("span", { title: word, "aria-label": word, role: "img" }, sign)),
    h("th", { scope: "row", title: line ? `${name}: line ${line} of the scenario` : name }, name),
    h("td.number", {}, margin === null ? "" : marginLink(margin, view)),
    h("td.because", {}, clipped("div", text), there),
    h("td.number", {}, time === null ? "" : timeLink(view, time)),
  );
}

export function verdictTable(run, view) {
  const all = judgements(run);
  if (all.length === 0) return null;
  const isTimed = all.some(({ time }) => time !== null);
  const hasMargins = all.some(({ margin }) => margin !== null);
  const heads = ["", "verdict of", hasMargins ? "margin" : "", "because", isTimed ? "first failed at" : ""].map(
    (text) => h("th", { scope: "col" }, text),
  );
  const rows = all.map((judgement) => row(judgement, view));
  return h("table.verdicts", {}, h("thead", {}, h("tr", {}, ...heads)), h("tbody", {}, ...rows));
}
