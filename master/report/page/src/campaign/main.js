// The page of a campaign: reads its data, creates the parts, and connects them.
import { coverageSection } from "../coverage/section.js";
import { h } from "../dom.js";
import { pageTitle } from "../parts/heading.js";
import { Theme } from "../parts/theme.js";
import { Tip } from "../parts/tip.js";
import { startPage } from "../start.js";
import { readCampaign } from "./data/campaign.js";
import { Selection } from "./data/selection.js";
import { CaseTable } from "./parts/case_table.js";
import { decisiveSection } from "./parts/decisive.js";
import { header, verdictOf } from "./parts/header.js";
import { HeatMap, mappable } from "./parts/heat_map.js";
import { histogramSection } from "./parts/histograms.js";
import { origin } from "./parts/origin.js";
import { Parallel } from "./parts/parallel.js";
import { Scatter } from "./parts/scatter.js";
import { SelectionBar } from "./parts/selection_bar.js";

const isTaken = (target) => target instanceof Element && target.closest("input, select, textarea") !== null;

function listenToKeys(theme, selection) {
  document.addEventListener("keydown", (event) => {
    if (isTaken(event.target) || event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.key === "d") theme.switch();
    if (event.key === "Escape") selection.clear();
  });
}

/** Not of a case that the page does not hold. */
function coverage({ report, tip, showCase }) {
  const show = (bin) => {
    const row = report.cases.indices.indexOf(bin.case);
    if (row >= 0) showCase(row);
  };
  const note = "What all cases together have exercised. A click on a bin goes to the case that was the first to visit it.";
  return coverageSection(report.coverage, { tip, show, note });
}

/** Printed pages are light. */
function printWell(theme, draw) {
  let chosen = null;
  window.addEventListener("beforeprint", () => {
    chosen = theme.chosen;
    theme.choose("light");
    draw();
  });
  window.addEventListener("afterprint", () => theme.choose(chosen));
}

function build(report) {
  const theme = new Theme();
  const selection = new Selection(report.cases.outcomes);
  const tip = new Tip();
  const table = new CaseTable({ report, selection });
  const context = { report, selection, tip, showCase: (row) => table.showCase(row) };
  const bar = new SelectionBar(context);
  const scatter = new Scatter(context);
  const parallel = new Parallel(context);
  const isMapped = mappable(report.parameters).length > 1;
  document.title = pageTitle(report.campaign.name, verdictOf(report.outcomes).kind === "bad", "campaign");
  const parts = [
    header(report, () => theme.switch()),
    decisiveSection(report),
    bar.box,
    h(isMapped ? "div.pair" : "div", {}, scatter.box, isMapped ? new HeatMap(context).box : null),
    histogramSection(context),
    parallel.columns.length > 1 ? parallel.box : null,
    coverage(context),
    table.box,
    origin(report),
    tip.box,
  ];
  document.getElementById("report").replaceChildren(...parts.filter(Boolean));
  const drawn = [bar, scatter, ...(parallel.columns.length > 1 ? [parallel] : [])];
  const draw = () => drawn.forEach((part) => part.draw());
  draw();
  theme.addEventListener("change", draw);
  new ResizeObserver(() => (scatter.redraw(), parallel.columns.length > 1 && parallel.redraw())).observe(scatter.box);
  listenToKeys(theme, selection);
  printWell(theme, draw);
  return { report, selection, scatter, parallel, table, theme };
}

startPage("Reading the campaign", readCampaign, build);
