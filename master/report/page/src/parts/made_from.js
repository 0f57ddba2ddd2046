// What results were made from: when, where, by which command, and of which files.
import { h } from "../dom.js";

const kShownDigits = 12;

const isText = (value) => typeof value === "string" && value !== "";

function sourceRow({ what, path, sha256 }) {
  const digest = h("code", { title: sha256 ?? "" }, (sha256 ?? "").slice(0, kShownDigits));
  const file = isText(path) ? h("td", {}, h("code", {}, path)) : null;
  return h("tr", {}, h("th", { scope: "row" }, what), file, h("td", {}, digest));
}

function sourceTable(sources) {
  if (sources.length === 0) return null;
  const heads = ["", ...(isText(sources[0].path) ? ["file"] : []), "SHA-256"];
  return h(
    "div.scroll",
    { tabIndex: 0 },
    h(
      "table.sources",
      {},
      h("thead", {}, h("tr", {}, ...heads.map((text) => h("th", { scope: "col" }, text)))),
      h("tbody", {}, ...sources.map(sourceRow)),
    ),
  );
}

/** A section that is closed at first. `parts` are shown above the table of the sources. */
export function madeFrom(parts, sources) {
  return h(
    "details.made-from",
    { "aria-label": "What this was made from" },
    h("summary", {}, "What this was made from"),
    ...parts,
    sourceTable(sources),
  );
}

function commandLine({ text, folder }, isFirst) {
  const where = isText(folder) ? [" in ", h("code", {}, folder)] : [];
  return h("p.command-line", {}, isFirst ? "" : "and then ", h("code", {}, text), ...where);
}

/** Of a run, as run.json has it; null where it does not say. */
export function provenance(run) {
  const { version, date, host, commands = [], sources = [] } = run.provenance ?? {};
  if (!Array.isArray(commands) || !Array.isArray(sources) || !isText(version)) return null;
  const where = isText(host) ? ` on ${host}` : "";
  const begin = h("p.note", {}, `stride ${version} began it at ${date}${where} by`);
  return madeFrom([begin, ...commands.map((command, i) => commandLine(command, i === 0))], sources);
}
