// Which parameters decide: rank correlations, and shares of failures, each with its uncertainty.
import { h, svg } from "../../dom.js";
import { shownText } from "../data/column.js";

const kWidth = 150;
const kHeight = 18;

const signed = (value) => `${value <= -0.005 ? "−" : ""}${Math.abs(value).toFixed(2)}`;
const percent = (share) => `${(share * 100).toFixed(share > 0 && share < 0.1 ? 1 : 0)} %`;

/** Whether 0 is not within the interval. */
export const isClear = ({ confidence }) => confidence !== null && (confidence[0] > 0 || confidence[1] < 0);

/** With all but failure. */
const others = ({ aggregates, margins }) => [...aggregates, ...margins];

/** Those that decide most of all are first; what is not known is last. */
export function byStrength(correlations) {
  const size = ({ value }) => (value === null ? -1 : Math.abs(value));
  const strength = (of) =>
    of.failure.value === null ? Math.max(-1, ...others(of).map(size)) : 2 + size(of.failure);
  return [...correlations].sort((a, b) => strength(b) - strength(a));
}

/** An interval with its middle, on a line from `least` to `most`. */
function intervalPicture(middle, [low, high], least, most, isStrong) {
  const x = (value) => (2 + ((value - least) / (most - least)) * (kWidth - 4)).toFixed(1);
  const line = (from, to, name) =>
    svg("line", { x1: x(from), x2: x(to), y1: kHeight / 2, y2: kHeight / 2, class: name });
  const zero = svg("line", { x1: x(0), x2: x(0), y1: 2, y2: kHeight - 2, class: "interval-zero" });
  return svg(
    "svg",
    {
      viewBox: `0 0 ${kWidth} ${kHeight}`,
      width: kWidth,
      height: kHeight,
      class: isStrong ? "interval clear" : "interval",
      "aria-hidden": "true",
    },
    line(least, most, "interval-ground"),
    zero,
    line(low, high, "interval-span"),
    svg("circle", { cx: x(middle), cy: kHeight / 2, r: 3.5, class: "interval-middle" }),
  );
}

function correlationCell(found) {
  const { count, value, confidence } = found;
  if (value === null) return h("td", {}, h("span.there", {}, "does not vary"));
  const interval = confidence ?? [value, value];
  const text = confidence ? `${signed(confidence[0])} to ${signed(confidence[1])}` : "no interval";
  return h(
    "td.correlation",
    { title: `of ${count.toLocaleString("en")} cases` },
    intervalPicture(value, interval, -1, 1, isClear(found)),
    h("span.value", {}, signed(value)),
    h("span.there", {}, text),
  );
}

function correlationTable(report) {
  const { correlations, parameters } = report;
  const heads = ["parameter", "failure", ...others(report).map(({ name }) => name)];
  const row = (of) => {
    const cells = [of.failure, ...others(of)].map(correlationCell);
    return h("tr", {}, h("th", { scope: "row" }, parameters[of.parameter].name), ...cells);
  };
  return h(
    "div.scroll",
    { tabIndex: 0, role: "region", "aria-label": "Rank correlations" },
    h(
      "table.correlations",
      {},
      h("thead", {}, h("tr", {}, ...heads.map((text) => h("th", { scope: "col" }, text)))),
      h("tbody", {}, ...byStrength(correlations).map(row)),
    ),
  );
}

function shareTable({ parameter, values, count }, parameters) {
  const row = ({ value, cases, failed, confidence }) =>
    h(
      "tr",
      {},
      h("th", { scope: "row" }, shownText(value)),
      h("td.number", {}, `${failed.toLocaleString("en")} of ${cases.toLocaleString("en")}`),
      h(
        "td.correlation",
        {},
        intervalPicture(failed / cases, confidence, 0, 1, false),
        h("span.value", {}, percent(failed / cases)),
        h("span.there", {}, `${percent(confidence[0])} to ${percent(confidence[1])}`),
      ),
    );
  const rest = count - values.length;
  return h(
    "div.shares",
    {},
    h("h3", {}, parameters[parameter].name),
    h(
      "table",
      {},
      h("thead", {}, h("tr", {}, ...["value", "failed", "share"].map((text) => h("th", { scope: "col" }, text)))),
      h("tbody", {}, ...values.map(row)),
    ),
    rest > 0 ? h("p.note", {}, `and ${rest.toLocaleString("en")} rarer values`) : null,
  );
}

/** One in twenty of such intervals misses the truth by chance, which matters where there are many. */
function chanceNote({ correlations }) {
  const all = correlations.flatMap((of) => [of.failure, ...others(of)]);
  const count = all.filter(({ confidence }) => confidence !== null).length;
  return count < 10
    ? ""
    : ` Of ${count} such intervals about ${Math.max(1, Math.round(count / 20))} may miss by chance.`;
}

export function decisiveSection(report) {
  const { correlations, shares, parameters } = report;
  if (correlations.length + shares.length === 0) return null;
  return h(
    "section.decisive",
    { "aria-label": "Which parameters decide" },
    h("h2", {}, "Which parameters decide"),
    correlations.length === 0
      ? null
      : h(
          "p.note",
          {},
          "Spearman’s rank correlation with 95 % confidence (Fisher’s z, variance of Bonett and Wright 2000; an " +
            `approximation). Bold lines are those whose interval does not contain 0.${chanceNote(report)}`,
        ),
    correlations.length === 0 ? null : correlationTable(report),
    shares.length === 0 ? null : h("p.note.apart", {}, "Share of failures of each value, with Wilson’s 95 % interval."),
    h("div.share-tables", {}, ...shares.map((entry) => shareTable(entry, parameters))),
  );
}
