// The assignment of signals to panes: those of one plot and one unit of measure share a pane; states have rows.
import { ownerOf } from "../data/components.js";

/** The plots of the run, and those of what is checked and in none of them, so that limits are seen: failed first. */
export function plotsOf({ run, plots }) {
  const shown = new Set(plots.flatMap(({ signals }) => signals));
  const checks = (run?.checks ?? []).filter(({ limits }) => limits && !shown.has(limits.signal));
  const failed = new Set(checks.filter(({ passed }) => passed === false).map(({ limits }) => limits.signal));
  const others = new Set(checks.map(({ limits }) => limits.signal).filter((signal) => !failed.has(signal)));
  const plot = (title, signals) => (signals.size === 0 ? [] : [{ title, signals: [...signals] }]);
  return [...plot("Failed checks", failed), ...plots, ...plot("Checks", others)];
}

/**
 * @param {{plots: {title: string, signals: string[]}[], columns: Map<string, import("../data/report.js").Column>}}
 * report
 * @returns {{title: string, unit: string, isStates: boolean, columns: import("../data/report.js").Column[]}[]}
 */
export function groupIntoPanes(report) {
  return plotsOf(report).flatMap((plot) => panesOf(plot, report.columns));
}

/**
 * The same for signals without a plot: grouped by component.
 * @returns {ReturnType<typeof groupIntoPanes>}
 */
export function groupOthers(report) {
  const shown = new Set(plotsOf(report).flatMap(({ signals }) => signals));
  const units = new Set(report.units);
  const components = new Map();
  for (const name of report.columns.keys()) {
    if (shown.has(name)) continue;
    const title = ownerOf(name, units);
    if (!components.has(title)) components.set(title, { title, signals: [] });
    components.get(title).signals.push(name);
  }
  return [...components.values()].flatMap((plot) => panesOf(plot, report.columns));
}

function panesOf({ title, signals }, columns) {
  const panes = new Map();
  for (const name of signals) {
    const column = columns.get(name);
    if (!column) continue;
    const key = column.isState ? "states" : `unit ${column.unit}`;
    if (!panes.has(key)) panes.set(key, { title, unit: column.unit, isStates: column.isState, columns: [] });
    panes.get(key).columns.push(column);
  }
  return [...panes.values()];
}
