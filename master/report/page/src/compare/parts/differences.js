// A table of what differs: a click on a time moves the cursor to it, one on a signal shows its curves.
import { briefText, numberText } from "../../data/number_text.js";
import { clipped, h } from "../../dom.js";
import { timeLink } from "../../parts/verdicts.js";

/** The greatest difference, with the instant where it is. */
export const extremeText = (extreme) =>
  extreme === null ? "" : `${briefText(extreme.value)} at ${numberText(extreme.time)} s`;

const kImportant = new Set(["outcome", "verdict", "check"]);

/** How the runs ended, and what was demanded of them, come before all else. */
export function mostImportant(differences) {
  const isImportant = ({ kind }) => kImportant.has(kind);
  return [...differences.filter(isImportant), ...differences.filter((each) => !isImportant(each))];
}

function differenceRow(difference, view, show) {
  const { kind, name, time, a, b, count, absolute, relative } = difference;
  const isSignal = kind === "signal";
  const go = () => show(difference);
  const what = isSignal ? h("button.time-link", { type: "button", onclick: go, title: "Show its curves" }, name) : name;
  const extreme = (found) => {
    const title = found === null ? "" : `A ${found.a}, B ${found.b}`;
    return h("td.number", {}, found === null ? "" : timeLink(view, found.time, extremeText(found), title));
  };
  return h(
    "tr",
    {},
    h("td.number", {}, time === null ? "" : timeLink(view, time)),
    h("td", {}, kind),
    h("th", { scope: "row" }, what),
    ...[a, b].map((text) => h("td.value-of", {}, clipped("div", text))),
    h("td.number", {}, count.toLocaleString("en")),
    extreme(absolute),
    extreme(relative),
  );
}

/** @param {(difference: object) => void} show the curves of a signal */
export function differenceTable({ differences, not_compared: others }, view, show) {
  if (differences.length === 0) return h("p.note", {}, `Not compared: ${others}`);
  const rows = mostImportant(differences).map((difference) => differenceRow(difference, view, show));
  const heads = ["first at", "what", "", "A", "B", "places", "greatest", "relative to B"].map((text) =>
    h("th", { scope: "col" }, text),
  );
  return h(
    "section",
    { "aria-label": "Differences" },
    h("h2", {}, "What differs"),
    h(
      "div.scroll",
      {},
      h(
        "table.differences",
        {},
        h("thead", {}, h("tr", {}, ...heads)),
        h("tbody", {}, ...rows),
      ),
    ),
    h("p.note", {}, `Not compared: ${others}`),
  );
}
