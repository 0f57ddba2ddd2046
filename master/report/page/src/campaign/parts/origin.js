// When and where the cases ran, and what they were made from.
import { h } from "../../dom.js";
import { madeFrom } from "../../parts/made_from.js";
import { casesText } from "../data/counting.js";

/** "3 cases on a, 1 case on b, from 2026-11-25T23:59:59Z to …"; empty if none has run. */
export function whereText({ began, hosts }) {
  const [first, last] = began;
  if (first === "") return "";
  const places = hosts.map(({ name, cases }) => `${casesText(cases)} on ${name || "a host without a name"}`);
  const when = first === last ? `at ${first}` : `from ${first} to ${last}`;
  return `${places.join(", ")}, which began ${when}`;
}

export function origin({ stride, campaign, began, hosts, sources }) {
  const where = whereText({ began, hosts });
  const text = `stride ${stride} ran ${campaign.file}${where === "" ? "" : `: ${where}`}.`;
  return madeFrom([h("p.note", {}, text)], sources);
}
