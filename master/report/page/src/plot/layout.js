// Measures that all rows under the time axis share, so that an instant has the same position in all of them.

/** The position of the time axis [px]: axes and names are left of it. */
export const kGutter = 96;
