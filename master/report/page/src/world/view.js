// The world in 3D, as it was at the cursor, in the place of the film or beside it.
import { unpack } from "../data/blob.js";
import { h } from "../dom.js";
import { color } from "../plot/colors.js";
import { ticks, timeTickTexts } from "../plot/ticks.js";
import { kindSwitch, worldControls } from "./controls.js";
import { World } from "./scene/world.js";
import { WorldStrip } from "./strip.js";

/** The tip does not cover what it names [px]. */
const kBesidePointer = 6;

export class WorldView {
  /**
   * @param {{component: string, file: object}} world
   * @param {import("../lanes/film.js").FilmStrip} [film] of the same component
   */
  constructor(context, world, film) {
    this.context = context;
    this.component = world.component;
    this.film = film;
    this.#make();
    this.ready = this.#open(world.file).catch((error) => this.#fail(error));
    for (const name of ["cursor", "view"]) context.view.addEventListener(name, () => this.update());
  }

  #make() {
    const { component } = this;
    this.canvas = h("canvas.world-canvas", {
      tabIndex: 0,
      role: "application",
      "aria-label": `World of ${component} in 3D. Arrow keys turn it, with Shift they move it, + and - zoom`,
      onkeydown: (event) => this.#onKey(event),
      onpointermove: (event) => this.#onMove(event),
      onpointerleave: () => this.context.tip.hide(),
      onpointerdown: () => this.context.tip.hide(),
      ondblclick: () => this.#enlarge(),
    });
    this.still = h("canvas.world-still", { "aria-hidden": "true" });
    this.message = h("p.world-message", { role: "status" }, "Reading the world …");
    this.larger = h(
      "button.world-larger",
      {
        type: "button",
        title: "Larger or smaller",
        "aria-label": "Larger or smaller",
        "aria-pressed": "false",
        onclick: () => this.#enlarge(),
      },
      "⤢",
    );
    this.frame = h("div.world-frame", {}, this.canvas, this.still, this.message, this.larger);
    this.caption = h("figcaption");
    this.picture = h("figure.film-picture.world-picture.own-mouse", { "aria-busy": "true" }, this.frame, this.caption);
    this.picture.addEventListener("wheel", (event) => this.#onWheel(event), { capture: true });
    this.kinds = kindSwitch((kind) => this.choose(kind));
    this.strip = this.film ? undefined : new WorldStrip(this.context, component);
    this.controls = h("div.world-controls", { role: "group", "aria-label": `World of ${component}` });
    const name = h("span.lane-name", { title: component }, this.context.report.worlds.length > 1 ? component : "");
    this.box = h("div.world", {}, this.strip?.box, h("div.world-bar", {}, name, this.controls));
    this.choose(this.film ? "film" : "3D");
  }

  async #open(packed) {
    const bytes = await unpack(packed);
    this.world = await World.open(this.canvas, bytes.buffer);
    this.world.addEventListener("lost", () =>
      this.#say("The browser has taken the graphics away, and may give them back."),
    );
    this.world.addEventListener("restored", () => this.#say(""));
    new ResizeObserver(() => this.#fit()).observe(this.frame);
    this.controls.replaceChildren(...worldControls(this.world));
    if (this.film) this.controls.prepend(this.kinds.element);
    this.#say("");
    this.choose("3D");
    this.#paint();
    this.update();
    this.#fit();
    if (this.width) this.draw(this.width);
    this.picture.setAttribute("aria-busy", "false");
  }

  /** The film, if there is one, is shown instead. */
  #fail(error) {
    console.info(error);
    const because = `The world in 3D cannot be shown: ${error.message}.`;
    this.world = undefined;
    this.controls.replaceChildren(h("p.note", { role: "status" }, because));
    this.picture.setAttribute("aria-busy", "false");
    this.picture.hidden = true;
    if (this.strip) this.strip.box.hidden = true;
    this.choose("film");
  }

  /** @param {"film"|"3D"} kind */
  choose(kind) {
    this.kinds.update(kind);
    this.picture.hidden = kind !== "3D";
    if (this.film) this.film.picture.hidden = kind !== "film";
    this.#widen();
    this.#fit();
  }

  /** Poses the world as it was at the cursor; without one as at the begin of what is shown, as a film does. */
  update() {
    if (!this.world) return;
    const { view } = this.context;
    this.world.pose(view.cursor ?? view.from);
    this.#caption();
  }

  draw(width) {
    this.width = width;
    if (!this.world) return;
    this.#paint();
    this.strip?.draw(this.world, width);
  }

  /** A canvas of WebGL is empty on paper. */
  print() {
    if (!this.world) return;
    this.world.draw();
    Object.assign(this.still, { width: this.canvas.width, height: this.canvas.height });
    if (this.canvas.width > 0) this.still.getContext("2d").drawImage(this.canvas, 0, 0);
  }

  #paint() {
    this.world.paint({ ground: color("--panel"), contact: color("--curve-2") });
  }

  #fit() {
    this.world?.resize(this.frame.clientWidth, this.frame.clientHeight);
  }

  #say(text) {
    this.message.textContent = text;
    this.message.hidden = text === "";
  }

  #caption() {
    const { view } = this.context;
    const { posed, until } = this.world;
    const isKnown = this.world.has(posed);
    const [time] = timeTickTexts([isKnown ? posed : until], ticks(view.from, view.until, 1000).step);
    const count = this.world.contactCount;
    const contacts = this.world.hasContacts ? `, ${count} ${count === 1 ? "contact" : "contacts"}` : "";
    const text = `${this.component} at ${time} s${isKnown ? contacts : ", the last time that is known of it"}`;
    if (this.caption.textContent !== text) this.caption.textContent = this.caption.title = text;
  }

  #enlarge() {
    const isLarge = this.picture.classList.toggle("large");
    this.larger.setAttribute("aria-pressed", String(isLarge));
    this.frame.style.height = ""; // as the user has drawn it
    this.#widen();
    this.picture.scrollIntoView({ block: "nearest" });
  }

  /** The place of a large world is as wide as the page. */
  #widen() {
    const row = this.picture.closest(".row");
    row?.classList.toggle("wide", row.querySelector(".world-picture.large:not([hidden])") !== null);
  }

  #onKey(event) {
    if (event.ctrlKey || event.altKey || event.metaKey || !this.world?.eye.onKey(event)) return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** The wheel scrolls the page, unless the world was touched or Ctrl is held, as elsewhere on the page. */
  #onWheel(event) {
    if (!event.ctrlKey && document.activeElement !== this.canvas) event.stopPropagation();
  }

  #onMove(event) {
    if (!this.world || event.pointerType !== "mouse" || event.buttons !== 0) return;
    const isPending = this.pointer !== undefined;
    this.pointer = event;
    if (isPending) return;
    requestAnimationFrame(() => {
      const last = this.pointer;
      this.pointer = undefined;
      if (this.canvas.matches(":hover")) this.#name(last);
    });
  }

  /** What is under the pointer. */
  #name({ offsetX: x, offsetY: y, clientX, clientY }) {
    const { tip } = this.context;
    const names = this.world.namesAt(x, y);
    if (!names || (!names.body && !names.geom)) return tip.hide();
    const geom = names.geom && names.geom !== names.body ? [`geom ${names.geom}`] : [];
    const anchor = { getBoundingClientRect: () => new DOMRect(clientX, clientY, kBesidePointer, kBesidePointer) };
    tip.show(anchor, [names.body, ...geom].filter(Boolean));
  }
}
