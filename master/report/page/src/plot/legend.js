// Beside a pane: its title, its signals with a button to hide each, and their values at the cursor, or what they were.
import { rowAtCursor } from "../cursor.js";
import { h } from "../dom.js";
import { curveColor, curveDash } from "./colors.js";
import { summaryText } from "./summary.js";

export class Legend {
  /**
   * @param {object} context report and view
   * @param {{title: string, isStates: boolean}} group
   * @param {import("./pane.js").Pane} pane
   * @param {() => void} changed called when the drawing must be updated
   */
  constructor(context, group, pane, changed) {
    this.context = context;
    this.pane = pane;
    this.entries = group.columns.map((column, index) => this.#entry(column, index, group.isStates, changed));
    const buttons = group.isStates ? [] : this.#scaleButtons(changed);
    this.box = h(
      "div.legend",
      {},
      h("div.legend-head", {}, h("h3.clipped", { title: group.title }, group.title), h("span.scales", {}, ...buttons)),
      h("ul", {}, ...this.entries.map((entry) => entry.element)),
    );
  }

  /** Shows the values at the cursor; without one, what they were in the time that is shown. */
  update() {
    const { view } = this.context;
    for (const { column, value } of this.entries) {
      const { text, title } =
        view.cursor === null ? summaryText(column, view) : valueText(column, rowAtCursor(column, view));
      value.textContent = text;
      value.title = title;
      value.classList.toggle("summary", view.cursor === null);
    }
  }

  #entry(column, index, isStates, changed) {
    const value = h("output.value", { "aria-label": `value of ${column.name}` });
    const button = h(
      "button.signal",
      {
        type: "button",
        title: `Hide or show ${column.name}`,
        "aria-pressed": "true",
        onclick: () => {
          const isShown = this.#toggle(column);
          button.setAttribute("aria-pressed", String(isShown));
          changed();
        },
        onmouseenter: () => this.pane.highlight(column),
        onmouseleave: () => this.pane.highlight(null),
        onfocus: () => this.pane.highlight(column),
        onblur: () => this.pane.highlight(null),
      },
      isStates ? null : h("span.swatch", { style: swatch(this.pane.firstColor, index) }),
      h("span.signal-name", {}, h("bdi", {}, column.name)),
    );
    const checks = this.pane.limits.get(column).filter(({ name }) => name !== "");
    return { column, value, element: h("li", {}, button, value, ...checks.map(checkNote)) };
  }

  #toggle(column) {
    const { hidden } = this.pane;
    if (!hidden.delete(column)) hidden.add(column);
    return !hidden.has(column);
  }

  #scaleButtons(changed) {
    const { pane } = this;
    const own = this.#switch("own scale", "Each curve on its own scale", "hasOwnScales", changed);
    const log = this.#switch("log", "Logarithmic or linear axis", "isLogarithmic", changed);
    return [pane.columns.length > 1 ? own : null, pane.canBeLogarithmic ? log : null].filter(Boolean);
  }

  /** A button that switches a property of the pane. */
  #switch(text, title, property, changed) {
    const { pane } = this;
    const button = h(
      "button.scale",
      {
        type: "button",
        title,
        "aria-label": title,
        "aria-pressed": String(pane[property]),
        onclick: () => {
          pane[property] = !pane[property];
          button.setAttribute("aria-pressed", String(pane[property]));
          changed();
        },
      },
      text,
    );
    return button;
  }
}

/** Of a row; -1 for none. */
function valueText(column, row) {
  if (row < 0) return { text: "–", title: "–" };
  const text = column.textAt(row);
  return { text: column.unit ? `${text} ${column.unit}` : text, title: text };
}

/** The line of a check's limits, and its name. */
const checkNote = ({ name, isFailed }) =>
  h(`span.checked${isFailed ? ".broken" : ""}`, { title: name }, isFailed ? `✗ ${name}` : name);

const swatch = (firstColor, index) => ({
  borderTopColor: `var(${curveColor(firstColor + index)})`,
  borderTopStyle: curveDash(index).length > 0 ? "dashed" : "solid",
});
