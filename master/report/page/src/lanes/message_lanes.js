// A lane of messages for each component: a mark where it sent or received one.
import { h } from "../dom.js";
import { kGutter } from "../plot/layout.js";
import { byComponent, layOut } from "./message_layout.js";
import { messageLines } from "./message_text.js";

export class MessageLanes {
  constructor({ report, view, tip }) {
    this.view = view;
    this.tip = tip;
    this.lanes = [...byComponent(report.messages)].map(([component, messages]) => {
      const track = h("div.message-track");
      const element = h("div.message-lane", {}, h("span.lane-name", { title: component }, component), track);
      return { component, messages, track, element };
    });
    this.box = h(
      "div.message-lanes",
      { role: "group", "aria-label": "Messages along time" },
      ...this.lanes.map((lane) => lane.element),
    );
  }

  get isEmpty() {
    return this.lanes.length === 0;
  }

  draw(width) {
    for (const lane of this.lanes) {
      const marks = layOut(lane.messages, this.view, width - kGutter);
      lane.track.replaceChildren(...marks.map((mark) => this.#mark(mark)));
    }
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
