// A lane of messages for each component: a mark where it sent or received one.
import { timeText } from "../data/exact_time.js";
import { h, svg } from "../dom.js";
import { kGutter } from "../plot/layout.js";
import { byComponent, gatherCrowds, kBar, layOut } from "./message_layout.js";
import { messageLines } from "./message_text.js";

const kHeight = 22;
/** The height of the bar of one message among many [px]. */
const kLeastBar = 3;
/** A click on a crowd shows this share of the present time range. */
const kOpened = 0.1;

export class MessageLanes {
  constructor({ report, view, tip }) {
    this.report = report;
    this.view = view;
    this.tip = tip;
    this.box = h("div.message-lanes", { role: "group", "aria-label": "Messages along time" });
    this.update();
  }

  /** Takes what the report has now. */
  update() {
    this.tip.hide(); // its mark goes
    this.lanes = [...byComponent(this.report.messages)].map(([component, messages]) => {
      const track = h("div.message-track");
      const element = h("div.message-lane", {}, h("span.lane-name", { title: component }, component), track);
      return { component, messages, track, element };
    });
    this.box.replaceChildren(...this.lanes.map((lane) => lane.element));
  }

  get isEmpty() {
    return this.lanes.length === 0;
  }

  draw(width) {
    const plotted = width - kGutter;
    const place = ({ seconds }) => this.view.shareOf(seconds) * plotted;
    for (const lane of this.lanes) {
      const entries = gatherCrowds(layOut(lane.messages, this.view, plotted), place);
      lane.track.replaceChildren(...entries.map((entry) => (entry.bars ? this.#crowd(entry) : this.#mark(entry))));
    }
  }

  /** Bars as high as there are messages in them; they open by zooming in. */
  #crowd(crowd) {
    const lines = crowdLines(crowd);
    const element = h(
      "button.crowd",
      {
        type: "button",
        style: { left: `${crowd.x}px`, width: `${crowd.width}px` },
        "aria-label": lines.join("; "),
        onclick: (event) => this.#open(crowd, event),
        onmouseenter: () => this.tip.show(element, lines),
        onmouseleave: () => this.tip.hide(),
        onfocus: () => this.tip.show(element, lines),
        onblur: () => this.tip.hide(),
      },
      bars(crowd),
    );
    return element;
  }

  /** Zooms in at the pointer, or in the middle where the key of a button was pressed. */
  #open({ x, width }, { detail, clientX, currentTarget }) {
    const box = currentTarget.parentElement.getBoundingClientRect();
    const at = detail > 0 ? clientX - box.left : x + width / 2;
    const { from, span } = this.view;
    const middle = from + (at / box.width) * span;
    this.tip.hide();
    this.view.show(middle - (kOpened / 2) * span, middle + (kOpened / 2) * span);
  }

  #mark(mark) {
    const [first] = mark.messages;
    const directions = new Set(mark.messages.map((message) => message.direction));
    const kind = directions.size > 1 ? "both" : first.direction;
    const lines = () => messageLines(mark.messages);
    const element = h(
      `button.message.${kind}`,
      {
        type: "button",
        style: { left: `${mark.x}px` },
        "aria-label": lines().join("; "),
        onclick: () => this.view.holdCursor(first.seconds),
        onmouseenter: () => this.tip.show(element, lines()),
        onmouseleave: () => this.tip.hide(),
        onfocus: () => this.tip.show(element, lines()),
        onblur: () => this.tip.hide(),
      },
      h("span.message-mark", { "aria-hidden": "true" }),
    );
    if (mark.text) element.append(h("span.message-text", { style: { maxWidth: `${mark.room}px` } }, mark.text));
    if (mark.more) element.append(h("span.message-more", {}, mark.more));
    return element;
  }
}

/** "1,234 messages from 1 s to 2.5 s: 1,000 sent, 234 received" and how they open. */
function crowdLines({ messages }) {
  const counts = new Map();
  for (const { direction } of messages) counts.set(direction, (counts.get(direction) ?? 0) + 1);
  const number = (count) => count.toLocaleString("en");
  const kinds = [...counts].map(([direction, count]) => `${number(count)} ${direction}`).join(", ");
  const times = [messages[0], messages.at(-1)].map(({ time }) => `${timeText(time)} s`).join(" to ");
  return [`${number(messages.length)} messages from ${times}: ${kinds}`, "click: zoom in"];
}

function bars({ bars: all, width }) {
  const most = Math.max(...all.map(({ count }) => count));
  const height = (count) => kLeastBar + (kHeight - 2 - kLeastBar) * (count / most);
  const path = all.map(({ x, count }) => `M${x} ${kHeight}v${-height(count).toFixed(1)}h${kBar - 1}V${kHeight}z`);
  return svg("svg", { width, height: kHeight, "aria-hidden": "true" }, svg("path", { d: path.join("") }));
}
