// At the top of a live page: whether it is up to date, and a button that lets it be as it is.
import { briefText } from "../data/number_text.js";
import { h } from "../dom.js";

const kWords = { live: "live", paused: "paused", ended: "ended", lost: "connection lost" };

export class LiveMark {
  /** @param {(isPaused: boolean) => void} onPause */
  constructor(onPause) {
    this.state = h("strong");
    this.text = h("span.live-text");
    this.pause = h(
      "button",
      {
        type: "button",
        title: "Let the page be as it is",
        onclick: () => onPause(this.pause.textContent === "Pause"),
      },
      "Pause",
    );
    this.box = h("p.live", { role: "status" }, this.state, this.text, this.pause);
  }

  /** @param {keyof kWords} state */
  show(state) {
    this.box.dataset.state = state;
    this.state.textContent = kWords[state];
    this.pause.hidden = state === "ended" || state === "lost";
    this.pause.textContent = state === "paused" ? "Go on" : "Pause";
  }

  /** @param {number} reached [s] @param {Date} time of the update */
  tell(reached, time = new Date()) {
    this.text.textContent = `updated ${time.toLocaleTimeString("en-GB")}, reached ${briefText(reached)} s`;
  }
}
