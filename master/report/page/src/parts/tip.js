// A small panel with lines of text beside the element that has the pointer or the focus.
import { h } from "../dom.js";

const kMargin = 8;

export class Tip {
  constructor() {
    this.box = h("div.tip", { role: "tooltip", hidden: true });
  }

  /** @param {Element} anchor @param {string[]} lines */
  show(anchor, lines) {
    this.box.replaceChildren(...lines.map((line) => h("div", {}, line)));
    this.box.hidden = false;
    const at = anchor.getBoundingClientRect();
    const { offsetWidth: width, offsetHeight: height } = this.box;
    const left = Math.min(at.left, document.documentElement.clientWidth - width - kMargin);
    const below = at.bottom + kMargin;
    const top = below + height > window.innerHeight ? at.top - height - kMargin : below;
    Object.assign(this.box.style, { left: `${Math.max(kMargin, left)}px`, top: `${Math.max(kMargin, top)}px` });
  }

  hide() {
    this.box.hidden = true;
  }
}
