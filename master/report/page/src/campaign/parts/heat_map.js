// The share of failures over two parameters.
import { h } from "../../dom.js";
import { countFailures } from "../data/counting.js";
import { columnChoice } from "./choice.js";

const kBins = 8;
/** Of texts. More of them would be too many rows. */
const kMostCategories = 24;

const percent = ({ cases, failed }) => `${Math.round((failed / cases) * 100)} %`;

/** The parameters that can be an axis. */
export const mappable = (parameters) =>
  parameters.filter((column) => column.varies && (column.isNumber || column.categories.length <= kMostCategories));

function cellOf(cell) {
  if (cell.cases === 0) return h("td.heat.empty");
  const { cases, failed } = cell;
  const share = `${((failed / cases) * 55).toFixed(1)}%`;
  return h(
    "td.heat",
    {
      title: `${failed.toLocaleString("en")} of ${cases.toLocaleString("en")} cases have not passed`,
      style: { background: `color-mix(in srgb, var(--failed) ${share}, var(--panel))` },
    },
    percent(cell),
    h("span.heat-count", {}, `of ${cases.toLocaleString("en")}`),
  );
}

export class HeatMap {
  constructor({ report, selection }) {
    Object.assign(this, { report, selection });
    this.columns = mappable(report.parameters);
    [this.x, this.y] = this.columns;
    const shown = (key) => (column) => {
      this[key] = column;
      this.draw();
    };
    this.table = h("table.heat-map");
    this.box = h(
      "section",
      { "aria-label": "Heat map" },
      h("h2", {}, "Share of failures"),
      h(
        "div.filter",
        {},
        columnChoice("across", this.columns, shown("x"), { chosen: this.x }),
        columnChoice("down", this.columns, shown("y"), { chosen: this.y }),
      ),
      h("div.scroll", { tabIndex: 0, role: "region", "aria-label": "Share of failures" }, this.table),
      h("p.note", {}, "Of the selected cases with a record. Fields without cases are empty."),
    );
    selection.addEventListener("change", () => this.draw());
    this.draw();
  }

  draw() {
    const { x, y, report, selection } = this;
    const [xBins, yBins] = [x.bins(kBins), y.bins(kBins)];
    const cells = countFailures([x, xBins], [y, yBins], report.cases.outcomes, selection.mask);
    const rows = cells.map((row, i) => h("tr", {}, h("th", { scope: "row" }, yBins.texts[i]), ...row.map(cellOf)));
    if (y.isNumber) rows.reverse();
    this.table.replaceChildren(
      h("caption", {}, `${y.name} over ${x.name}`),
      h("tbody", {}, ...rows),
      h("tfoot", {}, h("tr", {}, h("td"), ...xBins.texts.map((text) => h("th", { scope: "col" }, text)))),
    );
  }
}
