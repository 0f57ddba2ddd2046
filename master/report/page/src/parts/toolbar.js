// Above the time axis: the exact time of the row at the cursor, and buttons for the actions of the keys.
import { rowAtCursor } from "../cursor.js";
import { briefText } from "../data/number_text.js";
import { rowTimeText } from "../data/report.js";
import { h } from "../dom.js";
import { ticks, timeTickTexts } from "../plot/ticks.js";

const button = (text, label, onclick) =>
  h("button", { type: "button", title: label, "aria-label": label, onclick }, text);

export class Toolbar {
  /** @param {Record<string, (argument?: any) => void>} actions of the keys */
  constructor(context, actions) {
    this.context = context;
    this.time = h("output.cursor-time", { "aria-live": "off" });
    this.row = h("span.cursor-row");
    this.shown = h("span.shown-time");
    this.box = h(
      "div.toolbar",
      { role: "toolbar", "aria-label": "Time" },
      h("span.cursor-place", {}, this.time, this.row),
      this.shown,
      h(
        "span.buttons",
        {},
        context.player ? context.worldPart.playerButtons(context.player) : null,
        button("‹ msg", "Message before (p)", () => actions.moveByMessages(-1)),
        button("msg ›", "Next message (n)", () => actions.moveByMessages(1)),
        button("−", "Zoom out (−)", () => actions.zoom(2)),
        button("+", "Zoom in (+)", () => actions.zoom(0.5)),
        button("Whole run", "The whole run (0)", () => actions.showWhole()),
        button("◐", "Light or dark (d)", () => actions.switchTheme()),
        button("?", "Keys (?)", () => actions.showHelp()),
      ),
    );
  }

  update() {
    const { report, view } = this.context;
    const row = rowAtCursor(report, view);
    const isThere = row >= 0 && row < report.times.length;
    this.time.textContent = isThere ? `t = ${rowTimeText(report, row)} s` : "no cursor";
    const count = report.times.length.toLocaleString("en");
    const values = view.cursor === null ? "values of the time that is shown" : "";
    this.row.textContent = isThere ? `sample ${(row + 1).toLocaleString("en")} of ${count}` : values;
    this.shown.textContent = view.isWhole ? "the whole run" : `${spanTexts(view).join(" to ")} s of ${wholeText(view)}`;
  }
}

const wholeText = ({ whole }) => `${briefText(whole.from)} to ${briefText(whole.until)} s`;

/** Both ends of the view, with enough digits to distinguish them. */
function spanTexts({ from, until }) {
  const { step } = ticks(from, until, 1000);
  return timeTickTexts([from, until], step);
}
