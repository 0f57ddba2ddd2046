// The actions of the keys. The bindings are a table, from which the help is also made.

/** The number of samples with Shift. */
export const kManySamples = 10;

/**
 * @typedef {object} Binding
 * @property {string[]} keys as named in events
 * @property {string} shown in the help
 * @property {string} text
 * @property {string} action
 * @property {any} [argument]
 */

/** @type {Binding[]} */
export const kBindings = [
  { keys: ["ArrowRight"], shown: "→", text: "next sample (Shift: ten)", action: "moveBySamples", argument: 1 },
  { keys: ["ArrowLeft"], shown: "←", text: "sample before (Shift: ten)", action: "moveBySamples", argument: -1 },
  { keys: ["n"], shown: "n", text: "next message", action: "moveByMessages", argument: 1 },
  { keys: ["p"], shown: "p", text: "message before", action: "moveByMessages", argument: -1 },
  { keys: [" "], shown: "Space", text: "play or pause", action: "play" },
  { keys: ["Home"], shown: "Home", text: "first sample", action: "moveBySamples", argument: -Infinity },
  { keys: ["End"], shown: "End", text: "last sample", action: "moveBySamples", argument: Infinity },
  { keys: ["+", "="], shown: "+", text: "zoom in at the cursor", action: "zoom", argument: 0.5 },
  { keys: ["-", "_"], shown: "-", text: "zoom out", action: "zoom", argument: 2 },
  { keys: ["["], shown: "[", text: "earlier", action: "pan", argument: -0.5 },
  { keys: ["]"], shown: "]", text: "later", action: "pan", argument: 0.5 },
  { keys: ["0"], shown: "0", text: "the whole run", action: "showWhole" },
  { keys: ["Escape"], shown: "Esc", text: "release the cursor", action: "releaseCursor" },
  { keys: ["d"], shown: "d", text: "light or dark", action: "switchTheme" },
  { keys: ["?"], shown: "?", text: "show the keys", action: "showHelp" },
];

/**
 * The binding of a key, if there is one: an action and its argument.
 * @param {{key: string, shiftKey?: boolean, ctrlKey?: boolean, altKey?: boolean, metaKey?: boolean}} event
 */
export function actionOf({ key, shiftKey, ctrlKey, altKey, metaKey }) {
  if (ctrlKey || altKey || metaKey) return undefined;
  const binding = kBindings.find(({ keys }) => keys.includes(key));
  if (!binding) return undefined;
  const factor = binding.action === "moveBySamples" && shiftKey ? kManySamples : 1;
  const argument = typeof binding.argument === "number" ? binding.argument * factor : binding.argument;
  return { action: binding.action, argument };
}

/** Keys that a part of the page needs for itself. */
function isTaken({ target, key }) {
  const takers = `input, select, textarea, dialog, [contenteditable]${key === " " ? ", button, summary" : ""}`;
  return target instanceof Element && target.closest(takers) !== null;
}

/**
 * @param {Record<string, (argument: any) => void>} actions by name; keys of others do nothing
 * @param {AbortSignal} [signal] that it ends
 */
export function listenToKeys(actions, signal) {
  const listen = (event) => {
    const meant = isTaken(event) ? undefined : actionOf(event);
    if (!meant || !actions[meant.action]) return;
    event.preventDefault();
    actions[meant.action](meant.argument);
  };
  document.addEventListener("keydown", listen, { signal });
}
