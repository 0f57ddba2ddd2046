// The assignment of signals to panes: those of one plot and one unit of measure share a pane; states have rows.
import { ownerOf } from "../data/components.js";

/**
 * @param {{plots: {title: string, signals: string[]}[], columns: Map<string, import("../data/report.js").Column>}}
 * report
 * @returns {{title: string, unit: string, isStates: boolean, columns: import("../data/report.js").Column[]}[]}
 */
export function groupIntoPanes(report) {
  return report.plots.flatMap((plot) => panesOf(plot, report.columns));
}

/**
 * The same for signals without a plot: grouped by component.
 * @returns {ReturnType<typeof groupIntoPanes>}
 */
export function groupOthers(report) {
  const shown = new Set(report.plots.flatMap(({ signals }) => signals));
  const units = new Set(report.units);
  const components = new Map();
  for (const name of report.columns.keys()) {
    if (shown.has(name)) continue;
    const title = ownerOf(name, units);
    if (!components.has(title)) components.set(title, { title, signals: [] });
    components.get(title).signals.push(name);
  }
  return groupIntoPanes({ ...report, plots: [...components.values()] });
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
