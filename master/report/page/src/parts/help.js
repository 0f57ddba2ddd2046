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

const tableOf = (entries) => h("table", {}, h("tbody", {}, ...entries.map(row)));
const row = ([what, text]) => h("tr", {}, h("th", { scope: "row" }, h("kbd", {}, what)), h("td", {}, text));

/** @param {string[][]} [worldMouse] what the mouse does in a world, if there is one, which can also be played */
export function helpDialog(worldMouse) {
  const bindings = kBindings.filter(({ action }) => action !== "play" || worldMouse);
  const keys = bindings.map(({ shown, text }) => [shown, text]);
  const dialog = h(
    "dialog.help",
    { "aria-label": "Keys" },
    h("h2", {}, "Keys"),
    tableOf(keys),
    h("h2", {}, "Mouse"),
    tableOf(kMouse),
    ...(worldMouse ? [h("h2", {}, "The world in 3D"), tableOf(worldMouse)] : []),
    h("button", { type: "button", onclick: () => dialog.close() }, "Close"),
  );
  dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
  dialog.addEventListener("keydown", (event) => event.key === "?" && dialog.close());
  return dialog;
}
