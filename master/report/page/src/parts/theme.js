// Light or dark: the system's setting, until the user chooses.

const kDark = window.matchMedia("(prefers-color-scheme: dark)");

export class Theme extends EventTarget {
  constructor() {
    super();
    this.chosen = null;
    kDark.addEventListener("change", () => this.#apply());
    this.#apply();
  }

  get isDark() {
    return this.chosen === null ? kDark.matches : this.chosen === "dark";
  }

  switch() {
    this.choose(this.isDark ? "light" : "dark");
  }

  /** @param {"light"|"dark"|null} theme null: the system's setting */
  choose(theme) {
    this.chosen = theme;
    this.#apply();
  }

  #apply() {
    document.documentElement.dataset.theme = this.isDark ? "dark" : "light";
    this.dispatchEvent(new Event("change"));
  }
}
