// A searchable table of all messages, each from its sender to its receivers; a click on one moves the cursor to it.
import { timeText } from "../data/exact_time.js";
import { transmissionsOf } from "../data/transmissions.js";
import { clipped, h } from "../dom.js";

/** Number of rows that are added at once. */
const kRows = 200;

/** The choices of the filter: a word for the reader, and which rows it leaves. */
const kKinds = {
  "": { text: "all", has: () => true },
  received: { text: "received", has: ({ received }) => received.length > 0 },
  lost: { text: "sent, not received", has: ({ sent, received }) => sent !== null && received.length === 0 },
  intervention: { text: "interventions", has: ({ intervention }) => intervention !== null },
};

const partsOf = ({ sent, received, intervention }) => [sent, ...received, intervention].filter(Boolean);
const nameOf = ({ component, variable }) => `${component}.${variable}`;

/** The text of a row that is searched, created on demand. */
function searchedText(row) {
  const words = partsOf(row).map((message) => `${nameOf(message)} ${message.direction}`);
  const { content, payload } = partsOf(row)[0];
  row.searched ??= `${timeText(row.time)} ${words.join(" ")} ${content} ${payload}`.toLowerCase();
  return row.searched;
}

/**
 * @param {import("../data/transmissions.js").Transmission[]} rows
 * @param {string} text words that must all occur, ignoring case
 * @param {keyof kKinds} kind
 */
export function matching(rows, text, kind) {
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  return rows.filter((row) => kKinds[kind].has(row) && words.every((word) => searchedText(row).includes(word)));
}

/** Where a message comes from and goes to, in words. */
export function endsOf({ sent, received, intervention }) {
  if (intervention) return [nameOf(intervention), "intervention"];
  return [sent ? nameOf(sent) : "–", received.map(nameOf).join(", ") || "–"];
}

export class MessageTable {
  constructor({ report, view }) {
    this.report = report;
    this.view = view;
    this.body = h("tbody");
    this.count = h("p.count", { role: "status" });
    this.more = h("button", { type: "button", onclick: () => this.#addRows() }, "Show more");
    this.text = h("input", { type: "search", placeholder: "Filter", "aria-label": "Filter messages" });
    this.kind = h(
      "select",
      { "aria-label": "Which messages" },
      ...Object.entries(kKinds).map(([value, { text }]) => h("option", { value }, text)),
    );
    this.text.addEventListener("input", () => this.#filter());
    this.kind.addEventListener("change", () => this.#filter());
    const heads = ["time [s]", "from", "to", "content", "payload"];
    const table = h(
      "table.messages",
      {},
      h("thead", {}, h("tr", {}, ...heads.map((text) => h("th", { scope: "col" }, text)))),
      this.body,
    );
    this.box = h(
      "section.message-table",
      { "aria-label": "Messages" },
      h("h2", {}, "Messages"),
      h("div.filter", {}, this.text, this.kind, this.count),
      h("div.scroll", { tabIndex: 0 }, table),
      this.more,
    );
    this.update();
  }

  /** Takes what the report has now; as many rows as before are shown. */
  update() {
    const shown = Math.max(kRows, this.body.children.length);
    this.rows = transmissionsOf(this.report.messages, this.report.diagram.connections);
    this.#filter(shown);
  }

  #filter(count = kRows) {
    this.found = matching(this.rows, this.text.value, this.kind.value);
    this.body.replaceChildren();
    this.#addRows(count);
  }

  #addRows(count = kRows) {
    const begin = this.body.children.length;
    this.body.append(...this.found.slice(begin, begin + count).map((row) => this.#row(row)));
    const shown = this.body.children.length;
    const [all, found] = [this.rows.length, this.found.length].map((count) => count.toLocaleString("en"));
    this.count.textContent =
      shown < this.found.length ? `the first ${shown} of ${found} (of ${all})` : `${found} of ${all}`;
    this.more.hidden = shown === this.found.length;
  }

  #row(row) {
    const { content, payload } = partsOf(row)[0];
    const [from, to] = endsOf(row);
    const go = () => this.view.holdCursor(row.seconds);
    return h(
      "tr",
      { onclick: go },
      h("td.number", {}, h("button.time-link", { type: "button", onclick: go }, timeText(row.time))),
      h("td.end", {}, clipped("div", from)),
      h("td.end", {}, clipped("div", to)),
      h("td.content", {}, clipped("div", content)),
      h("td.payload", {}, clipped("div", payload === content ? "" : payload)),
    );
  }
}
