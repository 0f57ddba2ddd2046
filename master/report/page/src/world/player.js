// Moves the cursor as time goes by.

/** Simulated seconds in one of the user's, slowest first. */
export const kSpeeds = [0.001, 0.01, 0.1, 0.25, 0.5, 1, 2, 5, 10, 100];

/** The longest time between two pictures that counts [s]: what a page in the background misses is not made up for. */
const kLongest = 0.5;

/** Event: "change" when it starts or stops. */
export class Player extends EventTarget {
  #last = 0;

  /**
   * @param {import("../view.js").View} view
   * @param {(step: (milliseconds: number) => void) => any} nextFrame
   */
  constructor(view, nextFrame = (step) => requestAnimationFrame(step)) {
    super();
    this.view = view;
    this.nextFrame = nextFrame;
    this.speed = 1;
    this.isPlaying = false;
  }

  toggle() {
    if (this.isPlaying) this.#stop();
    else this.#start();
  }

  /** From the cursor to the end of what is shown; from its begin if the cursor is not before the end. */
  #start() {
    const { view } = this;
    const isInside = view.cursor !== null && view.cursor >= view.from && view.cursor < view.until;
    view.holdCursor(isInside ? view.cursor : view.from);
    this.isPlaying = true;
    this.dispatchEvent(new Event("change"));
    this.nextFrame((now) => {
      this.#last = now;
      this.#goOn();
    });
  }

  #stop() {
    this.isPlaying = false;
    this.dispatchEvent(new Event("change"));
  }

  #goOn() {
    this.nextFrame((now) => this.#step(now));
  }

  /** A cursor that was moved meanwhile goes on from there; where it was released, that ends. */
  #step(now) {
    if (!this.isPlaying) return;
    const { view } = this;
    const passed = Math.min((now - this.#last) / 1000, kLongest) * this.speed;
    this.#last = now;
    if (view.cursor === null) return this.#stop();
    const next = Math.min(view.cursor + passed, view.until);
    view.holdCursor(next);
    if (next < view.until) this.#goOn();
    else this.#stop();
  }
}
