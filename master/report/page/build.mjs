// node build.mjs NODE_MODULES OUTPUT_FOLDER: bundles each page into one html text, such as report_page.html, and what
// draws worlds in 3D into world_script.json and world_licences.html, and makes a C++ source of all, page.cpp.
// NODE_MODULES is the folder into which `npm ci` installed the packages of package-lock.json.
import { mkdir, readFile, writeFile } from "node:fs/promises";
import { createRequire } from "node:module";
import path from "node:path";
import process from "node:process";
import { fileURLToPath } from "node:url";
import { deflateRawSync } from "node:zlib";

const here = path.dirname(fileURLToPath(import.meta.url));
const [nodeModules, output] = process.argv.slice(2).map((folder) => path.resolve(folder));
const { build } = createRequire(path.join(nodeModules, "any.js"))("esbuild");

/** The bundled text of one entry, and its input files. @param {object} [options] of esbuild */
async function bundle(entry, options) {
  const result = await build({
    entryPoints: [path.join(here, entry)],
    nodePaths: [nodeModules],
    bundle: true,
    minify: true,
    charset: "utf8",
    format: "iife",
    target: "es2022",
    legalComments: "inline",
    write: false,
    metafile: true,
    absWorkingDir: here,
    logLevel: "error",
    ...options,
  });
  return { text: result.outputFiles[0].text, inputs: Object.keys(result.metafile.inputs) };
}

/** The package that a bundled file belongs to, or nothing for our own files: "uplot", "@dagrejs/dagre". */
function packageOf(input) {
  const inside = path.relative(nodeModules, path.resolve(here, input)).split(path.sep);
  if (inside[0] === "..") return undefined;
  return inside.slice(0, inside[0].startsWith("@") ? 2 : 1).join("/");
}

/** The packages, and their own dependencies. */
async function withDependencies(packages) {
  const found = new Set(packages);
  for (const name of found) {
    const description = JSON.parse(await readFile(path.join(nodeModules, name, "package.json"), "utf8"));
    for (const dependency of Object.keys(description.dependencies ?? {})) found.add(dependency);
  }
  return [...found].sort();
}

/**
 * The licences of all bundled packages, as their authors require; an empty text if there are none.
 * @param {string} what "this page"
 */
async function licences(inputs, what) {
  const packages = await withDependencies(inputs.map(packageOf).filter(Boolean));
  if (packages.length === 0) return "";
  const texts = packages.map(async (name) => {
    const text = await readFile(path.join(nodeModules, name, "LICENSE"), "utf8");
    return `${name}\n\n${text.trim()}`;
  });
  const all = escapeHtml((await Promise.all(texts)).join("\n\n\n"));
  return `<details class="licences"><summary>Licences of what ${what} is made with</summary><pre>\n${all}\n</pre></details>`;
}

const escapeHtml = (text) => text.replace(/[&<>]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;" })[c]);

/** The text of a page. */
async function pageOf({ script, style, what }) {
  const [code, look, template] = await Promise.all([
    bundle(script),
    bundle(style),
    readFile(path.join(here, "src/page.html"), "utf8"),
  ]);
  const parts = {
    "<!-- stride:style -->": look.text,
    "<!-- stride:what -->": what,
    "<!-- stride:script -->": code.text.replaceAll("</script", "<\\/script"),
    "<!-- stride:licences -->": await licences([...code.inputs, ...look.inputs], "this page"),
  };
  let html = template;
  for (const [mark, text] of Object.entries(parts)) {
    if (html.split(mark).length !== 2) throw new Error(`src/page.html: expected "${mark}" once`);
    html = html.replace(mark, () => text);
  }
  if (html.split("\n<!-- stride:data -->\n").length !== 2) {
    throw new Error('src/page.html: expected the line "<!-- stride:data -->" once');
  }
  return html;
}

/** In the form that the page unpacks (src/data/blob.js). */
function blobOf(text) {
  const bytes = Buffer.from(text, "utf8");
  return JSON.stringify({
    type: "uint8",
    count: bytes.length,
    data: deflateRawSync(bytes, { level: 9 }).toString("base64"),
  });
}

/** What pages with worlds have in addition: the script that draws them, and its licences. */
async function worldParts() {
  const { text, inputs } = await bundle("src/world/main.js", {
    globalName: "strideWorld",
    loader: { ".css": "text" },
  });
  return {
    world_script: { file: "world_script.json", text: blobOf(text) },
    world_licences: { file: "world_licences.html", text: `${await licences(inputs, "the world in 3D")}\n` },
  };
}

/** Compilers limit the length of a string literal, so the text is divided into many pieces. */
function cppFunction(name, text) {
  const pieces = text.match(/[^]{1,12000}/gu).map((piece) => `R"page(${piece})page"`);
  return [
    `std::string_view ${name}() {`,
    "  static constexpr char kPage[] =",
    pieces.join("\n"),
    ";",
    "  return {kPage, sizeof kPage - 1};",
    "}",
    "",
  ].join("\n");
}

const cppSource = (functions) =>
  [
    "// Made from master/report/page by build.mjs.",
    '#include "master/report/page.h"',
    "",
    "namespace stride::report {",
    "",
    ...functions,
    "}  // namespace stride::report",
    "",
  ].join("\n");

/** By the names of their functions in C++. */
const kPages = {
  page: { file: "report_page.html", script: "src/main.js", style: "src/style.css", what: "run" },
  campaign_page: {
    file: "campaign_page.html",
    script: "src/campaign/main.js",
    style: "src/campaign/style.css",
    what: "campaign",
  },
  comparison_page: {
    file: "comparison_page.html",
    script: "src/compare/main.js",
    style: "src/compare/style.css",
    what: "comparison",
  },
};

const parts = await worldParts();
for (const [name, page] of Object.entries(kPages)) parts[name] = { file: page.file, text: await pageOf(page) };
await mkdir(output, { recursive: true });
const functions = [];
for (const [name, { file, text }] of Object.entries(parts)) {
  await writeFile(path.join(output, file), text);
  functions.push(cppFunction(name, text));
}
await writeFile(path.join(output, "page.cpp"), cppSource(functions));
