// Layout of the marks of messages in a lane, and of the texts beside them.

/** Marks nearer than this are combined [px]. */
export const kMarkWidth = 12;
/** Minimum width of a text [px]. */
const kTextRoom = 28;
/** Distance between a text and the next mark [px]. */
const kGap = 6;
/** Width of a character of "+12" [px]. */
const kDigit = 7;

/** Minimum distance of the next mark [px]: after "+12", if there is one. */
function widthOf(mark) {
  const others = mark.messages.length - 1;
  return kMarkWidth + (others > 0 ? kGap + kDigit * (1 + String(others).length) : 0);
}

/**
 * @typedef {object} Mark
 * @property {number} x [px]
 * @property {object[]} messages all messages of this mark, in their order
 * @property {string} text of the first one, with "+2" if there are two more; empty if there is no room
 * @property {string} more "+2", shown whenever there are more
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

/** So many marks without room for a text, for so many messages each, are a crowd. */
const kCrowdMarks = 4;
const kCrowdMessages = 2;
/** Width of a bar of a crowd [px]. */
export const kBar = 4;

/**
 * @typedef {object} Crowd in place of marks that stand too close to be told apart
 * @property {number} x [px]
 * @property {number} width [px]
 * @property {object[]} messages in their order
 * @property {{x: number, count: number}[]} bars from `x` [px], and the number of messages in each
 */

/**
 * Marks, but crowds in place of those that stand too close.
 * @param {Mark[]} marks of a lane
 * @param {(message: object) => number} place of a message [px]
 * @returns {(Mark|Crowd)[]}
 */
export function gatherCrowds(marks, place) {
  const found = [];
  let run = [];
  for (const mark of marks) {
    run.push(mark);
    if (mark.text === "") continue;
    found.push(...crowdOf(run, place));
    run = [];
  }
  return [...found, ...crowdOf(run, place)];
}

/** The marks themselves if they are few, or of few messages. */
function crowdOf(marks, place) {
  const messages = marks.flatMap((mark) => mark.messages);
  if (marks.length < kCrowdMarks || messages.length < kCrowdMessages * marks.length) return marks;
  const begin = Math.floor(place(messages[0]) / kBar) * kBar;
  const bars = [];
  for (const message of messages) {
    const x = Math.floor(place(message) / kBar) * kBar - begin;
    if (bars.at(-1)?.x === x) ++bars.at(-1).count;
    else bars.push({ x, count: 1 });
  }
  return [{ x: begin, width: bars.at(-1).x + kBar, messages, bars }];
}

function label(mark, next) {
  const others = mark.messages.length - 1;
  mark.more = others > 0 ? `+${others}` : "";
  mark.room = Math.max(0, next - mark.x - widthOf(mark) - kGap);
  if (mark.room >= kTextRoom) mark.text = shortText(mark.messages[0]);
}

/** The content of a message, or the beginning of its bytes if the content is unknown. */
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
