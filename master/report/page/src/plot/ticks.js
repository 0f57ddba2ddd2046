// Round numbers along an axis, and their texts.

const kSteps = [1, 2, 5, 10];
/** Multiples of smaller steps, as shares of the values, are no different doubles. */
const kFinest = 2 ** -51;

/** The smallest step of 1, 2 or 5 times a power of ten that divides `span` into no more than `most` parts. */
export function roundStep(span, most) {
  const raw = span / most;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = kSteps.find((factor) => factor * power >= raw * (1 - 1e-9));
  return step * power;
}

/** The multiples of a round step, which is no less than `least`, in [from, until]. */
export function ticks(from, until, most, least = 0) {
  const finest = Math.max(Math.abs(from), Math.abs(until)) * kFinest;
  const step = roundStep(Math.max(least, finest, until / most - from / most), 1);
  const first = Math.ceil(from / step - 1e-9);
  const last = Math.floor(until / step + 1e-9);
  const found = [];
  for (let i = first; i <= last; ++i) found.push(i * step);
  return { step, values: found };
}

/** The number of decimals that distinguishes multiples of `step`. */
export const decimalsOf = (step) => Math.max(0, Math.min(20, -Math.floor(Math.log10(step) + 1e-9)));

/** Ticks of time [s], all with the same number of decimals. */
export function timeTickTexts(values, step) {
  const decimals = decimalsOf(step);
  return values.map((value) => (value + 0).toFixed(decimals).replace(/^-(0(\.0*)?)$/, "$1"));
}

const kSuperscripts = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/** A power of ten: 10⁻³. */
export function powerText(exponent) {
  const digits = [...String(Math.abs(exponent))].map((digit) => kSuperscripts[Number(digit)]);
  return `10${exponent < 0 ? "⁻" : ""}${digits.join("")}`;
}

/**
 * The power of ten that is factored out of the numbers of an axis, so that these are short: 0 for none.
 * @param {number} largest magnitude on the axis
 */
export function commonExponent(largest) {
  if (!(largest > 0) || (largest >= 1e-2 && largest < 1e5)) return 0;
  return Math.floor(Math.log10(largest) / 3 + 1e-9) * 3;
}

/** The numbers of an axis with `exponent` factored out. */
export function valueTickTexts(values, exponent) {
  const scaled = values.map((value) => value / 10 ** exponent);
  const step = scaled.length > 1 ? Math.abs(scaled[1] - scaled[0]) : Math.abs(scaled[0]) || 1;
  const decimals = Math.min(12, decimalsOf(step));
  return scaled.map((value) => value.toFixed(decimals).replace(/^-(0(\.0*)?)$/, "$1"));
}
