// Elements made in one expression.

const kSvg = "http://www.w3.org/2000/svg";

/**
 * An element with properties, attributes (`aria-…`, `data-…`, `role`, …) and children. Children that are null are
 * omitted.
 * @param {string} tag such as "button" or "p.note": a tag and its classes
 * @param {Record<string, any>} [properties] `on…` are listeners
 * @param {...(Node|string|number|null|undefined)} children
 */
export function h(tag, properties = {}, ...children) {
  const [name, ...classes] = tag.split(".");
  const element = document.createElement(name);
  if (classes.length > 0) element.className = classes.join(" ");
  assign(element, properties);
  element.append(...children.filter((child) => child !== null && child !== undefined).map(asNode));
  return element;
}

/** A line of text that is cut where it is too long: whole on hover, and while it has the focus, which a click gives. */
export const clipped = (tag, text) => h(`${tag}.clipped`, { tabIndex: text ? 0 : -1, title: text }, text);

/** The same for an SVG element. */
export function svg(tag, attributes = {}, ...children) {
  const element = document.createElementNS(kSvg, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

/** Custom properties, too. */
function setStyle(style, properties) {
  for (const [name, value] of Object.entries(properties)) {
    if (name.startsWith("--")) style.setProperty(name, value);
    else style[name] = value;
  }
}

function assign(element, properties) {
  for (const [name, value] of Object.entries(properties)) {
    if (value === undefined || value === null) continue;
    if (name === "style") setStyle(element.style, value);
    else if (name in element && !name.includes("-")) element[name] = value;
    else element.setAttribute(name, value);
  }
}

const asNode = (child) => (typeof child === "number" ? String(child) : child);

/** A canvas of the size of its box, in device pixels; the context draws in CSS pixels. */
export function sizedContext(canvas, width, height) {
  const ratio = window.devicePixelRatio || 1;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  canvas.style.width = `${width}px`;
  canvas.style.height = `${height}px`;
  const context = canvas.getContext("2d");
  context.scale(ratio, ratio);
  return context;
}

/** Yields to the browser, so that the page is drawn and responds during long work. */
export function pause() {
  return new Promise((resolve) => {
    const channel = new MessageChannel();
    channel.port1.onmessage = () => resolve();
    channel.port2.postMessage(null);
  });
}
