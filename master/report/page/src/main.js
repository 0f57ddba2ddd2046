// The page: reads the run's data, puts the parts together, and lets them know of each other what they must.
import { moveByMessages, moveBySamples, rowAtCursor } from "./cursor.js";
import { readReport } from "./data/report.js";
import { h, pause } from "./dom.js";
import { listenToKeys } from "./keys.js";
import { ActivityLane } from "./lanes/activity_lane.js";
import { FilmStrip } from "./lanes/film.js";
import { MessageLanes } from "./lanes/message_lanes.js";
import { costs } from "./parts/costs.js";
import { diagramSection } from "./parts/diagram.js";
import { header } from "./parts/header.js";
import { helpDialog } from "./parts/help.js";
import { MessageTable } from "./parts/message_table.js";
import { Theme } from "./parts/theme.js";
import { Tip } from "./parts/tip.js";
import { Toolbar } from "./parts/toolbar.js";
import { groupIntoPanes, groupOthers } from "./plot/grouping.js";
import { Legend } from "./plot/legend.js";
import { Pane } from "./plot/pane.js";
import { Ruler } from "./plot/ruler.js";
import { StatesPane } from "./plot/states.js";
import { Stack } from "./stack.js";
import { View } from "./view.js";

const note = (text) => h("p.note", {}, text);

/** What can be done by key or button. */
function actionsOf(context, theme, help) {
  const { view } = context;
  return {
    moveBySamples: (count) => moveBySamples(context, count),
    moveByMessages: (direction) => moveByMessages(context, direction),
    zoom: (factor) => view.zoom(factor),
    pan: (share) => view.pan(share),
    showWhole: () => view.showWhole(),
    releaseCursor: () => view.releaseCursor(),
    switchTheme: () => theme.switch(),
    showHelp: () => help.showModal(),
  };
}

const row = (box, side) => h("div.row", {}, h("div.plot", {}, box), h("div.side", {}, side));

/** Films and messages stand in one row, for the picture beside them is high. */
function addFilmsAndMessages(context, stack) {
  const { report, view } = context;
  const strips = report.films.filter(({ frames }) => frames.length > 0).map((film) => new FilmStrip(context, film));
  for (const name of ["cursor", "view"]) {
    view.addEventListener(name, () => strips.forEach((strip) => strip.update()));
  }
  const lanes = new MessageLanes(context);
  const words = lanes.isEmpty ? "No messages were sent." : "Messages: ▲ sent, △ received. n: next, p: previous";
  const element = row(h("div", {}, ...strips.map((strip) => strip.box), lanes.box), note(words));
  element.lastChild.prepend(...strips.map((strip) => strip.picture));
  stack.add({ element, draw: (width) => [...strips, lanes].forEach((part) => part.draw(width)) });
}

/** One pane with its legend. */
function addPane(context, stack, group, firstColor, parent) {
  const Kind = group.isStates ? StatesPane : Pane;
  const pane = new Kind(context, group.columns, firstColor);
  const entry = { pane, draw: (width) => pane.draw(width) };
  const legend = new Legend(group, pane, () => stack.redrawRow(entry));
  entry.element = row(pane.box, legend.box);
  entry.element.classList.add("pane");
  stack.add(entry, parent);
  const update = () => legend.update(rowAtCursor(context));
  context.view.addEventListener("cursor", update);
  update();
}

function addPanes(context, stack) {
  const { report } = context;
  if (report.columns.size === 0) return stack.body.append(note("No signals were recorded."));
  let colors = 0;
  const add = (group, parent) => {
    addPane(context, stack, group, colors, parent);
    colors += group.isStates ? 1 : group.columns.length;
  };
  groupIntoPanes(report).forEach((group) => add(group));
  const others = groupOthers(report);
  if (others.length === 0) return;
  const count = others.reduce((sum, { columns }) => sum + columns.length, 0);
  const box = h("details.others", {}, h("summary", {}, `${count} more recorded ${count === 1 ? "signal" : "signals"}`));
  stack.body.append(box);
  others.forEach((group) => add(group, box));
}

function addActivity(context, stack) {
  const { report } = context;
  if (report.activity.size === 0) return stack.body.append(note("What the units did over time was not recorded."));
  stack.body.append(
    h("h3.lanes-head", {}, "What the units did", h("span.key", {}, ...["idle", "event", "early return", "undone or rejected"].map(
      (name) => h("span", {}, h(`span.dot.${name.split(" ")[0]}`), name)))),
  );
  for (const component of report.units) {
    const lane = new ActivityLane(context, component);
    stack.add({ element: row(lane.box, h("span.lane-summary", {}, lane.summary)), draw: (width) => lane.draw(width) });
  }
}

function timeStack(context, actions) {
  const toolbar = new Toolbar(context, actions);
  const ruler = new Ruler(context);
  const rulerRow = row(ruler.box, null);
  const head = h("div.timebar", {}, toolbar.box, rulerRow);
  const stack = new Stack(context.view, head, rulerRow.firstChild);
  stack.add({ element: rulerRow, draw: (width) => ruler.draw(width) }, head);
  for (const name of ["view", "cursor"]) context.view.addEventListener(name, () => toolbar.update());
  toolbar.update();
  addFilmsAndMessages(context, stack);
  addPanes(context, stack);
  addActivity(context, stack);
  return stack;
}

/** Paper is light, and shows what is out of sight, too. */
function printWell(theme, stack) {
  let chosen = null;
  window.addEventListener("beforeprint", () => {
    chosen = theme.chosen;
    theme.choose("light");
    stack.drawEverything();
  });
  window.addEventListener("afterprint", () => theme.choose(chosen));
}

const thinnedText = (rows) =>
  `There were too many samples for a page. Of each ${rows} rows only those with the least and the most of a signal are here; ` +
  "values at the cursor are those of the rows that were kept.";

function build(report) {
  const view = new View(report.whole);
  const tip = new Tip();
  const theme = new Theme();
  const help = helpDialog();
  const context = { report, view, tip };
  const actions = actionsOf(context, theme, help);
  const stack = timeStack(context, actions);
  document.title = `${report.run.system ?? "run"} – stride report`;
  const parts = [
    header(context),
    ...report.notes.map((text) => h("p.warning", {}, text)),
    report.thinned ? h("p.warning", {}, thinnedText(report.thinned)) : null,
    stack.element,
    report.messages.length > 0 ? new MessageTable(context).box : null,
    costs(report.run),
    diagramSection(context),
    tip.box,
    help,
  ];
  document.getElementById("report").replaceChildren(...parts.filter(Boolean));
  listenToKeys(actions);
  theme.addEventListener("change", () => stack.redraw());
  printWell(theme, stack);
  return { report, view, stack, theme };
}

async function main() {
  const loading = document.getElementById("loading");
  const element = document.getElementById("stride-report");
  if (!element) throw new Error("there is no data in this page");
  if (typeof DecompressionStream === "undefined") throw new Error("this browser is too old: it has no DecompressionStream");
  await pause();
  const data = JSON.parse(element.textContent);
  element.remove();
  const report = await readReport(data, (share) => {
    loading.textContent = `Reading the run … ${Math.round(share * 100)} %`;
  });
  // for tests and the curious
  window.stride = build(report);
  document.getElementById("report").setAttribute("aria-busy", "false");
}

main().catch((error) => {
  const text = `This report cannot be shown: ${error.message}.`;
  document.getElementById("report").replaceChildren(h("p.banner.bad", { role: "alert" }, text));
  console.error(error);
});
