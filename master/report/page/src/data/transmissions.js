// Messages from end to end: what a component has sent, and who has received it at that instant.

/**
 * @typedef {object} Transmission
 * @property {bigint} time [ps]
 * @property {number} seconds
 * @property {object|null} sent null for what is received later than it was sent, and for an intervention
 * @property {object[]} received
 * @property {object|null} intervention
 */

const fullName = ({ component, variable }) => `${component}.${variable}`;

/** Whether a message goes from one variable to another; null where it is not known. */
function linksOf(connections) {
  const links = connections.filter(({ kind }) => kind === "message").map(({ from, to }) => `${from}\n${to}`);
  const known = new Set(links);
  return links.length === 0 ? null : (from, to) => known.has(`${fullName(from)}\n${fullName(to)}`);
}

/**
 * @param {object[]} messages in their order: a message is sent before it is received
 * @param {{from: string, to: string, kind: string}[]} connections none if they are not known
 * @returns {Transmission[]} each message is in one of them
 */
export function transmissionsOf(messages, connections) {
  const isLinked = linksOf(connections) ?? ((from, to) => from.component !== to.component);
  const found = [];
  let open = [];
  for (const message of messages) {
    const { time, seconds, index, direction } = message;
    if (open.length > 0 && (open[0].time !== time || open[0].sent.index !== index)) open = [];
    const sender = direction === "received" ? open.find((each) => takes(each, message, isLinked)) : undefined;
    if (sender) {
      sender.received.push(message);
      continue;
    }
    const entry = { time, seconds, sent: null, received: [], intervention: null };
    if (direction === "sent") open.push(entry);
    if (direction === "received") entry.received.push(message);
    else entry[direction] = message;
    found.push(entry);
  }
  return found;
}

/** Each variable receives a message once. */
function takes({ sent, received }, message, isLinked) {
  if (sent.payload !== message.payload || !isLinked(sent, message)) return false;
  return !received.some((other) => fullName(other) === fullName(message));
}
