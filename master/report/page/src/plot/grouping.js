// Which signals share a pane: those of one plot and one unit of measure; states have rows of their own.

/**
 * @param {{plots: {title: string, signals: string[]}[], columns: Map<string, import("../data/report.js").Column>}} report
 * @returns {{title: string, unit: string, isStates: boolean, columns: import("../data/report.js").Column[]}[]}
 */
export function groupIntoPanes(report) {
  return report.plots.flatMap((plot) => panesOf(plot, report.columns));
}

function panesOf({ title, signals, scale }, columns) {
  const panes = new Map();
  for (const name of signals) {
    const column = columns.get(name);
    if (!column) continue;
    const key = column.isState ? "states" : `unit ${column.unit}`;
    if (!panes.has(key)) panes.set(key, { title, scale, unit: column.unit, isStates: column.isState, columns: [] });
    panes.get(key).columns.push(column);
  }
  return [...panes.values()];
}
