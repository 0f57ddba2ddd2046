// The numbers of a run, as text.
import { briefText } from "../data/number_text.js";

/** The share of all the units' time in which they were suspended, 0 to 1; null if none was. */
export function idleShare(run) {
  const units = run.units ?? [];
  const span = (run.reached ?? 0) - (run.start ?? 0);
  if (!units.some((unit) => unit.idle) || !(span > 0)) return null;
  const skipped = units.reduce((sum, unit) => sum + (unit.idle?.skipped ?? 0), 0);
  return skipped / (units.length * span);
}

const sum = (units, name) => units.reduce((total, unit) => total + (unit[name] ?? 0), 0);

/**
 * Pairs of a name and a value; unknown ones are omitted.
 * @returns {[string, string][]}
 */
export function keyNumbers({ run, messages, times }) {
  const units = run.units ?? [];
  const simulated = run.reached - run.start;
  const share = idleShare(run);
  const sent = messages.filter((message) => message.direction === "sent").length;
  const found = [
    ["simulated", Number.isFinite(simulated) ? `${briefText(simulated)} s` : null],
    ["took", Number.isFinite(run.wall_time) ? `${briefText(run.wall_time)} s` : null],
    ["speed", run.wall_time > 0 && simulated > 0 ? `${briefText(simulated / run.wall_time)} × real time` : null],
    ["suspended", share === null ? null : `${(share * 100).toFixed(1)} % of the units’ time`],
    ["steps", run.communication_steps?.toLocaleString("en")],
    ["messages sent", sent.toLocaleString("en")],
    ["rejected steps", units.length > 0 && !run.goesOn ? sum(units, "rejections").toLocaleString("en") : null],
    ["samples", times.length.toLocaleString("en")],
  ];
  return found.filter(([, text]) => text !== null && text !== undefined);
}
