// The minimum and maximum of any range of rows of a column, in a time that does not depend on the number of rows.

const kFactor = 4;

/**
 * Each level has the minimum and maximum of `kFactor` entries of the level below; the lowest is of rows. NaN is
 * ignored, so a range with NaN only has Infinity and -Infinity.
 */
export class Pyramid {
  /** @param {ArrayLike<number>} values */
  constructor(values) {
    this.values = values;
    this.levels = [];
    let least = values;
    let most = values;
    while (least.length > kFactor) {
      const level = nextLevel(least, most);
      this.levels.push(level);
      ({ least, most } = level);
    }
  }

  /**
   * The minimum and maximum of the rows in [begin, end).
   * @returns {{least: number, most: number}} with least > most if there is none
   */
  extremes(begin, end) {
    const found = { least: Infinity, most: -Infinity };
    this.#gather(-1, begin, end, found);
    return found;
  }

  /** Takes the ends of [begin, end) from this level, and the part between from the next one. */
  #gather(level, begin, end, found) {
    const least = level < 0 ? this.values : this.levels[level].least;
    const most = level < 0 ? this.values : this.levels[level].most;
    const isTop = level + 1 === this.levels.length;
    const first = isTop ? end : Math.min(end, Math.ceil(begin / kFactor) * kFactor);
    const last = isTop ? end : Math.max(first, Math.floor(end / kFactor) * kFactor);
    for (let i = begin; i < first; ++i) widen(found, least[i], most[i]);
    for (let i = last; i < end; ++i) widen(found, least[i], most[i]);
    if (last > first) this.#gather(level + 1, first / kFactor, last / kFactor, found);
  }
}

function widen(found, least, most) {
  if (least < found.least) found.least = least;
  if (most > found.most) found.most = most;
}

function nextLevel(leastBelow, mostBelow) {
  const count = Math.ceil(leastBelow.length / kFactor);
  const least = new Float64Array(count);
  const most = new Float64Array(count);
  for (let i = 0; i < count; ++i) {
    const entry = { least: Infinity, most: -Infinity };
    const end = Math.min(leastBelow.length, (i + 1) * kFactor);
    for (let j = i * kFactor; j < end; ++j) widen(entry, leastBelow[j], mostBelow[j]);
    least[i] = entry.least;
    most[i] = entry.most;
  }
  return { least, most };
}
