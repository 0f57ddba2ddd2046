// The scenario as a block diagram, with a layout by dagre.
import { Graph, layout } from "@dagrejs/dagre";
import { h, svg } from "../dom.js";
import { bundles } from "./bundles.js";

const kHeight = 46;
const kCharacter = 7.4;
const kMargin = 12;
/** The number of connections that are listed; further ones are counted. */
const kLines = 24;

function laidOut(diagram, edges) {
  const graph = new Graph({ multigraph: true });
  graph.setGraph({ rankdir: "LR", nodesep: 34, ranksep: 96, edgesep: 26, marginx: kMargin, marginy: kMargin });
  for (const { name, model } of diagram.components) {
    const width = Math.max(96, Math.max(name.length, (model ?? "").length) * kCharacter + 28);
    graph.setNode(name, { width, height: kHeight });
  }
  edges.forEach((edge, index) => {
    graph.setEdge(edge.from, edge.to, { width: 30, height: 18, labelpos: "c" }, String(index));
  });
  layout(graph);
  return graph;
}

/** A smooth line through the points (Catmull-Rom spline, as Bézier curves). */
export function curve(points) {
  let path = `M${points[0].x},${points[0].y}`;
  for (let i = 0; i + 1 < points.length; ++i) {
    const [before, from, to, behind] = [
      points[i - 1] ?? points[i],
      points[i],
      points[i + 1],
      points[i + 2] ?? points[i + 1],
    ];
    const first = { x: from.x + (to.x - before.x) / 6, y: from.y + (to.y - before.y) / 6 };
    const second = { x: to.x - (behind.x - from.x) / 6, y: to.y - (behind.y - from.y) / 6 };
    path += ` C${first.x},${first.y} ${second.x},${second.y} ${to.x},${to.y}`;
  }
  return path;
}

function block({ name, model }, { x, y, width, height }) {
  const box = svg("rect", { x: x - width / 2, y: y - height / 2, width, height, rx: 6 });
  const title = svg("text", { x, y: y - 4, class: "block-name" }, name);
  const below = svg("text", { x, y: y + 13, class: "block-model" }, model ?? "");
  return svg("g", { class: "block" }, box, title, below);
}

/** "a.b → c.d" for each connection, as far as there is room. */
function lines({ connections, isMessage }) {
  const listed = connections.slice(0, kLines).map(({ from, to }) => `${from} → ${to}`);
  const others = connections.length - kLines;
  const head = `${connections.length} ${isMessage ? "for messages" : connections.length === 1 ? "value" : "values"}`;
  return [head, ...listed, ...(others > 0 ? [`and ${others} more`] : [])];
}

function arrow(edge, { points, x, y }, tip) {
  const group = svg(
    "g",
    {
      class: edge.isMessage ? "edge message-edge" : "edge",
      tabindex: 0,
      role: "img",
      "aria-label": lines(edge).join("; "),
    },
    svg("path", { d: curve(points), class: "edge-hit" }),
    svg("path", {
      d: curve(points),
      class: "edge-line",
      "marker-end": `url(#${edge.isMessage ? "message-arrow" : "arrow"})`,
    }),
    svg("rect", { x: x - 14, y: y - 9, width: 28, height: 18, rx: 9, class: "edge-badge" }),
    svg("text", { x, y: y + 4, class: "edge-count" }, String(edge.connections.length)),
  );
  const show = () => tip.show(group.querySelector(".edge-badge"), lines(edge));
  for (const name of ["mouseenter", "focus"]) group.addEventListener(name, show);
  for (const name of ["mouseleave", "blur"]) group.addEventListener(name, () => tip.hide());
  return group;
}

function marker(id) {
  const head = svg("path", { d: "M0,0 L8,4 L0,8 z" });
  return svg(
    "marker",
    { id, viewBox: "0 0 8 8", refX: 8, refY: 4, markerWidth: 7, markerHeight: 7, orient: "auto" },
    head,
  );
}

export function diagramSection({ report, tip }) {
  const { diagram } = report;
  if (diagram.components.length === 0) return null;
  const edges = bundles(diagram);
  const graph = laidOut(diagram, edges);
  const { width, height } = graph.graph();
  const drawing = svg(
    "svg",
    {
      viewBox: `0 0 ${width} ${height}`,
      width,
      height,
      class: "diagram",
      role: "group",
      "aria-label": "Units and connections",
    },
    svg("defs", {}, marker("arrow"), marker("message-arrow")),
    ...edges.map((edge, index) => arrow(edge, graph.edge(edge.from, edge.to, String(index)), tip)),
    ...diagram.components.map((component) => block(component, graph.node(component.name))),
  );
  const note = "A number is the count of connections that an arrow represents; dashed ones carry messages.";
  return h(
    "section",
    { "aria-label": "Diagram" },
    h("h2", {}, "Units and connections"),
    h("p.note", {}, note),
    h("div.scroll", {}, drawing),
  );
}
