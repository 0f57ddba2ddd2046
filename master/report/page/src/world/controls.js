// What is chosen of a world: the film or 3D, the camera, what the view follows, what is shown beside.
import { h } from "../dom.js";

const kFree = "free";
const kNothing = "nothing";

const option = (value, text = value) => h("option", { value }, text);

/** A select with its label, whose first entry stands for null. */
function choice(label, none, title, groups, onchange) {
  const select = h("select", { title, "aria-label": label, onchange: () => onchange(select.value || null) });
  select.append(option("", none));
  for (const [name, entries] of groups) {
    if (entries.length === 0) continue;
    const options = entries.map(({ value, text }) => option(value, text));
    if (name) select.append(h("optgroup", { label: name }, ...options));
    else select.append(...options);
  }
  return { element: h("label.choice", {}, h("span", { "aria-hidden": "true" }, label), select), select };
}

function toggle(text, title, onchange) {
  const button = h("button.scale", { type: "button", title, "aria-pressed": "false" }, text);
  button.addEventListener("click", () => {
    const isOn = button.getAttribute("aria-pressed") !== "true";
    button.setAttribute("aria-pressed", String(isOn));
    onchange(isOn);
  });
  return button;
}

const targetsOf = (world, kind) =>
  world.targets
    .map((target, index) => ({ ...target, value: String(index), text: target.name }))
    .filter((target) => target.kind === kind);

/**
 * @param {import("./scene/world.js").World} world
 * @returns {Node[]}
 */
export function worldControls(world) {
  const cameras = world.cameras.map((name) => ({ value: name, text: name }));
  const camera = choice("camera", kFree, "From where it is seen", [["", cameras]], (name) => world.eye.choose(name));
  const targets = [
    ["bodies", targetsOf(world, "body")],
    ["sites", targetsOf(world, "site")],
  ];
  const follow = choice("follow", kNothing, "What stays in the middle", targets, (index) =>
    world.eye.follow(index === null ? null : world.targets[Number(index)]),
  );
  const update = () => {
    camera.select.value = world.eye.chosen ?? "";
    const index = world.targets.findIndex(({ node }) => node === world.eye.followed?.node);
    follow.select.value = index < 0 ? "" : String(index);
  };
  world.addEventListener("choice", update);
  update();
  const show = (what, title) => toggle(what, title, (isOn) => world.show(what, isOn));
  return [
    camera.element,
    world.targets.length > 0 ? follow.element : null,
    world.hasContacts ? show("contacts", "Points of contact, and their normals") : null,
    world.hasSites ? show("frames", "Axes of the sites: x red, y green, z blue") : null,
  ].filter(Boolean);
}

/**
 * The switch between the film and 3D.
 * @param {(kind: "film"|"3D") => void} choose
 */
export function kindSwitch(choose) {
  const buttons = ["film", "3D"].map((kind) => h("button", { type: "button", onclick: () => choose(kind) }, kind));
  const element = h("span.switch", { role: "group", "aria-label": "What is shown" }, ...buttons);
  const update = (chosen) =>
    buttons.forEach((button) => button.setAttribute("aria-pressed", String(button.textContent === chosen)));
  return { element, update };
}
