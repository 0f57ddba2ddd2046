// From where the world is seen: one of its cameras, or a free one, which orbits a point and may follow a node.
import { MathUtils, PerspectiveCamera, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

/** The field of view of the free camera [degree], and the direction in which it stands at first. */
const kFieldOfView = 45;
const kDirection = new Vector3(0.6, 0.6, 1).normalize();
/** How far, as a share of where all of the sphere around the world is seen: most worlds do not fill it. */
const kDistance = 0.85;
/** The farthest that is seen, as a multiple of the nearest; what a depth buffer distinguishes well. */
const kDepth = 2e4;
/** Steps of the keys: [rad], [px], a factor. */
const kTurn = 0.1;
const kShift = 24;
const kNearer = 0.85;

/** Events: "change" if the world looks different, "choice" if `chosen` or `followed` is another. */
export class Eye extends EventTarget {
  #last = new Vector3();

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {Map<string, PerspectiveCamera>} cameras by their names; that called "film" is the first choice
   * @param {{all: object, solid: object}} bounds spheres, see Model
   */
  constructor(canvas, cameras, bounds) {
    super();
    this.cameras = cameras;
    this.bounds = bounds;
    this.camera = new PerspectiveCamera(kFieldOfView);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.maxDistance = 20 * bounds.all.radius;
    this.controls.minDistance = 1e-3 * bounds.solid.radius;
    this.controls.addEventListener("start", () => this.#takeOver());
    this.controls.addEventListener("change", () => this.#tell("change"));
    this.reset();
  }

  /** The world as it is seen at first. */
  reset() {
    this.camera.fov = kFieldOfView;
    this.#stand(this.camera, 1);
    this.controls.target.copy(this.bounds.solid.center);
    this.controls.update();
    this.choose(this.cameras.has("film") ? "film" : null);
  }

  /** @param {string|null} name null: the free camera, where the last one was */
  choose(name) {
    if (name === null && this.chosen) this.#orbitFrom();
    this.chosen = name;
    this.followed = null;
    this.#tell("choice");
    this.#tell("change");
  }

  /** @param {{node: object}|null} target what stays in the middle; null: nothing */
  follow(target) {
    if (target && this.chosen) this.choose(null);
    this.followed = target;
    if (target) {
      target.node.getWorldPosition(this.#last);
      this.#moveBy(this.#last.clone().sub(this.controls.target));
      this.controls.update();
    }
    this.#tell("choice");
    this.#tell("change");
  }

  /** To be called when the world is posed, before it is drawn. @param {number} aspect width by height */
  update(aspect) {
    if (this.chosen) copyPose(this.cameras.get(this.chosen), this.camera);
    if (this.followed) {
      const now = this.followed.node.getWorldPosition(new Vector3());
      this.#moveBy(now.clone().sub(this.#last));
      this.#last.copy(now);
    }
    this.#adjust(this.camera, aspect);
  }

  /** As the world is seen at first, whatever was chosen since. @returns {PerspectiveCamera} */
  first(aspect) {
    const camera = new PerspectiveCamera(kFieldOfView);
    if (this.cameras.has("film")) copyPose(this.cameras.get("film"), camera);
    else this.#stand(camera, aspect);
    this.#adjust(camera, aspect);
    return camera;
  }

  /** @returns {boolean} whether the key means something here */
  onKey({ key, shiftKey }) {
    const arrows = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const isKnown = key in arrows || "+=-_".includes(key) || key === "Home";
    if (!isKnown) return false;
    if (key === "Home") {
      this.reset();
      return true;
    }
    this.#takeOver();
    if (key in arrows) {
      const [across, up] = arrows[key];
      if (shiftKey) this.controls.pan(across * kShift, up * kShift);
      else {
        this.controls.rotateLeft(across * kTurn);
        this.controls.rotateUp(up * kTurn);
      }
    } else if (key === "+" || key === "=") this.controls.dollyIn(1 / kNearer);
    else this.controls.dollyOut(1 / kNearer);
    return true;
  }

  #tell(name) {
    this.dispatchEvent(new Event(name));
  }

  #moveBy(shift) {
    this.camera.position.add(shift);
    this.controls.target.add(shift);
  }

  /** Who turns the view leaves the camera of the file. */
  #takeOver() {
    if (this.chosen) this.choose(null);
  }

  /** The point that is orbited is before the camera, as far away as the middle of the world. */
  #orbitFrom() {
    const { camera, controls } = this;
    const ahead = camera.getWorldDirection(new Vector3());
    const distance = Math.max(
      this.bounds.solid.center.clone().sub(camera.position).dot(ahead),
      this.bounds.solid.radius / 10,
    );
    controls.target.copy(camera.position).addScaledVector(ahead, distance);
  }

  #stand(camera, aspect) {
    const { center, radius } = this.bounds.solid;
    const half = Math.tan(MathUtils.degToRad(kFieldOfView / 2)) * Math.min(1, aspect);
    camera.position.copy(center).addScaledVector(kDirection, (kDistance * radius) / Math.sin(Math.atan(half)));
    camera.lookAt(center);
  }

  #adjust(camera, aspect) {
    const { center, radius } = this.bounds.all;
    camera.aspect = aspect;
    camera.far = 1.1 * (camera.position.distanceTo(center) + radius);
    camera.near = camera.far / kDepth;
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
  }
}

function copyPose(from, to) {
  from.matrixWorld.decompose(to.position, to.quaternion, new Vector3());
  to.fov = from.fov;
}
