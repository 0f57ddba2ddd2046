// The page of a run that goes on, which is updated in place.
import { Follower } from "./follow.js";
import { Kept, keepView } from "./kept.js";
import { LiveMark } from "./mark.js";
import { isAlike, keepRow, takeOver } from "./update.js";

/**
 * @param {object} report
 * @param {(data: object) => Promise<object>} read makes a report of the data
 * @param {(report: object, options: {signal: AbortSignal, theme?: object, top: HTMLElement}) => object} build fills
 * the page, and listens until the signal
 */
export function buildLivePage(report, read, build) {
  const root = document.getElementById("report");
  const mark = new LiveMark((isPaused) => follower.pause(isPaused));
  const life = { controller: null, kept: null, isConnected: true };
  // Without its end it may have been killed, but not if it answers.
  const knownToGoOn = (shown) => {
    shown.run.goesOn = life.isConnected && shown.run.outcome === "running";
    return shown;
  };
  const readNow = async (data) => knownToGoOn(await read(data));
  const fill = (shown, theme) => {
    life.controller?.abort();
    life.controller = new AbortController();
    const built = build(shown, { signal: life.controller.signal, theme, top: mark.box });
    window.stride = Object.assign(built, { follower });
    life.kept = new Kept(root);
  };
  const rebuild = (later) => {
    const { view, theme } = window.stride;
    const restore = life.kept.take();
    fill(later, theme);
    keepView(window.stride.view, view);
    restore();
  };
  const tell = () => mark.tell(window.stride.report.whole.until);
  const show = async (data) => {
    const later = await readNow(data);
    const { report: shown, view } = window.stride;
    if (isAlike(shown, later)) {
      const before = shown.seconds;
      takeOver(shown, later);
      keepRow(view, before, shown.seconds);
      view.grow(shown.whole);
    } else {
      rebuild(later);
    }
    tell();
  };
  const conclude = async (data) => {
    rebuild(await readNow(data));
    tell();
  };
  const connect = (isConnected) => {
    if (isConnected === life.isConnected) return;
    life.isConnected = isConnected;
    knownToGoOn(window.stride.report);
    window.stride.view.dispatchEvent(new Event("data"));
  };
  const follower = new Follower({ update: show, conclude, connect }, mark);
  fill(knownToGoOn(report));
  mark.show("live");
  tell();
  follower.start();
  return window.stride;
}
