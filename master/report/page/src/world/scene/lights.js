// Light: that of the file, with the shadows of one of its lights, and some that comes from everywhere and from the eye,
// so that worlds without lights are seen.
import { DirectionalLight, HemisphereLight, Vector3 } from "three";

/** A white surface that faces a directional light of this strength is white. */
const kFull = Math.PI;
const kShadowPixels = 1024;

/**
 * @param {object} scene that is lit
 * @param {{center: Vector3, radius: number}} bounds of what casts shadows
 * @returns {(camera: object) => void} to be called before each drawing
 */
export function light(scene, bounds) {
  const lights = [];
  scene.traverse((node) => node.isLight && lights.push(node));
  const isLit = lights.length > 0;
  const ambient = new HemisphereLight("#ffffff", "#b8b4ae", (isLit ? 0.3 : 0.55) * kFull);
  const headlight = new DirectionalLight("#ffffff", (isLit ? 0.25 : 0.5) * kFull);
  scene.add(ambient, headlight, headlight.target);
  const shadowing = lights.find((each) => each.isDirectionalLight || each.isSpotLight);
  if (shadowing) castShadows(scene, shadowing, bounds);
  return (camera) => {
    headlight.position.copy(camera.position);
    camera.getWorldDirection(headlight.target.position).add(camera.position);
  };
}

function castShadows(scene, lamp, bounds) {
  scene.traverse((node) => {
    if (!node.isMesh) return;
    node.castShadow = !node.material.transparent;
    node.receiveShadow = true;
  });
  lamp.castShadow = true;
  lamp.shadow.mapSize.set(kShadowPixels, kShadowPixels);
  lamp.shadow.bias = -1e-4;
  lamp.shadow.normalBias = bounds.radius / 200;
  if (lamp.isDirectionalLight) frameShadow(lamp, bounds);
}

/** The shadow's camera sees the whole of the bounds. */
function frameShadow(lamp, { center, radius }) {
  const { x, y, z } = lamp.worldToLocal(new Vector3().copy(center));
  Object.assign(lamp.shadow.camera, {
    left: x - radius,
    right: x + radius,
    bottom: y - radius,
    top: y + radius,
    near: -z - radius,
    far: -z + 3 * radius,
  });
  lamp.shadow.camera.updateProjectionMatrix();
}
