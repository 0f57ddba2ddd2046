// Time is an integer count of picoseconds, and is shown exactly. Doubles are used for drawing only.

const kPicoseconds = 1_000_000_000_000n;
const kTwo32 = 4294967296;

/**
 * A count of picoseconds as seconds, as in signals.csv: no digit is lost, none is added.
 * @param {bigint} picoseconds
 */
export function timeText(picoseconds) {
  const sign = picoseconds < 0n ? "-" : "";
  const count = picoseconds < 0n ? -picoseconds : picoseconds;
  const fraction = (count % kPicoseconds).toString().padStart(12, "0").replace(/0+$/, "");
  return `${sign}${count / kPicoseconds}${fraction ? `.${fraction}` : ""}`;
}

/**
 * Seconds of all instants, each rounded once or twice, in the order of the instants.
 * @param {BigInt64Array|bigint[]} picoseconds
 */
export function secondsOf(picoseconds) {
  if (Array.isArray(picoseconds)) return Float64Array.from(picoseconds, toSeconds);
  const words = new Int32Array(picoseconds.buffer, picoseconds.byteOffset, picoseconds.length * 2);
  const seconds = new Float64Array(picoseconds.length);
  for (let i = 0; i < seconds.length; ++i) {
    seconds[i] = (words[2 * i + 1] * kTwo32 + (words[2 * i] >>> 0)) / 1e12;
  }
  return seconds;
}

/** The same for one instant. */
export const toSeconds = (picoseconds) => Number(picoseconds) / 1e12;

/**
 * The last index whose time is at or before `time`; -1 if there is none.
 * @param {ArrayLike<number|bigint>} times ascending
 */
export function lastAtOrBefore(times, time) {
  let low = -1;
  let high = times.length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle;
  }
  return low;
}
