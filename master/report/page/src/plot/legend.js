// Beside a pane: its title, its signals with a button to hide each, and their values at the cursor.
import { h } from "../dom.js";
import { curveColor, curveDash } from "./colors.js";

export class Legend {
  /**
   * @param {{title: string, isStates: boolean}} group
   * @param {import("./pane.js").Pane} pane
   * @param {() => void} changed called when the drawing must be updated
   */
  constructor(group, pane, changed) {
    this.pane = pane;
    this.entries = group.columns.map((column, index) => this.#entry(column, index, group.isStates, changed));
    const scale = pane.canBeLogarithmic ? this.#scaleButton(changed) : null;
    this.box = h(
      "div.legend",
      {},
      h("div.legend-head", {}, h("h3", {}, group.title), scale),
      h("ul", {}, ...this.entries.map((entry) => entry.element)),
    );
  }

  /** Shows the values of a row, or none. @param {number} row -1 for none */
  update(row) {
    for (const { column, value } of this.entries) {
      const text = row < 0 ? "–" : column.textAt(row);
      value.textContent = column.unit && row >= 0 ? `${text} ${column.unit}` : text;
      value.title = text;
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
      },
      isStates ? null : h("span.swatch", { style: swatch(this.pane.firstColor, index) }),
      h("span.signal-name", {}, breakable(column.name)),
    );
    const checks = this.pane.limits.get(column).filter(({ name }) => name !== "");
    return { column, value, element: h("li", {}, button, value, ...checks.map(checkNote)) };
  }

  #toggle(column) {
    const { hidden } = this.pane;
    if (!hidden.delete(column)) hidden.add(column);
    return !hidden.has(column);
  }

  #scaleButton(changed) {
    const button = h(
      "button.scale",
      {
        type: "button",
        title: "Logarithmic or linear axis",
        "aria-label": "logarithmic axis",
        "aria-pressed": String(this.pane.isLogarithmic),
        onclick: () => {
          this.pane.setLogarithmic(!this.pane.isLogarithmic);
          button.setAttribute("aria-pressed", String(this.pane.isLogarithmic));
          changed();
        },
      },
      "log",
    );
    return button;
  }
}

/** The line of a check's limits, and its name. */
const checkNote = ({ name, isFailed }) =>
  h(`span.checked${isFailed ? ".broken" : ""}`, { title: name }, isFailed ? `✗ ${name}` : name);

const swatch = (firstColor, index) => ({
  borderTopColor: `var(${curveColor(firstColor + index)})`,
  borderTopStyle: curveDash(index).length > 0 ? "dashed" : "solid",
});

/** Allows a line break after each dot of a name. */
const breakable = (name) => name.replaceAll(".", ".\u200b");
