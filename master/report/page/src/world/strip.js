// Pictures of a world along the time axis, where no film has some.
import { h } from "../dom.js";
import { kGutter } from "../plot/layout.js";

const kRatio = 4 / 3;
/** After the last change of what is shown [ms]. */
const kDelay = 120;

export class WorldStrip {
  #timer = 0;

  constructor({ view }, component) {
    this.view = view;
    this.track = h("div.film-track", { "aria-hidden": "true" });
    this.box = h("div.film", {}, h("span.lane-name", { title: component }, component), this.track);
  }

  /** @param {object} world @param {number} width [px] */
  draw(world, width) {
    const plotted = width - kGutter;
    const { clientHeight: height } = this.track;
    if (height === 0 || plotted <= 0) return;
    const count = Math.max(1, Math.round(plotted / (height * kRatio)));
    while (this.track.children.length < count) this.track.append(h("canvas"));
    while (this.track.children.length > count) this.track.lastChild.remove();
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#drawPictures(world, plotted / count, height), kDelay);
  }

  #drawPictures(world, width, height) {
    const canvases = [...this.track.children];
    const { from, span } = this.view;
    const all = canvases.map((_, i) => from + ((i + 0.5) / canvases.length) * span);
    const times = all.filter((time) => world.has(time));
    for (const canvas of canvases.slice(times.length)) Object.assign(canvas, { width: 0, height: 0 });
    world.pictures(times, Math.ceil(width), height, (index, picture) => {
      const canvas = canvases[index];
      canvas.width = picture.width;
      canvas.height = picture.height;
      canvas.style.width = `${width}px`;
      canvas.getContext("2d").drawImage(picture, 0, 0);
    });
  }
}
