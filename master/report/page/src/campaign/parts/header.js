// The top of the page: the campaign, how many cases passed, and its checks.
import { briefText } from "../../data/number_text.js";
import { h } from "../../dom.js";
import { heading } from "../../parts/heading.js";
import { hasFailed, kMissing, kOutcomes } from "../data/outcomes.js";

const numberOf = (count) => count.toLocaleString("en");

/**
 * What the page says first.
 * @param {{cases: number}[]} outcomes
 * @returns {{kind: "good"|"bad"|"open", text: string}}
 */
export function verdictOf(outcomes) {
  const all = outcomes.reduce((sum, { cases }) => sum + cases, 0);
  const failed = outcomes.reduce((sum, { cases }, i) => sum + (hasFailed(i) ? cases : 0), 0);
  const missing = outcomes[kMissing].cases;
  const verb = (count) => (count === 1 ? "has" : "have");
  if (failed > 0)
    return { kind: "bad", text: `${numberOf(failed)} of ${numberOf(all)} cases ${verb(failed)} not passed` };
  if (missing === all) return { kind: "open", text: "No case has been run" };
  if (missing > 0) return { kind: "open", text: `All ${numberOf(all - missing)} cases that have been run passed` };
  return { kind: "good", text: all === 1 ? "The case passed" : `All ${numberOf(all)} cases passed` };
}

function missingNote({ campaign, outcomes }) {
  const missing = outcomes[kMissing].cases;
  if (missing === 0) return null;
  const be = missing === 1 ? "case is" : "cases are";
  const text = `${numberOf(missing)} of ${numberOf(campaign.cases)} ${be} missing. The campaign goes on with `;
  return h("p.warning", {}, text, h("code", {}, `stride campaign run ${campaign.file}`), ".");
}

function sampleNote({ campaign, count }) {
  if (count === campaign.cases) return null;
  return h(
    "p.warning",
    {},
    `Of ${numberOf(campaign.cases)} cases this page holds ${numberOf(count)}, chosen at random from equal parts of the ` +
      "plan. The numbers above are those of all; cases.csv has each.",
  );
}

function outcomeBar(outcomes) {
  const parts = outcomes.map(({ cases }, i) =>
    cases === 0 ? null : h("span", { style: { flexGrow: cases, background: `var(${kOutcomes[i].color})` } }),
  );
  return h("div.outcome-bar", { "aria-hidden": "true" }, ...parts);
}

function checkTable(checks) {
  if (checks.length === 0) return null;
  const row = ({ name, kind, passed, failed, undecided }) =>
    h(
      "tr",
      {},
      h("td", {}, h(`span.sign.${failed > 0 ? "bad" : "good"}`, {}, failed > 0 ? "✗" : "✓")),
      h("th", { scope: "row" }, name),
      h("td", {}, kind === "" ? "verdict of the unit" : kind),
      ...[passed, failed, undecided].map((count) => h("td.number", {}, numberOf(count))),
    );
  const heads = ["", "check", "", "passed", "failed", "undecided"];
  return h(
    "div.scroll",
    {},
    h(
      "table.checks",
      {},
      h("thead", {}, h("tr", {}, ...heads.map((text) => h("th", { scope: "col" }, text)))),
      h("tbody", {}, ...checks.map(row)),
    ),
  );
}

function numbersOf({ campaign, outcomes, wall_time }) {
  const counted = outcomes
    .filter(({ cases }, i) => cases > 0 || i < 2)
    .map(({ name, cases }) => [name, numberOf(cases)]);
  const all = [["cases", numberOf(campaign.cases)], ...counted, ["wall time of all", `${briefText(wall_time)} s`]];
  return all.map(([what, text]) => h("div", {}, h("dt", {}, what), h("dd", {}, text)));
}

export function header(report, switchTheme) {
  const { campaign } = report;
  const verdict = verdictOf(report.outcomes);
  const seed = campaign.random_seed === null ? "" : `, random seed ${campaign.random_seed}`;
  const origin = [campaign.file, `of ${campaign.scenario}`, `${campaign.sampling}${seed}`, `stride ${report.stride}`];
  return h(
    "header",
    {},
    h("button.theme", { type: "button", onclick: switchTheme, title: "light or dark (d)" }, "◐"),
    heading(campaign.name, verdict.kind === "bad", "campaign"),
    h("p.origin", {}, origin.join(" · ")),
    h(`p.banner.${verdict.kind}`, { role: "status" }, h("strong", {}, verdict.text)),
    outcomeBar(report.outcomes),
    h("dl.numbers", {}, ...numbersOf(report)),
    missingNote(report),
    sampleNote(report),
    checkTable(report.checks),
  );
}
