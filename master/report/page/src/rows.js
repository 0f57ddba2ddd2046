// The rows under the time axis, and the values that each shows at the cursor.
import { h } from "./dom.js";
import { ActivityLane } from "./lanes/activity_lane.js";
import { FilmStrip } from "./lanes/film.js";
import { MessageLanes } from "./lanes/message_lanes.js";
import { Toolbar } from "./parts/toolbar.js";
import { failureTimes } from "./parts/verdicts.js";
import { groupIntoPanes, groupOthers } from "./plot/grouping.js";
import { Legend } from "./plot/legend.js";
import { Pane } from "./plot/pane.js";
import { Ruler } from "./plot/ruler.js";
import { StatesPane } from "./plot/states.js";
import { Stack } from "./stack.js";

const note = (text) => h("p.note", {}, text);
export const row = (box, side) => h("div.row", {}, h("div.plot", {}, box), h("div.side", {}, side));

function legend(messages) {
  const hasInterventions = messages.some(({ direction }) => direction === "intervention");
  return `Messages: ▲ sent, △ received${hasInterventions ? ", ◆ intervention" : ""}. n: next, p: previous`;
}

function filmStrips(context) {
  const { report, view } = context;
  const strips = report.films.filter(({ frames }) => frames.length > 0).map((film) => new FilmStrip(context, film));
  for (const name of ["cursor", "view"]) {
    view.addEventListener(name, () => strips.forEach((strip) => strip.update()));
  }
  return strips;
}

function addMessages(context, stack) {
  const lanes = new MessageLanes(context);
  const { messages, run } = context.report;
  const none = run.outcome === "running" ? "No messages are written yet." : "No messages were sent.";
  context.view.addEventListener("data", () => lanes.update());
  const words = lanes.isEmpty ? none : legend(messages);
  stack.add({ element: row(lanes.box, note(words)), draw: (width) => lanes.draw(width) });
}

/** One pane with its legend. @returns its row */
export function addPane(context, stack, group, firstColor, parent) {
  const Kind = group.isStates ? StatesPane : Pane;
  const pane = new Kind(context, group.columns, firstColor);
  const entry = { pane, draw: (width) => pane.draw(width) };
  const legend = new Legend(context, group, pane, () => stack.redrawRow(entry));
  entry.element = row(pane.box, legend.box);
  entry.element.classList.add("pane");
  stack.add(entry, parent);
  for (const name of ["cursor", "view"]) context.view.addEventListener(name, () => legend.update());
  legend.update();
  return entry;
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

/** The legend of the lanes' colours. */
function activityKey() {
  const entry = (name) => h("span", {}, h(`span.dot.${name.split(" ")[0]}`), name);
  return h("span.key", {}, ...["idle", "event", "early return", "undone or rejected"].map(entry));
}

function addActivity(context, stack) {
  const { report } = context;
  if (report.activity.size === 0) return stack.body.append(note("What the units did over time was not recorded."));
  stack.body.append(h("h3.lanes-head", {}, "What the units did", activityKey()));
  for (const component of report.units) {
    const lane = new ActivityLane(context, component);
    const words = h("div.lane-summary.clipped", { title: lane.summary }, lane.summary);
    context.view.addEventListener("data", () => {
      lane.update();
      words.textContent = words.title = lane.summary;
    });
    stack.add({
      element: row(lane.box, words),
      draw: (width) => lane.draw(width),
    });
  }
}

/** Stays in sight while the others scroll: the time axis, and films and worlds, if there are some. */
function headRow(context) {
  const films = filmStrips(context);
  const worlds = context.worldPart?.worldViews(context, films) ?? [];
  const parts = [new Ruler(context), ...films, ...worlds];
  const pictures = parts.map(({ picture }) => picture).filter(Boolean);
  const strips = films.length + worlds.filter(({ strip }) => strip).length;
  const element = row(
    h("div", { style: { "--films": String(strips) } }, ...parts.map(({ box }) => box)),
    pictures.length > 0 ? h("div.film-pictures", {}, ...pictures) : null,
  );
  element.classList.toggle("with-world", worlds.length > 0);
  return {
    element,
    worlds,
    draw: (width) => parts.forEach((part) => part.draw(width)),
    print: () => worlds.forEach((world) => world.print()),
  };
}

/** @param {Record<string, (argument?: any) => void>} actions of the keys */
export function timeStack(context, actions) {
  const toolbar = new Toolbar(context, actions);
  const top = headRow(context);
  const head = h("div.timebar", {}, toolbar.box, top.element);
  const stack = new Stack(context.view, head, top.element.firstChild, failureTimes(context.report.run));
  stack.add(top, head);
  stack.worlds = top.worlds;
  for (const name of ["view", "cursor"]) context.view.addEventListener(name, () => toolbar.update());
  toolbar.update();
  addMessages(context, stack);
  addPanes(context, stack);
  addActivity(context, stack);
  return stack;
}
