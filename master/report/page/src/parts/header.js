// The top of the page: the scenario of the run, its outcome, and its numbers.
import { h } from "../dom.js";
import { keyNumbers } from "./numbers.js";
import { summary, timeLink, verdictTable } from "./verdicts.js";

function banner({ kind, text, first }, view) {
  const where = first ? [" – first at ", timeLink(view, first.time), `: ${first.text}`] : [];
  return h(`p.banner.${kind}`, { role: "status" }, h("strong", {}, text), ...where);
}

function outcomeText(run) {
  const reached = Number.isFinite(run.reached) ? ` at ${run.reached} s` : "";
  if (!run.outcome) return "without run.json";
  return run.outcome === "completed" ? "completed" : `${run.outcome}${reached}`;
}

export function header({ report, view }) {
  const { run } = report;
  const numbers = keyNumbers(report).map(([what, text]) => h("div", {}, h("dt", {}, what), h("dd", {}, text)));
  return h(
    "header",
    {},
    h("h1", {}, run.system ?? "A run", " ", h("span.outcome", {}, outcomeText(run))),
    h("p.origin", {}, run.scenario ?? "", report.version ? ` · stride ${report.version}` : ""),
    banner(summary(run), view),
    run.error ? h("pre.error", {}, run.error) : null,
    verdictTable(run, view),
    h("dl.numbers", {}, ...numbers),
  );
}
