// A world on a canvas. It is drawn when something has changed, and not otherwise.
import { Color, Raycaster, Scene, Vector2, WebGLRenderer } from "three";
import { Eye } from "./eye.js";
import { light } from "./lights.js";
import { contactMarks, contactPaint, siteMarks } from "./marks.js";
import { Model } from "./model.js";

/** More device pixels than these for each CSS pixel are not seen, but take their time. */
const kMostPixels = 2;
/** Of times in single precision, relative. */
const kRounding = 2 ** -22;

/**
 * Events: "drawn", for tests; "choice" if another camera or target is chosen; "lost" and "restored" of WebGL.
 */
export class World extends EventTarget {
  #model;
  #scene = new Scene();
  #aimLight;
  #renderer;
  #contactPaint = contactPaint();
  #marks;
  #pending = 0;
  #size = { width: 1, height: 1 };

  constructor(canvas, context, model) {
    super();
    this.canvas = canvas;
    this.#model = model;
    this.#scene.add(model.root);
    const bounds = model.bounds();
    this.eye = new Eye(canvas, model.cameras, bounds);
    this.#aimLight = light(this.#scene, bounds.solid);
    this.#marks = {
      contacts: contactMarks(model.contacts, this.#contactPaint),
      frames: siteMarks(model.sites),
    };
    this.#renderer = new WebGLRenderer({ canvas, context });
    this.#renderer.shadowMap.enabled = true;
    this.eye.addEventListener("change", () => this.invalidate());
    this.eye.addEventListener("choice", () => this.dispatchEvent(new Event("choice")));
    for (const [name, told] of Object.entries({ webglcontextlost: "lost", webglcontextrestored: "restored" })) {
      canvas.addEventListener(name, () => {
        this.dispatchEvent(new Event(told));
        this.invalidate();
      });
    }
  }

  /**
   * Throws, with the reason in words, where it cannot be shown.
   * @param {HTMLCanvasElement} canvas
   * @param {ArrayBuffer} bytes of a binary glTF file
   */
  static async open(canvas, bytes) {
    const context = canvas.getContext("webgl2", { antialias: true, alpha: false });
    if (!context) throw new Error("this browser has no WebGL 2, or it is switched off");
    return new World(canvas, context, await Model.read(bytes));
  }

  /** @returns {string[]} */
  get cameras() {
    return [...this.#model.cameras.keys()];
  }

  get targets() {
    return this.#model.targets;
  }

  get hasContacts() {
    return this.#model.contacts.length > 0;
  }

  get hasSites() {
    return this.#model.sites.length > 0;
  }

  /** Whether it has this time [s], but for the rounding of its own times, which are floats. */
  has(seconds) {
    const { until } = this.#model;
    return seconds <= until + Math.abs(until) * kRounding;
  }

  /** The last time that it has [s]. */
  get until() {
    return this.#model.until;
  }

  /** As it is posed. */
  get contactCount() {
    return this.#model.contacts.filter(({ node }) => node.visible).length;
  }

  /** @param {number} seconds of the run */
  pose(seconds) {
    if (seconds === this.posed) return;
    this.posed = seconds;
    this.#model.pose(seconds);
    this.invalidate();
  }

  /** @param {"contacts"|"frames"} what @param {boolean} areShown */
  show(what, areShown) {
    this.#marks[what].show(areShown);
    this.invalidate();
  }

  /** @param {{ground: string, contact: string}} colors of CSS */
  paint({ ground, contact }) {
    this.#scene.background = new Color(ground);
    this.#contactPaint.color.set(contact);
    this.invalidate();
  }

  /** In CSS pixels. */
  resize(width, height) {
    if (width === 0 || height === 0) return;
    this.#size = { width, height };
    this.#setSize(width, height);
    this.draw();
  }

  #setSize(width, height) {
    this.#renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, kMostPixels));
    this.#renderer.setSize(width, height, false);
  }

  /** Draws with the next animation frame, once. */
  invalidate() {
    this.#pending ||= requestAnimationFrame(() => this.draw());
  }

  draw() {
    cancelAnimationFrame(this.#pending);
    this.#pending = 0;
    if (this.#renderer.getContext().isContextLost()) return;
    const { width, height } = this.#size;
    this.eye.update(width / height);
    for (const marks of Object.values(this.#marks)) marks.fit(this.eye.camera, height);
    this.#render(this.eye.camera);
    this.dispatchEvent(new Event("drawn"));
  }

  #render(camera) {
    this.#aimLight(camera);
    this.#renderer.render(this.#scene, camera);
  }

  /**
   * Small pictures of some instants, without marks, as the world is seen at first. What is on the canvas stays.
   * @param {number[]} times [s] @param {number} width @param {number} height [px]
   * @param {(index: number, picture: HTMLCanvasElement) => void} take is called with each
   */
  pictures(times, width, height, take) {
    if (this.#renderer.getContext().isContextLost()) return;
    const { posed } = this;
    const marks = Object.values(this.#marks).filter(({ areShown }) => areShown);
    marks.forEach((each) => each.show(false));
    const camera = this.eye.first(width / height);
    this.#setSize(width, height);
    times.forEach((seconds, index) => {
      this.#model.pose(seconds);
      this.#render(camera);
      take(index, this.canvas);
    });
    this.#model.pose(posed);
    marks.forEach((each) => each.show(true));
    this.#setSize(this.#size.width, this.#size.height);
    this.draw();
  }

  /**
   * What is seen at a place on the canvas [CSS px]; null if it is nothing.
   * @returns {{body: string, geom: string}|null}
   */
  namesAt(x, y) {
    const { width, height } = this.#size;
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2((2 * x) / width - 1, 1 - (2 * y) / height), this.eye.camera);
    const isSeen = ({ object }) => {
      let node = object;
      while (node && node.visible) node = node.parent;
      return !node;
    };
    const hits = ray.intersectObject(this.#model.root);
    const hit = hits.find((each) => isSeen(each) && !this.#model.isField(each.object));
    return hit ? this.#model.namesOf(hit.object) : null;
  }

  /** The place of a node in the world, for tests: metres, z up as in MuJoCo. */
  positionOf(name) {
    const found = this.targets.find((target) => target.name === name);
    const [x, y, z] = found.node.matrixWorld.elements.slice(12, 15);
    return [x, -z, y];
  }
}
