// Intervals as shades, as dark as what they cover of each pixel.

/** Fills, pixel by pixel, as much as the intervals cover. */
export function shadeIntervals(context, intervals, view, { left, top, width, height }, fill) {
  if (intervals.count === 0) return;
  context.save();
  context.fillStyle = fill;
  const perPixel = view.span / width;
  for (let x = 0; x < width;) {
    const share = shareOfPixel(intervals, view, x, perPixel);
    let end = x + 1;
    while (end < width && shareOfPixel(intervals, view, end, perPixel) === share) ++end;
    if (share > 0) {
      context.globalAlpha = share;
      context.fillRect(left + x, top, end - x, height);
    }
    x = end;
  }
  context.restore();
}

/** In sixteenths, which the eye does not tell apart further; what is there is never nothing. */
function shareOfPixel(intervals, view, x, perPixel) {
  const from = view.from + x * perPixel;
  return Math.ceil(intervals.share(from, from + perPixel) * 16 - 1e-6) / 16;
}
