// The film of the world: some of its pictures along the time axis, and the one at the cursor enlarged.
import { lastAtOrBefore, timeText } from "../data/exact_time.js";
import { h } from "../dom.js";
import { kGutter } from "../plot/layout.js";

export class FilmStrip {
  /** @param {{component: string, times: BigInt64Array|bigint[], seconds: Float64Array, frames: string[]}} film */
  constructor({ report, view }, film) {
    this.report = report;
    this.view = view;
    this.film = film;
    this.ratio = 4 / 3;
    this.track = h("div.film-track", {
      tabIndex: 0,
      role: "slider",
      "aria-label": `Film of ${film.component}`,
      "aria-valuemin": "0",
      onkeydown: (event) => this.#onKey(event),
    });
    this.box = h("div.film", {}, h("span.lane-name", { title: film.component }, film.component), this.track);
    this.image = h("img", { alt: "", draggable: false });
    this.caption = h("figcaption");
    this.enlarge = h(
      "button.enlarge",
      { type: "button", title: "Larger or smaller", "aria-pressed": "false", onclick: () => this.#enlarge() },
      this.image,
    );
    this.picture = h("figure.film-picture", {}, this.enlarge, this.caption);
    this.image.addEventListener("load", () => this.#fitRatio(), { once: true });
    this.update();
  }

  /** The picture at the cursor: the last one before it, or the first of all; of a run that goes on the newest one. */
  get current() {
    const { cursor, from, until } = this.view;
    const time = cursor ?? (this.report.run.goesOn ? until : from);
    return Math.max(0, lastAtOrBefore(this.film.seconds, time));
  }

  update() {
    const index = this.current;
    const count = this.film.frames.length;
    if (index === this.shown && count === this.count) return;
    Object.assign(this, { shown: index, count });
    this.track.setAttribute("aria-valuemax", String(count - 1));
    this.image.src = this.film.frames[index];
    const time = `${timeText(this.film.times[index])} s`;
    this.image.alt = `${this.film.component} at ${time}`;
    const caption = `${this.film.component} at ${time}, picture ${index + 1} of ${count}`;
    this.caption.textContent = this.caption.title = caption;
    this.track.setAttribute("aria-valuenow", String(index));
    this.track.setAttribute("aria-valuetext", time);
  }

  draw(width) {
    const plotted = width - kGutter;
    const count = Math.max(1, Math.round(plotted / (this.track.clientHeight * this.ratio)));
    const each = plotted / count;
    while (this.track.children.length < count) this.track.append(h("img", { alt: "", draggable: false }));
    while (this.track.children.length > count) this.track.lastChild.remove();
    [...this.track.children].forEach((picture, i) => {
      const time = this.view.from + ((i + 0.5) / count) * this.view.span;
      const frame = this.film.frames[Math.max(0, lastAtOrBefore(this.film.seconds, time))];
      picture.style.width = `${each}px`;
      if (picture.getAttribute("src") !== frame) picture.src = frame;
    });
  }

  #enlarge() {
    const isLarge = this.picture.classList.toggle("large");
    this.enlarge.setAttribute("aria-pressed", String(isLarge));
  }

  #fitRatio() {
    this.ratio = this.image.naturalWidth / this.image.naturalHeight || 4 / 3;
    this.draw(this.box.clientWidth);
  }

  #onKey(event) {
    const steps = { ArrowLeft: -1, ArrowRight: 1, PageUp: -10, PageDown: 10, Home: -Infinity, End: Infinity };
    if (!(event.key in steps) || event.ctrlKey || event.altKey) return;
    const last = this.film.frames.length - 1;
    const index = Math.min(last, Math.max(0, this.current + steps[event.key]));
    this.view.holdCursor(this.film.seconds[index]);
    event.preventDefault();
    event.stopPropagation();
  }
}
