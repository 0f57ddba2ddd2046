// What a page with worlds in 3D has in addition: a script of its own, `strideWorld`, which the others are without.
import { h } from "../dom.js";
import { kWorldMouse } from "./mouse.js";
import { Player } from "./player.js";
import { playerButtons } from "./player_buttons.js";
import style from "./style.css";
import { WorldView } from "./view.js";

document.head.append(h("style", {}, style));

/**
 * @param {import("../lanes/film.js").FilmStrip[]} films that of a world's component is shown in the same place
 * @returns {WorldView[]} of all worlds of the report
 */
export function worldViews(context, films) {
  const filmOf = (component) => films.find(({ film }) => film.component === component);
  return context.report.worlds.map((world) => new WorldView(context, world, filmOf(world.component)));
}

export { kWorldMouse, Player, playerButtons };
