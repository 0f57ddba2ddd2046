// How often each value of a parameter occurs, and with which outcomes.
import { briefText } from "../../data/number_text.js";
import { h, svg } from "../../dom.js";
import { casesText, countOutcomes } from "../data/counting.js";
import { kOutcomes } from "../data/outcomes.js";

const kBins = 24;
/** Of texts. More bars than these cannot be told apart. */
const kMostCategories = 100;
const kWidth = 240;
const kHeight = 84;
/** From the bottom: what has not passed is seen best there. */
const kStack = [1, 2, 3, 4, 0, 5];


const sum = (counts) => counts.reduce((total, count) => total + count, 0);

function bar(counts, text, x, width, most) {
  let top = kHeight;
  const parts = kStack
    .filter((outcome) => counts[outcome] > 0)
    .map((outcome) => {
      const height = (counts[outcome] / most) * kHeight;
      top -= height;
      const paint = `var(${kOutcomes[outcome].color})`;
      return svg("rect", { x, y: top.toFixed(2), width, height: height.toFixed(2), style: `fill: ${paint}` });
    });
  const words = kStack.filter((outcome) => counts[outcome] > 0).map((o) => `${counts[o]} ${kOutcomes[o].name}`);
  return svg("g", {}, svg("title", {}, `${text}: ${words.join(", ") || "no case"}`), ...parts);
}

export class Histogram {
  constructor({ report, selection }, column) {
    Object.assign(this, { report, selection, column });
    this.bins = column.bins(kBins);
    const everyone = new Uint8Array(report.count).fill(1);
    this.all = countOutcomes(column, this.bins, report.cases.outcomes, everyone);
    this.most = Math.max(1, ...this.all.map(sum));
    const viewBox = `0 0 ${kWidth} ${kHeight}`;
    this.picture = svg("svg", { viewBox, preserveAspectRatio: "none", class: "histogram", role: "img" });
    const ends = column.isNumber
      ? [briefText(column.least), briefText(column.most)]
      : [column.categories[0], column.categories.at(-1)];
    this.box = h(
      "figure.histogram-box",
      {},
      h(
        "figcaption",
        {},
        h("h3", { title: column.name }, h("bdi", {}, column.name)),
        h("span.there", {}, `up to ${casesText(this.most)}${this.#restText()}`),
      ),
      this.picture,
      h("div.ends", {}, ...ends.map((text) => h("span", {}, text))),
    );
    this.draw();
  }

  /** Cases whose value is infinite, or the scenario's own, which is not known here. */
  #restText() {
    const rest = this.report.count - sum(this.all.map(sum));
    return rest === 0 ? "" : `, ${rest} not shown`;
  }

  draw() {
    const { bins, selection, report } = this;
    const counts = selection.isWhole
      ? this.all
      : countOutcomes(this.column, bins, report.cases.outcomes, selection.mask);
    const step = kWidth / bins.texts.length;
    const gap = Math.min(1, step / 6);
    const ground = this.all.map((all, i) => {
      const height = (sum(all) / this.most) * kHeight;
      const at = { x: i * step + gap / 2, y: kHeight - height, width: step - gap, height };
      return svg("rect", { ...at, class: "histogram-ground" });
    });
    const bars = counts.map((each, i) => bar(each, bins.texts[i], i * step + gap / 2, step - gap, this.most));
    this.picture.replaceChildren(...(selection.isWhole ? [] : ground), ...bars);
    const words = bins.texts.map((text, i) => `${text}: ${sum(counts[i])}`);
    this.picture.setAttribute("aria-label", `${this.column.name}, cases: ${words.join(", ")}`);
  }
}

export function histogramSection(context) {
  const varying = context.report.parameters.filter((column) => column.varies);
  const columns = varying.filter((column) => column.isNumber || column.categories.length <= kMostCategories);
  if (varying.length === 0) return null;
  const others = varying.filter((column) => !columns.includes(column)).map(({ name }) => name);
  const histograms = columns.map((column) => new Histogram(context, column));
  context.selection.addEventListener("change", () => histograms.forEach((histogram) => histogram.draw()));
  return h(
    "section",
    { "aria-label": "Histograms" },
    h("h2", {}, "Each parameter"),
    h("div.histograms", {}, ...histograms.map(({ box }) => box)),
    others.length === 0 ? null : h("p.note", {}, `With too many different texts: ${others.join(", ")}.`),
  );
}
