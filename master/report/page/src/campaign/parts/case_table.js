// The table of cases: why each has not passed, where its results are, and how it is repeated.
import { numberText } from "../../data/number_text.js";
import { h } from "../../dom.js";
import { rowsOf, sorted } from "../data/case_list.js";
import { kOutcomes } from "../data/outcomes.js";

const kRows = 50;

async function copy(text, code) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    getSelection().selectAllChildren(code);
    document.execCommand("copy");
  }
}

/** As an address: what is special there is escaped. */
const addressOf = (link) => link.split("/").map(encodeURIComponent).join("/");

const kCopy = "Copy command";

function copyButton(command, code) {
  const button = h("button.copy", { type: "button", title: command }, kCopy);
  button.addEventListener("click", async () => {
    await copy(command, code);
    button.textContent = "Copied";
    setTimeout(() => (button.textContent = kCopy), 1500);
  });
  return button;
}

/** When and where the case ran; empty if it has not. */
export function ranText({ began, hosts }, row) {
  const where = hosts[row] === "" ? "" : ` on ${hosts[row]}`;
  return began[row] === "" ? "" : `ran at ${began[row]}${where}`;
}

/** To the page of a case, or to its other results; nothing where none are kept. */
function resultsLink(link) {
  if (link === "") return null;
  return h("a", { href: addressOf(link) }, link.endsWith("/") ? "folder" : "report");
}

export class CaseTable {
  constructor({ report, selection }) {
    Object.assign(this, { report, selection });
    this.page = 0;
    this.marked = -1;
    this.order = { values: report.cases.indices, isDescending: false };
    this.kind = h("select", { "aria-label": "Outcome" }, ...this.#kinds());
    this.text = h("input", { type: "search", placeholder: "Words of the reason", "aria-label": "Words of the reason" });
    this.count = h("p.count", { role: "status" });
    this.body = h("tbody");
    const step = (by) => () => this.#show(this.page + by);
    this.back = h("button", { type: "button", onclick: step(-1) }, "← Back");
    this.further = h("button", { type: "button", onclick: step(1) }, "Further →");
    for (const [element, type] of [
      [this.kind, "change"],
      [this.text, "input"],
    ])
      element.addEventListener(type, () => this.#collect());
    this.box = this.#section();
    selection.addEventListener("change", () => this.#collect());
    this.#collect();
  }

  #kinds() {
    const { outcomes } = this.report;
    const present = outcomes.map(({ name, cases }, i) => ({ name, cases, i })).filter(({ cases }) => cases > 0);
    const entries = [["failed", "not passed"], ["", "all"], ...present.map(({ name, i }) => [String(i), name])];
    const options = entries.map(([value, text]) => h("option", { value }, text));
    const hasFailures = outcomes.some(({ cases }, i) => i > 0 && i < 5 && cases > 0);
    options[hasFailures ? 0 : 1].selected = true;
    return options;
  }

  #columns() {
    const { cases, parameters, aggregates, times } = this.report;
    const varying = parameters.filter((column) => column.varies);
    const shown = [...varying, ...aggregates, ...times];
    return [
      { text: "case", values: cases.indices },
      { text: "outcome", values: cases.outcomes },
      ...shown.map((column) => ({ text: column.name, values: column.values, column })),
    ];
  }

  #section() {
    this.columns = this.#columns();
    this.heads = this.columns.map((entry) => {
      const button = h("button.sort", { type: "button", onclick: () => this.#sortBy(entry.values) }, entry.text);
      return h("th", { scope: "col", className: entry.column?.isNumber ? "number" : "" }, button);
    });
    const [actions, reason, command] = ["", "reason", "repeat with"].map((text) => h("th", { scope: "col" }, text));
    const table = h(
      "table.cases",
      {},
      h("thead", {}, h("tr", {}, ...this.heads.slice(0, 2), actions, reason, ...this.heads.slice(2), command)),
      this.body,
    );
    const folder = this.report.working_folder;
    return h(
      "section.case-table",
      { "aria-label": "Cases" },
      h("h2", {}, "Cases"),
      h("div.filter", {}, this.kind, this.text, this.count, h("span.pages", {}, this.back, this.further)),
      h("div.scroll", { tabIndex: 0, role: "region", "aria-label": "Table of cases" }, table),
      this.#keepNote(),
      h("p.note", {}, "The commands are those for the folder ", h("code", {}, folder), ", as seen from this page."),
    );
  }

  #keepNote() {
    const { cases, campaign } = this.report;
    if (campaign.keep !== "none" || cases.links.some(Boolean)) return null;
    return h("p.note", {}, "No results of cases were kept, so there are no reports; the command of a case makes them.");
  }

  #sortBy(values) {
    const isDescending = this.order.values === values && !this.order.isDescending;
    this.order = { values, isDescending };
    this.#collect();
  }

  #collect() {
    const { cases } = this.report;
    const rows = rowsOf(cases, this.selection.mask, this.kind.value, this.text.value);
    this.rows = sorted(rows, this.order.values, this.order.isDescending);
    this.#show(0);
  }

  #show(page) {
    const pages = Math.max(1, Math.ceil(this.rows.length / kRows));
    this.page = Math.min(pages - 1, Math.max(0, page));
    const first = this.page * kRows;
    const shown = this.rows.slice(first, first + kRows);
    this.body.replaceChildren(...shown.map((row) => this.#row(row)));
    const all = this.rows.length.toLocaleString("en");
    this.count.textContent = shown.length === 0 ? "no case" : `${first + 1} – ${first + shown.length} of ${all}`;
    this.back.disabled = this.page === 0;
    this.further.disabled = this.page === pages - 1;
    this.back.hidden = this.further.hidden = pages === 1;
    this.columns.forEach(({ values }, i) => {
      const isSorted = values === this.order.values;
      const direction = this.order.isDescending ? "descending" : "ascending";
      this.heads[i].setAttribute("aria-sort", isSorted ? direction : "none");
    });
  }

  /** Shows the case, whatever the table has shown before. */
  showCase(row) {
    this.marked = row;
    if (!this.rows.includes(row)) {
      this.kind.value = "";
      this.text.value = "";
      this.#collect();
    }
    this.#show(Math.floor(this.rows.indexOf(row) / kRows));
    this.body.querySelector(".marked")?.scrollIntoView({ block: "center" });
  }

  #row(row) {
    const { cases } = this.report;
    const { name, color } = kOutcomes[cases.outcomes[row]];
    const value = ({ column }) =>
      h(column.isNumber ? "td.number" : "td", { title: column.textAt(row) }, column.briefAt(row));
    const code = h("code", {}, cases.commands[row]);
    return h(
      row === this.marked ? "tr.marked" : "tr",
      {},
      h("td.number", {}, numberText(cases.indices[row])),
      h("td.outcome-name", {}, h("span.dot", { style: { background: `var(${color})` } }), name),
      h("td.actions", {}, resultsLink(cases.links[row]), copyButton(cases.commands[row], code)),
      h("td.reason", { title: cases.reasons[row] }, cases.reasons[row].split("\n")[0]),
      ...this.columns.slice(2).map(value),
      h("td.command", { title: ranText(cases, row) }, code),
    );
  }
}
