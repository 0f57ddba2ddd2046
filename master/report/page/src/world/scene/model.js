// A world as its file has it: nodes of several kinds, and an animation, `run`, which poses them.
import { AnimationMixer, Box3, Sphere, Vector3 } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { embeddedTextures } from "./textures.js";

/** What is thinner than this share of its size is flat, such as a floor. */
const kFlat = 1e-6;

/** @returns {"site"|"contact"|"lamp"|"field"|"geom"|"camera"|"light"|"body"} */
function kindOf({ extras, mesh, camera, extensions }) {
  if (extras?.stride !== undefined) return extras.stride;
  if (mesh !== undefined) return "geom";
  if (camera !== undefined) return "camera";
  return extensions?.KHR_lights_punctual === undefined ? "body" : "light";
}

const cameraIn = (node) => (node.isCamera ? node : node.children.find((child) => child.isCamera));

export class Model {
  #action;
  #mixer;
  #entries = new Map();

  /** @param {object} gltf what GLTFLoader returns */
  constructor({ scene, animations, parser }) {
    this.root = scene;
    const { json, associations } = parser;
    scene.traverse((node) => {
      const definition = json.nodes[associations.get(node)?.nodes];
      if (definition) this.#entries.set(node, { node, name: definition.name ?? "", kind: kindOf(definition) });
    });
    this.startTime = Number(json.scenes?.[json.scene ?? 0]?.extras?.stride?.startTime ?? startTimeOf(json.asset));
    this.#mixer = new AnimationMixer(scene);
    const run = animations.find(({ name }) => name === "run");
    if (run) {
      this.#action = this.#mixer.clipAction(run).play();
      this.#action.paused = true;
    }
    this.switched = this.#of("lamp", "field", "contact");
    this.pose(this.startTime);
  }

  /** @param {ArrayBuffer} bytes of a binary glTF file */
  static async read(bytes) {
    const loader = new GLTFLoader();
    loader.register(embeddedTextures);
    return new Model(await loader.parseAsync(bytes, ""));
  }

  #of(...kinds) {
    return [...this.#entries.values()].filter(({ kind }) => kinds.includes(kind));
  }

  /** By their names. @returns {Map<string, import("three").Camera>} */
  get cameras() {
    const cameras = this.#of("camera").map(({ node, name }) => [name, cameraIn(node)]);
    return new Map(cameras.filter(([name, camera]) => name && camera?.isPerspectiveCamera));
  }

  /** What a view can follow, in the order of the file. @returns {{node: object, name: string, kind: string}[]} */
  get targets() {
    return this.#of("body", "site").filter(({ node, name }) => name && node.parent !== this.root);
  }

  get sites() {
    return this.#of("site");
  }

  get contacts() {
    return this.#of("contact");
  }

  /** Its last instant [s]: of a run that goes on, or was killed, there may be later ones. */
  get until() {
    return this.startTime + (this.#action?.getClip().duration ?? Infinity);
  }

  /** Poses all nodes as they were at an instant [s]. */
  pose(seconds) {
    if (this.#action) {
      // times in the file are single precision: what was switched at the instant is switched
      const time = Math.fround(seconds - this.startTime);
      this.#action.time = Math.min(Math.max(time, 0), this.#action.getClip().duration);
      this.#mixer.update(0);
    }
    for (const { node } of this.switched) node.visible = node.scale.x > 0;
    this.root.updateMatrixWorld();
  }

  /** Whether an object is a field, which is seen through, and is no part of any body. */
  isField(object) {
    return this.#entries.get(object)?.kind === "field";
  }

  /** The names of the body and the geom that an object in the scene belongs to. */
  namesOf(object) {
    const names = { body: "", geom: "" };
    for (let node = object; node && !names.body; node = node.parent) {
      const { name = "", kind } = this.#entries.get(node) ?? {};
      if (kind === "body") names.body = name;
      else if (kind === "geom" || kind === "lamp") names.geom ||= name;
    }
    return names;
  }

  /**
   * Around the whole world, and around what is not flat in it, as it is posed.
   * @returns {{all: Sphere, solid: Sphere}}
   */
  bounds() {
    const all = new Box3();
    const solid = new Box3();
    this.root.traverseVisible((node) => {
      if (!node.isMesh || this.isField(node)) return;
      const box = new Box3().setFromObject(node);
      const size = box.getSize(new Vector3()).toArray();
      all.union(box);
      if (Math.min(...size) > kFlat * Math.max(...size)) solid.union(box);
    });
    const sphere = (box) => box.getBoundingSphere(new Sphere());
    if (all.isEmpty()) return { all: new Sphere(new Vector3(), 1), solid: new Sphere(new Vector3(), 1) };
    return { all: sphere(all), solid: sphere(solid.isEmpty() ? all : solid) };
  }
}

const startTimeOf = (asset) => asset?.extras?.stride?.startTime ?? 0;
