// The time axis above all rows.
import { sizedContext } from "../dom.js";
import { color } from "./colors.js";
import { kGutter } from "./layout.js";
import { ticks, timeTickTexts } from "./ticks.js";

const kHeight = 24;
const kFont = "11px system-ui, sans-serif";
/** The approximate width of a character of a text, and the room around the text [px]. */
const kCharacter = 6.2;
const kRoom = 28;

/** The number of ticks that fit, with texts as long as those of this view. @param {number} width [px] */
export function timeTicks(view, width) {
  for (let most = Math.max(2, Math.floor(width / 48)); ; --most) {
    const found = ticks(view.from, view.until, most);
    const texts = timeTickTexts(found.values, found.step);
    const longest = Math.max(0, ...texts.map((text) => text.length));
    if (most <= 2 || found.values.length * (longest * kCharacter + kRoom) <= width) return { ...found, texts };
  }
}

export class Ruler {
  constructor({ view }) {
    this.view = view;
    this.box = document.createElement("canvas");
    this.box.className = "ruler";
    this.box.setAttribute("aria-hidden", "true");
  }

  draw(width) {
    const plotted = width - kGutter;
    const context = sizedContext(this.box, width, kHeight);
    const { values, texts } = timeTicks(this.view, plotted);
    context.font = kFont;
    context.fillStyle = color("--quiet-text");
    context.textBaseline = "middle";
    context.textAlign = "left";
    context.fillText("time [s]", 2, kHeight / 2);
    context.textAlign = "center";
    values.forEach((value, index) => {
      const x = kGutter + this.view.shareOf(value) * plotted;
      const half = context.measureText(texts[index]).width / 2;
      context.fillRect(Math.round(x), kHeight - 5, 1, 5);
      if (x - half > kGutter - 30) context.fillText(texts[index], Math.min(x, width - half - 1), kHeight / 2 - 2);
    });
  }
}
