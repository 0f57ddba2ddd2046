// Play and pause, and how fast.
import { h } from "../dom.js";
import { kSpeeds } from "./player.js";

/** @param {import("./player.js").Player} player */
export function playerButtons(player) {
  const button = h("button.play", { type: "button", onclick: () => player.toggle() });
  const update = () => {
    const label = player.isPlaying ? "Pause (Space)" : "Play what is shown (Space)";
    button.textContent = player.isPlaying ? "⏸" : "▶";
    button.title = label;
    button.setAttribute("aria-label", label);
  };
  player.addEventListener("change", update);
  update();
  const option = (speed) => h("option", { value: String(speed), selected: speed === player.speed }, `${speed}×`);
  const speed = h(
    "select",
    {
      title: "Simulated seconds in one of yours",
      "aria-label": "Speed",
      onchange: () => (player.speed = Number(speed.value)),
    },
    ...kSpeeds.map(option),
  );
  return h("span.player", {}, button, speed);
}
