// The top of the page: the scenario of the run, its outcome, and its numbers.
import { h } from "../dom.js";
import { heading } from "./heading.js";
import { keyNumbers } from "./numbers.js";
import { origin } from "./origin.js";
import { summary, timeLink, verdictTable } from "./verdicts.js";

/** One line; what is cut off has its place in the table below. */
function banner({ kind, text, failed = [], first }, view) {
  const names = failed.map(({ name }) => name).join(", ");
  const why = first ? [" – first at ", timeLink(view, first.time), `: ${first.name}: ${first.text}`] : [];
  const which = failed.length > 0 && !first ? `: ${names}` : "";
  const title = [names, first?.text].filter(Boolean).join(": ");
  return h(`p.banner.clipped.${kind}`, { role: "status", title }, h("strong", {}, text), which, ...why);
}

function outcomeText(run, hasFailed) {
  const reached = Number.isFinite(run.reached) ? `at ${run.reached} s` : "";
  if (!run.outcome) return "without run.json";
  if (run.outcome === "completed") return hasFailed ? "" : "completed";
  if (run.outcome === "running" && !run.goesOn) return reached; // or killed
  return run.outcome === "failed" ? reached : `${run.outcome} ${reached}`;
}

export function header({ report, view }) {
  const { run } = report;
  const verdict = summary(run);
  const hasFailed = verdict.kind === "bad";
  const numbers = keyNumbers(report).map(([what, text]) => h("div", {}, h("dt", {}, what), h("dd", {}, text)));
  return h(
    "header",
    {},
    heading(run.system ?? "A run", hasFailed, outcomeText(run, hasFailed)),
    origin(report),
    banner(verdict, view),
    run.error ? h("pre.error", {}, run.error) : null,
    verdictTable(run, view),
    h("dl.numbers", {}, ...numbers),
  );
}
