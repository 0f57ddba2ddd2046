// Where the marks of messages stand in a lane, and what is written beside them.

/** Marks nearer than this are one [px]. */
export const kMarkWidth = 12;
/** A text needs this much room [px]. */
const kTextRoom = 28;
/** Between a text and the next mark [px]. */
const kGap = 6;
/** A character of "+12" [px]. */
const kDigit = 7;

/** How far the next mark must be from this one [px]: behind "+12", where that stands there. */
function widthOf(mark) {
  const others = mark.messages.length - 1;
  return kMarkWidth + (others > 0 ? kGap + kDigit * (1 + String(others).length) : 0);
}

/**
 * @typedef {object} Mark
 * @property {number} x [px]
 * @property {object[]} messages all that stand here, in their order
 * @property {string} text of the first one, with "+2" where two more stand here; empty where there is no room
 * @property {string} more "+2", which is always there where there are more
 * @property {number} room for text [px]
 */

/**
 * The marks of one lane. Messages at almost the same place share one.
 * @param {{seconds: number, content: string}[]} messages ascending
 * @param {{from: number, until: number}} view [s]
 * @param {number} width [px]
 * @returns {Mark[]}
 */
export function layOut(messages, view, width) {
  const marks = [];
  const scale = width / (view.until - view.from);
  for (const message of messages) {
    if (message.seconds < view.from || message.seconds > view.until) continue;
    const x = (message.seconds - view.from) * scale;
    const last = marks.at(-1);
    if (last && x - last.x < widthOf(last)) last.messages.push(message);
    else marks.push({ x, messages: [message], text: "", more: "", room: 0 });
  }
  marks.forEach((mark, index) => label(mark, marks[index + 1]?.x ?? width));
  return marks;
}

function label(mark, next) {
  const others = mark.messages.length - 1;
  mark.more = others > 0 ? `+${others}` : "";
  mark.room = Math.max(0, next - mark.x - widthOf(mark) - kGap);
  if (mark.room >= kTextRoom) mark.text = shortText(mark.messages[0]);
}

/** What a message says, or the beginning of its bytes where nobody knows. */
export function shortText(message) {
  if (message.content) return message.content;
  const { payload } = message;
  return payload.length > 16 ? `${payload.slice(0, 16)}…` : payload;
}

/** The messages of each component: Map<component, messages>. */
export function byComponent(messages) {
  const lanes = new Map();
  for (const message of messages) {
    if (!lanes.has(message.component)) lanes.set(message.component, []);
    lanes.get(message.component).push(message);
  }
  return lanes;
}
