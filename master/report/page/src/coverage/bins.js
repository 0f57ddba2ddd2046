// How the bins of a point lie: in a row, or in a matrix of what their names are made of.

/** What joins the two parts of a name, by the kind of the point. */
const kJoints = { transitions: " -> ", sequences: " -> ", cross: " × " };

/** The two parts of a name; nothing if it has another number of them. */
function partsOf(name, joint) {
  const parts = name.split(joint);
  return parts.length === 2 ? parts : undefined;
}

/**
 * A matrix with the first part of a name down and the second one across, in the order in which they appear.
 * @param {{kind: string, bins: {name: string}[]}} point
 * @returns {{down: string[], across: string[], at: Map<string, Map<string, object>>} | undefined} nothing if the names
 *   are not pairs, or a matrix of them would be mostly empty
 */
export function matrixOf({ kind, bins }) {
  const joint = kJoints[kind];
  if (joint === undefined) return undefined;
  const at = new Map();
  const across = new Set();
  for (const bin of bins) {
    const parts = partsOf(bin.name, joint);
    if (!parts) return undefined;
    if (!at.has(parts[0])) at.set(parts[0], new Map());
    at.get(parts[0]).set(parts[1], bin);
    across.add(parts[1]);
  }
  const isDense = at.size > 1 && across.size > 1 && bins.length * 4 >= at.size * across.size;
  return isDense ? { down: [...at.keys()], across: [...across], at } : undefined;
}

/** Of the bins that count. */
export function coveredOf({ bins, at_least: atLeast }) {
  const counting = bins.filter((bin) => !bin.ignored);
  return { covered: counting.filter(({ count }) => count >= atLeast).length, all: counting.length };
}

/** From 0 to 1, by the logarithm of the number of visits. */
export function depthOf(count, most) {
  return most <= 1 ? 1 : Math.log1p(count) / Math.log1p(most);
}

/** @returns {"ignored"|"missed"|"few"|"hit"} */
export function stateOf(bin, atLeast) {
  if (bin.ignored) return "ignored";
  if (bin.count === 0) return "missed";
  return bin.count < atLeast ? "few" : "hit";
}
