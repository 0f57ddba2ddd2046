// Colours come from the style sheet, which knows light and dark.

/** As many curves of a pane have colours of their own; further ones are dashed. */
export const kColors = 6;

/** The value of a custom property of the page: color("--curve-1"). */
export const color = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/** The n-th colour of curves. */
export const curveColor = (index) => `--curve-${(index % kColors) + 1}`;

/** How the n-th curve of a pane is dashed. */
export const curveDash = (index) => [[], [7, 3], [2, 2]][Math.floor(index / kColors) % 3];
