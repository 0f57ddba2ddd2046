// Marks of nodes that have no shape of their own: contacts with their normals, sites with their axes. They are as large
// on the screen wherever they are, and are seen through what is before them.
import {
  ConeGeometry,
  CylinderGeometry,
  Group,
  MathUtils,
  Mesh,
  MeshBasicMaterial,
  SphereGeometry,
  Vector3,
} from "three";

/** Lengths on the screen [px]. */
const kNormal = 44;
const kAxis = 30;
/** The usual colours of x, y and z. */
const kAxisColors = ["#e5484d", "#2f9e44", "#3b82f6"];

/** Shapes along +z, of length 1. */
const along = (geometry, from) => geometry.rotateX(Math.PI / 2).translate(0, 0, from);
const kShaft = along(new CylinderGeometry(0.028, 0.028, 0.75, 8), 0.375);
const kHead = along(new ConeGeometry(0.1, 0.28, 16), 0.86);
const kPoint = new SphereGeometry(0.1, 16, 8);
const kBar = along(new CylinderGeometry(0.04, 0.04, 1, 8), 0.5);

const paint = (color) => new MeshBasicMaterial({ color, depthTest: false, transparent: true, toneMapped: false });

function mesh(geometry, material) {
  const made = new Mesh(geometry, material);
  made.renderOrder = 1;
  made.raycast = () => {};
  return made;
}

/** Of one kind, on many nodes. */
export class Marks {
  #marks;
  #size;

  /** @param {{node: object}[]} entries @param {() => object} make @param {number} size [px] */
  constructor(entries, make, size) {
    this.#size = size;
    this.areShown = false;
    this.#marks = entries.map(({ node }) => {
      const mark = make();
      mark.visible = false;
      node.add(mark);
      return mark;
    });
  }

  /** @param {boolean} areShown */
  show(areShown) {
    this.areShown = areShown;
    for (const mark of this.#marks) mark.visible = areShown;
  }

  /** To be called before each drawing. @param {number} height of the drawing [px] */
  fit(camera, height) {
    const scale = (2 * Math.tan(MathUtils.degToRad(camera.fov / 2)) * this.#size) / height;
    const place = new Vector3();
    for (const mark of this.#marks) {
      if (!mark.visible) continue;
      const depth = -mark.parent.getWorldPosition(place).applyMatrix4(camera.matrixWorldInverse).z;
      mark.scale.setScalar(Math.max(depth, 1e-9) * scale);
      mark.updateMatrixWorld();
    }
  }
}

/** A point, and an arrow along the normal, which is the z axis of the node. */
export function contactMarks(contacts, material) {
  const make = () => new Group().add(mesh(kPoint, material), mesh(kShaft, material), mesh(kHead, material));
  return new Marks(contacts, make, kNormal);
}

export const contactPaint = () => paint("#d9480f");

export function siteMarks(sites) {
  const [x, y, z] = kAxisColors.map(paint);
  const turned = (bar, axis, angle) => {
    bar.rotation[axis] = angle;
    return bar;
  };
  const make = () =>
    new Group().add(turned(mesh(kBar, x), "y", Math.PI / 2), turned(mesh(kBar, y), "x", -Math.PI / 2), mesh(kBar, z));
  return new Marks(sites, make, kAxis);
}
