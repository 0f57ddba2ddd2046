// The keys, in a dialog.
import { h } from "../dom.js";
import { kBindings } from "../keys.js";

/** The actions of the mouse. */
export const kMouse = [
  ["move", "the cursor and the values at it"],
  ["click", "hold the cursor there"],
  ["drag", "zoom into this time (Shift: move along)"],
  ["Ctrl + wheel", "zoom"],
  ["Shift + wheel", "move along"],
  ["double click", "the whole run"],
];

const row = ([what, text]) => h("tr", {}, h("th", { scope: "row" }, h("kbd", {}, what)), h("td", {}, text));

export function helpDialog() {
  const keys = kBindings.map(({ shown, text }) => [shown, text]);
  const dialog = h(
    "dialog.help",
    { "aria-label": "Keys" },
    h("h2", {}, "Keys"),
    h("table", {}, h("tbody", {}, ...keys.map(row))),
    h("h2", {}, "Mouse"),
    h("table", {}, h("tbody", {}, ...kMouse.map(row))),
    h("button", { type: "button", onclick: () => dialog.close() }, "Close"),
  );
  dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
  dialog.addEventListener("keydown", (event) => event.key === "?" && dialog.close());
  return dialog;
}
