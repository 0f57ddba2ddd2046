// A searchable table of all messages; a click on one moves the cursor to it.
import { timeText } from "../data/exact_time.js";
import { h } from "../dom.js";

/** Number of rows that are added at once. */
const kRows = 200;

/** The text of a message that is searched, created on demand. */
function searchedText(message) {
  const { time, component, variable, direction, content, payload } = message;
  message.searched ??= `${timeText(time)} ${component}.${variable} ${direction} ${content} ${payload}`.toLowerCase();
  return message.searched;
}

/** @param {string} text words that must all occur, ignoring case */
export function matching(messages, text, direction) {
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  const isWanted = (message) => !direction || message.direction === direction;
  return messages.filter((message) => isWanted(message) && words.every((word) => searchedText(message).includes(word)));
}

export class MessageTable {
  constructor({ report, view }) {
    this.messages = report.messages;
    this.view = view;
    this.body = h("tbody");
    this.count = h("p.count", { role: "status" });
    this.more = h("button", { type: "button", onclick: () => this.#addRows() }, "Show more");
    this.text = h("input", { type: "search", placeholder: "Filter", "aria-label": "Filter messages" });
    this.direction = h(
      "select",
      { "aria-label": "Direction" },
      ...[
        ["", "all"],
        ["sent", "sent"],
        ["received", "received"],
        ["intervention", "interventions"],
      ].map(([value, label]) => h("option", { value }, label)),
    );
    this.text.addEventListener("input", () => this.#filter());
    this.direction.addEventListener("change", () => this.#filter());
    const heads = ["time [s]", "component", "", "variable", "content", "payload"];
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
      h("div.filter", {}, this.text, this.direction, this.count),
      h("div.scroll", { tabIndex: 0 }, table),
      this.more,
    );
    this.#filter();
  }

  #filter() {
    this.found = matching(this.messages, this.text.value, this.direction.value);
    this.body.replaceChildren();
    this.#addRows();
  }

  #addRows() {
    const begin = this.body.children.length;
    this.body.append(...this.found.slice(begin, begin + kRows).map((message) => this.#row(message)));
    const shown = this.body.children.length;
    const [all, found] = [this.messages.length, this.found.length].map((count) => count.toLocaleString("en"));
    this.count.textContent =
      shown < this.found.length ? `the first ${shown} of ${found} (of ${all})` : `${found} of ${all}`;
    this.more.hidden = shown === this.found.length;
  }

  #row(message) {
    const { time, seconds, component, direction, variable, content, payload } = message;
    const go = () => this.view.holdCursor(seconds);
    return h(
      "tr",
      { onclick: go },
      h("td.number", {}, h("button.time-link", { type: "button", onclick: go }, timeText(time))),
      h("td", {}, component),
      h("td", {}, direction),
      h("td", {}, variable),
      h("td", {}, content),
      h("td.payload", {}, payload === content ? "" : payload),
    );
  }
}
