// Connections of a diagram: those of values from one component to another are one edge, those of messages another.
// Clocks are omitted, because they connect the same components as their messages.
import { componentOf } from "../data/components.js";

const kSeparator = "\u0000";

/**
 * A name without a component is a connector of the system itself, and omitted, too.
 * @param {{components: {name: string}[], connections: {from: string, to: string, kind: string}[]}} diagram
 * @returns {{from: string, to: string, isMessage: boolean, connections: {from: string, to: string}[]}[]}
 */
export function bundles(diagram) {
  const components = new Set(diagram.components.map(({ name }) => name));
  const found = new Map();
  for (const connection of diagram.connections) {
    const from = componentOf(connection.from, components);
    const to = componentOf(connection.to, components);
    if (from === null || to === null || connection.kind === "clock") continue;
    const isMessage = connection.kind === "message";
    const key = [from, to, isMessage].join(kSeparator);
    if (!found.has(key)) found.set(key, { from, to, isMessage, connections: [] });
    found.get(key).connections.push(connection);
  }
  return [...found.values()];
}
