// The page of a comparison: what differs, and the curves of both runs over each other.
import { actionsOf, printWell } from "../actions.js";
import { h } from "../dom.js";
import { listenToKeys } from "../keys.js";
import { helpDialog } from "../parts/help.js";
import { Theme } from "../parts/theme.js";
import { Toolbar } from "../parts/toolbar.js";
import { groupOthers } from "../plot/grouping.js";
import { Ruler } from "../plot/ruler.js";
import { addPane, row } from "../rows.js";
import { Stack } from "../stack.js";
import { startPage } from "../start.js";
import { View } from "../view.js";
import { readComparison } from "./data.js";
import { differenceTable } from "./parts/differences.js";
import { header, shortNames } from "./parts/header.js";

/** Panes of more signals are folded. */
const kShown = 100;

const firstTimes = ({ differences }) => differences.filter(({ time }) => time !== null).map(({ time }) => time);

/** The time axis, the signals that differ, and folded those that do not. @returns the stack, and rows by signals */
function timeStack(context, actions) {
  const { report, comparison, view } = context;
  const toolbar = new Toolbar(context, actions);
  const ruler = new Ruler(context);
  const top = { element: row(h("div", {}, ruler.box), null), draw: (width) => ruler.draw(width) };
  const head = h("div.timebar", {}, toolbar.box, top.element);
  const stack = new Stack(view, head, top.element.firstChild, firstTimes(comparison.comparison).slice(0, 1));
  stack.add(top, head);
  for (const name of ["view", "cursor"]) view.addEventListener(name, () => toolbar.update());
  toolbar.update();
  const rows = new Map();
  const add = (group, parent) => {
    const entry = addPane(context, stack, group, 0, parent);
    if (!rows.has(group.title)) rows.set(group.title, entry.element);
  };
  comparison.overlays.slice(0, kShown).forEach((group) => add(group));
  const folded = (groups, text) => {
    if (groups.length === 0) return;
    const box = h("details.others", {}, h("summary", {}, text));
    stack.body.append(box);
    groups.forEach((group) => add(group, box));
  };
  const more = comparison.overlays.slice(kShown);
  folded(more, `${more.length} more that differ`);
  folded(groupOthers(report), "Signals that do not differ, of A");
  return { stack, rows };
}

/** Where the first difference is, with some time before and behind it. */
function openAtFirst({ comparison, view }) {
  const [first] = firstTimes(comparison.comparison);
  if (first !== undefined) view.holdCursor(first);
}

function build(comparison) {
  const { report } = comparison;
  const view = new View(report.whole);
  const theme = new Theme();
  const help = helpDialog();
  const context = { report, comparison, view };
  const actions = actionsOf(context, theme, help);
  const { stack, rows } = timeStack(context, actions);
  const show = ({ name, time }) => {
    const element = rows.get(name);
    const box = element?.closest("details");
    if (box) box.open = true;
    if (time !== null) view.holdCursor(time);
    element?.scrollIntoView({ block: "center" });
  };
  const { differences, a, b, notes } = comparison.comparison;
  document.title = `${differences.length > 0 ? "DIFFER: " : ""}${shortNames(a, b).join(", ")} – stride compare`;
  const parts = [
    header(context),
    ...[...notes, ...comparison.a.notes, ...comparison.b.notes].map((text) => h("p.warning", {}, text)),
    differenceTable(comparison.comparison, view, show),
    stack.element,
    help,
  ];
  document.getElementById("report").replaceChildren(...parts);
  listenToKeys(actions);
  theme.addEventListener("change", () => stack.redraw());
  printWell(theme, stack);
  openAtFirst(context);
  return { comparison, report, view, stack, theme };
}

startPage("Reading the runs", readComparison, build);
