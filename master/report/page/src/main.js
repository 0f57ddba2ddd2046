// The page: reads the run's data, creates the parts, and connects them.
import { actionsOf, printWell } from "./actions.js";
import { coverageSection } from "./coverage/section.js";
import { readReport } from "./data/report.js";
import { h } from "./dom.js";
import { listenToKeys } from "./keys.js";
import { isLive } from "./live/follow.js";
import { buildLivePage } from "./live/page.js";
import { costs } from "./parts/costs.js";
import { diagramSection } from "./parts/diagram.js";
import { header } from "./parts/header.js";
import { pageTitle } from "./parts/heading.js";
import { helpDialog } from "./parts/help.js";
import { provenance } from "./parts/made_from.js";
import { MessageTable } from "./parts/message_table.js";
import { Theme } from "./parts/theme.js";
import { Tip } from "./parts/tip.js";
import { firstFailure, summary } from "./parts/verdicts.js";
import { timeStack } from "./rows.js";
import { startPage } from "./start.js";
import { View } from "./view.js";
import { loadWorldPart } from "./world_part.js";

const coverage = ({ report, view, tip }) =>
  coverageSection(report.coverage, {
    tip,
    show: ({ first }) => view.holdCursor(first),
    note: "What was exercised of it. A click on a bin goes to its first visit.",
  });

/** The share of the run around its first failure that is shown at first. */
const kAroundFailure = 0.2;

/** A run that failed is opened where it did. */
function openAtFailure({ report, view }) {
  const seconds = firstFailure(report.run);
  if (seconds === null) return;
  const half = (view.span * kAroundFailure) / 2;
  view.show(seconds - half, seconds + half);
  view.holdCursor(seconds);
}

/** What is missing or left out, in words. */
function notesBox({ report, view }) {
  const box = h("div");
  const fill = () => box.replaceChildren(...report.notes.map((text) => h("p.warning", {}, text)));
  view.addEventListener("data", fill);
  fill();
  return box;
}

/** The top, which is made anew with other data if it is another one then. */
function headerBox(context) {
  let shown = header(context);
  context.view.addEventListener("data", () => {
    const now = header(context);
    if (now.isEqualNode(shown)) return;
    shown.replaceWith(now);
    shown = now;
  });
  return shown;
}

function messageTable(context) {
  if (context.report.messages.length === 0) return null;
  const table = new MessageTable(context);
  context.view.addEventListener("data", () => table.update());
  return table.box;
}

/**
 * @param {object} [options] of a page that is made anew in the course of its run
 * @param {AbortSignal} [options.signal] that it listens no longer
 * @param {Theme} [options.theme] that was there before
 * @param {HTMLElement} [options.top] above all else
 */
function build(report, { signal, theme = new Theme(), top = null } = {}) {
  const view = new View(report.whole);
  const tip = new Tip();
  const { worldPart } = report;
  const player = worldPart && new worldPart.Player(view);
  const context = { report, view, tip, player, worldPart };
  const help = helpDialog(worldPart?.kWorldMouse);
  const actions = actionsOf(context, theme, help);
  const stack = timeStack(context, actions);
  document.title = pageTitle(report.run.system ?? "run", summary(report.run).kind === "bad", "report");
  const parts = [
    top,
    headerBox(context),
    notesBox(context),
    stack.element,
    messageTable(context),
    coverage(context),
    costs(report.run),
    diagramSection(context),
    provenance(report.run),
    tip.box,
    help,
  ];
  document.getElementById("report").replaceChildren(...parts.filter(Boolean));
  listenToKeys(actions, signal);
  theme.addEventListener("change", () => stack.redraw(), { signal });
  printWell(theme, stack, signal);
  openAtFailure(context);
  return { report, view, stack, theme, player };
}

/** With what shows worlds, where there are some. */
async function read(data, progress) {
  const report = await readReport(data, progress);
  if (report.worlds.length === 0) return report;
  try {
    report.worldPart = await loadWorldPart(data.world_script);
  } catch (error) {
    report.notes.push(`The world in 3D cannot be shown: ${error.message}.`);
  }
  return report;
}

const ignore = () => {};
const readLater = (data) => read(data, ignore);

startPage("Reading the run", read, (report) => (isLive() ? buildLivePage(report, readLater, build) : build(report)));
