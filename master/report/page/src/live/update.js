// The same run some time later: a report takes over what another one has, and its columns stay the same objects.

const kShape = ["name", "type", "unit", "stepped", "isState"];

/** What the parts of the page are made for; where it is another one, they are made anew. */
function shapeOf(report) {
  return JSON.stringify([
    [...report.columns.values()].map((column) => kShape.map((name) => column[name])),
    report.plots,
    report.units,
    report.messages.length > 0,
    report.messages.some(({ direction }) => direction === "intervention"),
    report.activity.size > 0,
    report.films.map(({ component, frames }) => [component, frames.length > 0]),
    (report.worlds ?? []).map(({ component }) => component),
    report.run.outcome,
    report.run.checks,
  ]);
}

/** Whether the parts of the page that show one report can show the other one. */
export const isAlike = (one, other) => shapeOf(one) === shapeOf(other);

/**
 * @param {object} report which the page shows
 * @param {object} later likewise of readReport(), and alike
 */
export function takeOver(report, later) {
  const { columns, films } = report;
  for (const [name, column] of columns) {
    const { values, texts, seconds, pyramid } = later.columns.get(name);
    Object.assign(column, { values, texts, seconds, pyramid });
  }
  films.forEach((film, i) => Object.assign(film, later.films[i]));
  const { worlds } = report; // too large to be read again and again
  Object.assign(report, later, { columns, films }, worlds ? { worlds } : {});
}

/** The row that the cursor was set to is where it was, in the rows of now. */
export function keepRow(view, before, now) {
  const { row } = view;
  if (row?.of !== before) return;
  view.row = now[row.index] === before[row.index] ? { of: now, index: row.index } : null;
}
