// What mouse and keys do in a world, for the help.

export const kWorldMouse = [
  ["drag", "turn it; with the right button, or two fingers: move it"],
  ["Ctrl + wheel", "nearer, away; without Ctrl after a click"],
  ["double click", "larger or smaller"],
  ["arrow keys", "turn it (Shift: move it), after a click or Tab"],
  ["+, -", "nearer, away, likewise"],
  ["Home", "as at first, likewise"],
];
