// What is selected, and the outcomes that are shown.
import { h } from "../../dom.js";
import { kOutcomes } from "../data/outcomes.js";
import { markPicture } from "../plot/marks.js";
import { color } from "../../plot/colors.js";

export class SelectionBar {
  constructor({ report, selection }) {
    Object.assign(this, { report, selection });
    this.count = h("span.selected", { role: "status" });
    this.clear = h("button", { type: "button", onclick: () => selection.clear(), title: "Esc" }, "Select all");
    this.marks = [];
    const present = report.outcomes.map(({ cases }, i) => ({ cases, i })).filter(({ cases }) => cases > 0);
    this.buttons = present.map(({ i }) => this.#button(i));
    this.box = h(
      "div.selection-bar",
      {},
      h("div.outcomes", { role: "group", "aria-label": "Shown outcomes" }, ...this.buttons.map(({ button }) => button)),
      this.count,
      this.clear,
    );
    selection.addEventListener("change", () => this.#show());
    this.#show();
  }

  #button(outcome) {
    const picture = h("canvas", { "aria-hidden": "true" });
    const toggle = () => this.selection.toggle(outcome);
    const button = h("button.toggle", { type: "button", onclick: toggle }, picture, kOutcomes[outcome].name);
    return { outcome, button, picture };
  }

  /** In the colours of the theme. */
  draw() {
    for (const { outcome, picture } of this.buttons) {
      const { canvas, size } = markPicture(kOutcomes[outcome].mark, 4, color(kOutcomes[outcome].color));
      picture.width = picture.height = canvas.width;
      picture.style.width = picture.style.height = `${size}px`;
      picture.getContext("2d").drawImage(canvas, 0, 0);
    }
  }

  #show() {
    const { selection } = this;
    for (const { outcome, button } of this.buttons) {
      button.setAttribute("aria-pressed", String(!selection.hidden.has(outcome)));
    }
    const [count, all] = [selection.count, selection.mask.length].map((number) => number.toLocaleString("en"));
    this.count.textContent = selection.isWhole ? `all ${all} cases` : `${count} of ${all} cases selected`;
    this.clear.hidden = selection.isWhole;
  }
}
