// What the reader has changed of a page, for the same page made anew.

/** Where an element is: the title of its part. */
function placeOf(element) {
  const part = element.closest(".row, section, header");
  return part?.querySelector("h2, h3, .lane-name")?.textContent ?? "";
}

/** What can be changed: its state, and how it gets it. Numbers in a name may be others by now. */
const kChangeable = [
  {
    selector: "button[aria-pressed]",
    nameOf: (button) => button.title || button.textContent,
    stateOf: (button) => button.getAttribute("aria-pressed"),
    change: (button) => button.click(),
  },
  {
    selector: "details",
    nameOf: (details) => details.querySelector("summary").textContent.replace(/[\d,]+/g, "#"),
    stateOf: (details) => details.open,
    change: (details, state) => (details.open = state),
  },
  {
    selector: "input, select",
    nameOf: (input) => input.getAttribute("aria-label"),
    stateOf: (input) => input.value,
    change: (input, state) => {
      input.value = state;
      input.dispatchEvent(new Event("input"));
      input.dispatchEvent(new Event("change"));
    },
  },
];

/** Map<where and what, {element, state, change}> */
function changeable(root) {
  const found = new Map();
  for (const { selector, nameOf, stateOf, change } of kChangeable) {
    for (const element of root.querySelectorAll(selector)) {
      const what = JSON.stringify([selector, placeOf(element), nameOf(element)]);
      let key = what;
      for (let i = 2; found.has(key); ++i) key = `${what} ${i}`;
      found.set(key, { element, state: stateOf(element), change });
    }
  }
  return found;
}

/** The state of a page that was just made, and what differs from it later. */
export class Kept {
  /** @param {HTMLElement} root of the page */
  constructor(root) {
    this.root = root;
    this.initial = new Map([...changeable(root)].map(([key, { state }]) => [key, state]));
  }

  /** Changes the page that is there by now as its reader has changed the one before. @returns what does so */
  take() {
    const changed = [...changeable(this.root)].filter(([key, { state }]) => this.initial.get(key) !== state);
    const scrolled = window.scrollY;
    return () => {
      const now = changeable(this.root);
      for (const [key, { state }] of changed) {
        const same = now.get(key);
        if (same && same.state !== state) same.change(same.element, state);
      }
      window.scrollTo(0, scrolled);
    };
  }
}

/** Shows in a view what another one shows, if its reader has chosen that; a cursor that follows the mouse is no choice. */
export function keepView(view, before) {
  const isChosen = before.isHeld || !before.isWhole;
  if (!isChosen && view.isHeld) return; // a failure, where the page opens by itself
  view.releaseCursor();
  if (before.isWhole) view.showWhole();
  else view.show(before.from, before.until);
  if (before.isHeld) view.holdCursor(before.cursor);
  else view.moveCursor(before.cursor);
}
