// The limits of a brush as fields, for those without a mouse, and for exact ones.
import { numberText } from "../../data/number_text.js";
import { h } from "../../dom.js";

/** What an empty field means, or NaN for what is no number. */
const limitIn = (field, otherwise) => (field.value.trim() === "" ? otherwise : Number(field.value));

const roundText = (value) => numberText(Number(value.toPrecision(4)));

/** `show` takes the limits, or nothing where there are none. */
export function numberFields(column, selection) {
  const field = (word, example) =>
    h("input", {
      type: "text",
      inputMode: "decimal",
      "aria-label": `${column.name} ${word}`,
      placeholder: roundText(example),
    });
  const fields = [field("from", column.least), field("to", column.most)];
  const change = () => {
    const limits = [limitIn(fields[0], -Infinity), limitIn(fields[1], Infinity)];
    fields.forEach((each, i) => each.setAttribute("aria-invalid", String(Number.isNaN(limits[i]))));
    if (limits.some(Number.isNaN)) return;
    const isAll = limits[0] === -Infinity && limits[1] === Infinity;
    selection.brush(column, isAll ? null : limits);
  };
  for (const each of fields) each.addEventListener("change", change);
  const show = (limits) => {
    fields.forEach((each, i) => {
      const isKnown = limits !== undefined && Number.isFinite(limits[i]);
      if (document.activeElement !== each) each.value = isKnown ? numberText(limits[i]) : "";
    });
  };
  return { box: h("fieldset", {}, h("legend", {}, column.name), fields[0], " to ", fields[1]), show };
}

/** One of the texts, or all. */
export function textField(column, selection) {
  const options = column.categories.map((text, place) => h("option", { value: String(place) }, text));
  const select = h("select", { "aria-label": column.name }, h("option", { value: "" }, "all"), ...options);
  select.addEventListener("change", () => {
    const place = Number(select.value);
    selection.brush(column, select.value === "" ? null : [place - 0.5, place + 0.5]);
  });
  const show = (limits) => {
    const places = column.categories.map((_, i) => i).filter((i) => limits && i >= limits[0] && i <= limits[1]);
    select.value = places.length === 1 ? String(places[0]) : "";
  };
  return { box: h("fieldset", {}, h("legend", {}, column.name), select), show };
}
