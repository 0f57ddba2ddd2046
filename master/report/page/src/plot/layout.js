// Measures that all rows under the time axis share, so that one instant is at one place in all of them.

/** Where the time axis begins [px]: left of it are axes and names. */
export const kGutter = 96;
