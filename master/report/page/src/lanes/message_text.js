// Messages in lines of text.
import { timeText } from "../data/exact_time.js";

/** Further messages are only counted. */
const kLines = 14;

/** "14.2 s  reader sent transmit.frame: set_led 1" for each. */
export function messageLines(messages) {
  const lines = messages.slice(0, kLines).map(messageLine);
  const others = messages.length - kLines;
  return others > 0 ? [...lines, `and ${others} more`] : lines;
}

export function messageLine({ time, component, variable, direction, content, payload }) {
  return `${timeText(time)} s  ${component} ${direction} ${variable}: ${content || payload}`;
}
