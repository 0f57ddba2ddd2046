// Intervals as shades, with an opacity that is the covered share of each pixel.

/** Fills each pixel by the share that the intervals cover. */
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

/** In sixteenths, which is sufficient for the eye; a positive share is never rounded to zero. */
function shareOfPixel(intervals, view, x, perPixel) {
  const from = view.from + x * perPixel;
  return Math.ceil(intervals.share(from, from + perPixel) * 16 - 1e-6) / 16;
}
