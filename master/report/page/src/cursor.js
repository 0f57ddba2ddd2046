// Moving the cursor by samples and messages rather than by time.
import { lastAtOrBefore } from "./data/exact_time.js";

/**
 * The row whose values are valid at the cursor; -1 if there is no cursor, or no row before it.
 * @param {{seconds: Float64Array}} rows of a report, or a column
 */
export function rowAtCursor({ seconds }, view) {
  if (view.cursor === null) return -1;
  return view.row?.of === seconds ? view.row.index : lastAtOrBefore(seconds, view.cursor);
}

/** Moves the cursor by samples, and holds it there. */
export function moveBySamples({ report, view }, count) {
  const last = report.seconds.length - 1;
  if (last < 0) return;
  const now = view.cursor === null ? lastAtOrBefore(report.seconds, view.from) : rowAtCursor(report, view);
  const row = Math.min(last, Math.max(0, now + count));
  view.holdCursor(report.seconds[row], { of: report.seconds, index: row });
}

/** Moves the cursor to the next or previous instant with messages, and holds it there. */
export function moveByMessages({ report, view }, direction) {
  const instants = report.messages.map((message) => message.seconds);
  const now = view.cursor ?? (direction > 0 ? -Infinity : Infinity);
  const at = lastAtOrBefore(instants, now);
  const target = direction > 0 ? instants[at + 1] : instants.findLast((seconds) => seconds < now);
  if (target !== undefined) view.holdCursor(target);
}
