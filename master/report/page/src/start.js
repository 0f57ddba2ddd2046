// From the data in a page to its parts.
import { h, pause } from "./dom.js";

async function start(activity, read, build) {
  const loading = document.getElementById("loading");
  const element = document.getElementById("stride-report");
  if (!element) throw new Error("there is no data in this page");
  if (typeof DecompressionStream === "undefined")
    throw new Error("this browser is too old: it has no DecompressionStream");
  await pause();
  const data = JSON.parse(element.textContent);
  element.remove();
  const report = await read(data, (share) => {
    loading.textContent = `${activity} … ${Math.round(share * 100)} %`;
  });
  // for tests and debugging
  window.stride = build(report);
  document.getElementById("report").setAttribute("aria-busy", "false");
}

/**
 * Shows why, if it cannot be done.
 * @param {string} activity shown meanwhile: "Reading the run"
 * @param {(data: object, progress: (share: number) => void) => Promise<any>} read unpacks the data
 * @param {(report: any) => object} build fills the page; its result is `window.stride`
 */
export function startPage(activity, read, build) {
  start(activity, read, build).catch((error) => {
    const text = `This report cannot be shown: ${error.message}.`;
    document.getElementById("report").replaceChildren(h("p.banner.bad", { role: "alert" }, text));
    console.error(error);
  });
}
