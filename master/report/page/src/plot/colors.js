// Colours are defined in the style sheet, for light and dark.

/** The number of curves of a pane with different colours; further ones are dashed. */
export const kColors = 6;

/** The value of a custom property of the page: color("--curve-1"). */
export const color = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/** The n-th colour of curves. */
export const curveColor = (index) => `--curve-${(index % kColors) + 1}`;

/** The dash pattern of the n-th curve of a pane. */
export const curveDash = (index) => [[], [7, 3], [2, 2]][Math.floor(index / kColors) % 3];
