// A page that follows its run: events of the server that it comes from say when there is something new.

/** The next update is so many times as long after one as that took, so that a large run is not only read. */
const kRest = 4;
/** Failures of the connection in a row, behind which it is given up: the run was killed. */
const kMostFailures = 5;

export const isLive = () => document.querySelector('meta[name="stride-live"]') !== null;

/** The data in the page as it is now. */
async function fetchData() {
  const answer = await fetch(location.href, { cache: "no-store" });
  if (!answer.ok) throw new Error(`${answer.status}: ${await answer.text()}`);
  const page = new DOMParser().parseFromString(await answer.text(), "text/html");
  return JSON.parse(page.getElementById("stride-report").textContent);
}

const rest = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

/** One update at a time; what is new meanwhile is in the next one. */
export class Follower {
  #hasNews = false;
  #isBusy = false;
  #isPaused = false;
  #failures = 0;

  /**
   * @param {object} page
   * @param {(data: object) => Promise<void>} page.update shows other data
   * @param {(data: object) => Promise<void>} page.conclude shows the last data
   * @param {(isConnected: boolean) => void} page.connect
   * @param {import("./mark.js").LiveMark} mark
   */
  constructor(page, mark) {
    this.page = page;
    this.mark = mark;
    this.isOver = false;
  }

  start() {
    const events = (this.events = new EventSource("events"));
    events.addEventListener("open", () => this.#onOpen());
    events.addEventListener("error", () => this.#onError());
    events.addEventListener("update", () => this.#onNews());
    events.addEventListener("end", () => this.#onEnd());
    document.addEventListener("visibilitychange", () => this.#refresh());
  }

  pause(isPaused) {
    this.#isPaused = isPaused;
    this.mark.show(isPaused ? "paused" : "live");
    this.#refresh();
  }

  #onOpen() {
    this.#failures = 0;
    this.page.connect(true);
    this.mark.show(this.#isPaused ? "paused" : "live");
  }

  #onError() {
    if (this.isOver) return;
    this.page.connect(false);
    this.mark.show("lost");
    if (++this.#failures >= kMostFailures) this.events.close();
  }

  #onNews() {
    this.#hasNews = true;
    this.#refresh();
  }

  /** The last page is fetched at once, since the server does not wait for long, though another one may be read. */
  async #onEnd() {
    this.isOver = true;
    this.events.close();
    try {
      const data = await fetchData();
      await this.reading;
      await this.page.conclude(data);
      this.mark.show("ended");
    } catch (error) {
      this.mark.show("ended");
      this.mark.text.textContent = "the last values are in report.html";
      console.warn(`the last page cannot be read: ${error.message}`);
    }
  }

  async #refresh() {
    if (this.#isBusy || !this.#hasNews || this.#isPaused || this.isOver || document.hidden) return;
    this.#isBusy = true;
    this.#hasNews = false;
    const begin = performance.now();
    this.reading = this.#read();
    await this.reading;
    await rest(kRest * (performance.now() - begin));
    this.#isBusy = false;
    this.#refresh();
  }

  async #read() {
    try {
      const data = await fetchData();
      if (!this.isOver && !this.#isPaused) await this.page.update(data);
    } catch (error) {
      console.warn(`the page cannot be updated: ${error.message}`);
    }
  }
}
