// The campaign that the page shows, unpacked from the data that `stride campaign` put into it.
import { unpack } from "../../data/blob.js";
import { Column } from "./column.js";

const kFormat = 1;

/** Of texts that are joined: a 0 is behind each. */
async function unpackTexts({ count, bytes }) {
  const joined = new TextDecoder().decode(await unpack(bytes));
  const texts = joined.split("\0");
  texts.pop();
  if (texts.length !== count) throw new Error(`there are ${texts.length} texts, expected ${count}`);
  return texts;
}

async function readColumn({ name, values }, role) {
  if (values.type !== "strings") return new Column(name, role, await unpack(values));
  return Column.ofTexts(name, role, await unpack(values.indices), values.values);
}

function readMargin({ name, unit, values }) {
  return readColumn({ name: `margin of ${name}${unit ? ` [${unit}]` : ""}`, values }, "margin");
}

async function readCases(cases) {
  const arrays = ["indices", "outcomes", "wall_times", "reached", "failed_at"];
  const texts = ["reasons", "links", "commands", "began", "hosts"];
  const read = [...arrays.map((name) => unpack(cases[name])), ...texts.map((name) => unpackTexts(cases[name]))];
  const found = await Promise.all(read);
  return Object.fromEntries([...arrays, ...texts].map((name, i) => [name, found[i]]));
}

/** @param {object} data of the page */
export async function readCampaign(data) {
  if (data.format !== kFormat) {
    throw new Error(`the data has format ${data.format}, this page reads format ${kFormat}`);
  }
  const cases = await readCases(data.cases);
  const parameters = await Promise.all(data.parameters.map((entry) => readColumn(entry, "parameter")));
  const aggregates = await Promise.all(data.aggregates.map((entry) => readColumn(entry, "aggregate")));
  const margins = await Promise.all((data.margins ?? []).map(readMargin));
  const reached = new Column("reached [s]", "time", cases.reached);
  const times = [
    new Column("first failure [s]", "time", cases.failed_at),
    ...(reached.varies ? [reached] : []),
    new Column("wall time [s]", "time", cases.wall_times),
  ];
  return {
    ...data,
    cases,
    count: cases.indices.length,
    parameters,
    aggregates,
    margins,
    times: times.filter((column) => column.least <= column.most),
  };
}
