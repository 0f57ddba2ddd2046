// The run that the page shows, unpacked from the data that `stride report` put into it.
import { pause } from "../dom.js";
import { Pyramid } from "../plot/pyramid.js";
import { unpack } from "./blob.js";
import { secondsOf, timeText, toSeconds } from "./exact_time.js";
import { commonIntervals, Intervals } from "./intervals.js";
import { numberText } from "./number_text.js";

const kFormat = 1;

/** A recorded signal. */
export class Column {
  /**
   * @param {{name: string, unit?: string, type: string, stepped: boolean}} description
   * @param {ArrayLike<number>} values for a text: the index of each row's text in `texts`
   * @param {string[]|undefined} texts
   * @param {Float64Array} seconds the time of each row
   */
  constructor(description, values, texts, seconds) {
    this.name = description.name;
    this.unit = description.unit ?? "";
    this.type = description.type;
    this.stepped = description.stepped;
    this.values = values;
    this.texts = texts;
    this.seconds = seconds;
    this.pyramid = new Pyramid(values);
  }

  /** The same under another name. */
  named(name) {
    return Object.assign(Object.create(Column.prototype), this, { name });
  }

  /** Whether it is drawn as a row of states rather than as a curve. */
  get isState() {
    return this.type === "Boolean" || this.texts !== undefined;
  }

  /** As signals.csv has it in this row, without the quotation marks of texts. */
  textAt(row) {
    const value = this.values[row];
    if (this.texts) return this.texts[value];
    if (this.type === "Boolean") return value ? "true" : "false";
    return this.valueText(value);
  }

  /** A number of its type. */
  valueText(value) {
    return numberText(value, this.type === "Float32");
  }
}

async function readColumn(description, seconds) {
  const packed = description.values;
  if (packed.type !== "strings") return new Column(description, await unpack(packed), undefined, seconds);
  return new Column(description, await unpack(packed.indices), packed.values, seconds);
}

/** The kinds of activity of each unit: intervals and instants. */
async function readActivity(entry) {
  const [from, until] = await Promise.all([unpack(entry.from), unpack(entry.until)]);
  return { component: entry.component, kind: entry.kind, intervals: new Intervals(secondsOf(from), secondsOf(until)) };
}

async function readFilm(film) {
  const times = await unpack(film.times);
  return { component: film.component, times, seconds: secondsOf(times), frames: film.frames };
}

function readMessage(message) {
  const time = BigInt(message.time);
  return { ...message, time, seconds: toSeconds(time), content: message.content ?? "" };
}

/** For each component, by its name: Map<kind, Intervals>. */
function byComponent(activity) {
  const components = new Map();
  for (const { component, kind, intervals } of activity) {
    if (!components.has(component)) components.set(component, new Map());
    components.get(component).set(kind, intervals);
  }
  return components;
}

/** The units' names, in the order of the run; without run.json those with activities. */
function unitNames(run, activity) {
  const names = (run.units ?? []).map((unit) => unit.name);
  return [...new Set([...names, ...activity.keys()])];
}

function allIdle(names, activity) {
  const idle = names.map((name) => activity.get(name)?.get("idle"));
  return commonIntervals(idle.length > 0 && idle.every(Boolean) ? idle : []);
}

/** The largest range of the time axis [s]. */
function wholeTime(report, run) {
  const last = report.seconds.length - 1;
  const candidates = [run.start, run.reached, report.seconds[0], report.seconds[last]];
  candidates.push(report.messages[0]?.seconds, report.messages.at(-1)?.seconds);
  const known = candidates.filter(Number.isFinite);
  const from = known.length > 0 ? Math.min(...known) : 0;
  const until = known.length > 0 ? Math.max(...known) : 1;
  return { from, until: until > from ? until : from + 1 };
}

/**
 * @param {object} data of the page
 * @param {(share: number) => void} progress called with the share that has been read, 0 to 1
 */
export async function readReport(data, progress) {
  if (data.format !== kFormat) {
    throw new Error(`the data has format ${data.format}, this page reads format ${kFormat}`);
  }
  const run = data.run ?? {};
  const times = await unpack(data.time);
  const seconds = secondsOf(times);
  const columns = [];
  for (const description of data.columns) {
    columns.push(await readColumn(description, seconds));
    progress(columns.length / data.columns.length);
    await pause();
  }
  const activity = byComponent(await Promise.all((data.activity ?? []).map(readActivity)));
  const units = unitNames(run, activity);
  const report = {
    run,
    version: data.stride,
    notes: data.notes ?? [],
    times,
    seconds,
    columns: new Map(columns.map((column) => [column.name, column])),
    plots: data.plots ?? [],
    messages: (data.messages ?? []).map(readMessage),
    units,
    activity,
    idle: allIdle(units, activity),
    films: await Promise.all((data.films ?? []).map(readFilm)),
    worlds: data.worlds ?? [],
    coverage: data.coverage,
    diagram: data.diagram ?? { components: [], connections: [] },
  };
  report.whole = wholeTime(report, run);
  return report;
}

/** The exact time of a row. */
export const rowTimeText = (report, row) => timeText(report.times[row]);
