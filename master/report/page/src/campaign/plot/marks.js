// The marks of cases, drawn once and then copied: ten thousand of them take some milliseconds.
import { color } from "../../plot/colors.js";

const kShapes = {
  circle: (pen, r) => pen.arc(0, 0, r, 0, 2 * Math.PI),
  ring: (pen, r) => pen.arc(0, 0, r, 0, 2 * Math.PI),
  square: (pen, r) => pen.rect(-r * 0.9, -r * 0.9, 1.8 * r, 1.8 * r),
  diamond: (pen, r) => polygon(pen, [0, -1.3 * r], [1.3 * r, 0], [0, 1.3 * r], [-1.3 * r, 0]),
  triangle: (pen, r) => polygon(pen, [0, -1.3 * r], [1.25 * r, r], [-1.25 * r, r]),
  cross: (pen, r) => {
    pen.moveTo(-r, -r);
    pen.lineTo(r, r);
    pen.moveTo(-r, r);
    pen.lineTo(r, -r);
  },
};

function polygon(pen, ...points) {
  points.forEach(([x, y], i) => (i === 0 ? pen.moveTo(x, y) : pen.lineTo(x, y)));
  pen.closePath();
}

/** @param {number} radius [px] @param {string} paint a colour */
export function markPicture(mark, radius, paint) {
  const ratio = window.devicePixelRatio || 1;
  const size = Math.ceil(4 * radius + 2);
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = Math.ceil(size * ratio);
  const pen = canvas.getContext("2d");
  pen.scale(ratio, ratio);
  pen.translate(size / 2, size / 2);
  pen.beginPath();
  kShapes[mark](pen, radius);
  const isLine = mark === "ring" || mark === "cross";
  pen[isLine ? "strokeStyle" : "fillStyle"] = paint;
  pen.lineWidth = 1.4;
  if (isLine) pen.stroke();
  else pen.fill();
  return { canvas, size, paint };
}

/** A point on the scale of an aggregate, from 0 to 1. */
export function rampColor(share) {
  const [low, middle, high] = ["--ramp-low", "--ramp-middle", "--ramp-high"].map((name) => rgb(color(name)));
  const [from, to, t] = share < 0.5 ? [low, middle, share * 2] : [middle, high, share * 2 - 1];
  return `rgb(${from.map((value, i) => Math.round(value + t * (to[i] - value))).join(" ")})`;
}

const rgb = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
