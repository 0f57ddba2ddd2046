// The range of values that a pane shows.

/** A logarithmic axis begins at this share of the largest value or above. */
const kDepth = 1e-12;

/**
 * The minimum and maximum of the drawn values, without infinities and gaps.
 * @param {(number|null)[][]} columns
 */
export function finiteExtremes(columns) {
  let least = Infinity;
  let most = -Infinity;
  let leastPositive = Infinity;
  for (const column of columns) {
    for (const value of column) {
      if (value === null || !Number.isFinite(value)) continue;
      if (value < least) least = value;
      if (value > most) most = value;
      if (value > 0 && value < leastPositive) leastPositive = value;
    }
  }
  return { least, most, leastPositive };
}

/** Bottom and top of a linear axis: a little more than the range of the values, which may be more than a double. */
export function linearRange({ least, most }) {
  if (!(least <= most)) return [0, 1];
  const half = most / 2 - least / 2;
  const room = half > 0 ? half * 0.12 : Math.abs(least) * 0.1 || 1;
  return [Math.max(-Number.MAX_VALUE, least - room), Math.min(Number.MAX_VALUE, most + room)];
}

/** The first and the last decade of a logarithmic axis, as exponents of ten. */
export function logarithmicDecades({ most, leastPositive }) {
  if (!(most > 0)) return [-1, 0];
  const first = Math.floor(Math.log10(Math.max(leastPositive, most * kDepth)) + 1e-9);
  const last = Math.ceil(Math.log10(most) - 1e-9) + 0;
  return [first, Math.max(last, first + 1)];
}

function samples({ values }) {
  const step = Math.max(1, Math.floor(values.length / 2000));
  const found = [];
  for (let i = 0; i < values.length; i += step) found.push(values[i]);
  return found;
}

/** NaN is ignored. */
export const hasNothingNegative = ({ pyramid, values }) => !(pyramid.extremes(0, values.length).least < 0);

export const hasPositive = ({ pyramid, values }) => pyramid.extremes(0, values.length).most > 0;

/** Whether most values would be at the bottom of a linear axis, so that a logarithmic one shows more. */
export function isMostlySmall(column) {
  const { most } = column.pyramid.extremes(0, column.values.length);
  const positive = samples(column)
    .filter((value) => value > 0)
    .sort((a, b) => a - b);
  return positive.length > 0 && positive[positive.length >> 1] < most / 300;
}
