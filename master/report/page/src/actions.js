// What the keys and buttons of pages with a time axis do, and what such a page is on paper.
import { moveByMessages, moveBySamples } from "./cursor.js";

/** @returns {Record<string, (argument?: any) => void>} */
export function actionsOf(context, theme, help) {
  const { view, player } = context;
  return {
    moveBySamples: (count) => moveBySamples(context, count),
    moveByMessages: (direction) => moveByMessages(context, direction),
    play: player && (() => player.toggle()),
    zoom: (factor) => view.zoom(factor),
    pan: (share) => view.pan(share),
    showWhole: () => view.showWhole(),
    releaseCursor: () => view.releaseCursor(),
    switchTheme: () => theme.switch(),
    showHelp: () => {
      help.showModal();
      help.scrollTop = 0; // the focus is on the button at its end
    },
  };
}

/** Printed pages are light and complete. @param {AbortSignal} [signal] that it ends */
export function printWell(theme, stack, signal) {
  let chosen = null;
  const prepare = () => {
    chosen = theme.chosen;
    theme.choose("light");
    stack.drawEverything();
  };
  window.addEventListener("beforeprint", prepare, { signal });
  window.addEventListener("afterprint", () => theme.choose(chosen), { signal });
}
