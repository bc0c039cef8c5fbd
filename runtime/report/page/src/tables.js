// SPDX-License-Identifier: MIT
import { element, numberText } from "./dom.js";

const kShort = 20;

function cellOf(value) {
  const number = typeof value === "number" || value === null;
  // a unit or a word or two stay on their line
  const kind = number ? "number" : value.length < kShort ? "short" : null;
  return element("td", { class: kind, text: number ? numberText(value) : value });
}

function tableOf(header, rows, caption) {
  const right = header.map((_, i) => rows.length > 0 && rows.every((row) => typeof row[i] !== "string"));
  const head = element("tr", {}, header.map((name, i) =>
    name === "" ? element("td") : element("th", { scope: "col", class: right[i] ? "number" : null, text: name })));
  const body = rows.map((row) => element("tr", {}, row.map(cellOf)));
  return element("table", {}, caption ? element("caption", { class: "hidden", text: caption }) : null,
    element("thead", {}, head), element("tbody", {}, body));
}

/** A table that can be scrolled sideways; long ones open on request. */
export function tableBlock({ header, rows, shown }, caption = "") {
  const scroll = element("div", { class: "scroll" });
  const long = shown > 0 && rows.length > shown + 2;
  const table = tableOf(header, rows, caption);
  scroll.append(table);
  if (!long) return scroll;
  const further = [...table.tBodies[0].rows].slice(shown);
  const hide = (hidden) => further.forEach((row) => row.classList.toggle("further", hidden));
  hide(true);
  const button = element("button", { type: "button", class: "more", "aria-expanded": "false",
    text: `show all ${rows.length} rows` });
  button.addEventListener("click", () => {
    const open = button.getAttribute("aria-expanded") === "true";
    button.setAttribute("aria-expanded", String(!open));
    button.textContent = open ? `show all ${rows.length} rows` : "show fewer rows";
    hide(open);
  });
  return element("div", {}, scroll, button);
}

const kMostRows = 80;

/** The numbers of a panel, made when they are asked for; long ones in steps. */
export function numbersOf(panels) {
  const details = element("details", { class: "numbers" }, element("summary", { text: "Numbers" }));
  details.addEventListener("toggle", () => {
    if (!details.open || details.childElementCount > 1) return;
    for (const panel of panels) {
      const step = Math.ceil(panel.x.length / kMostRows);
      const named = panel.series.filter((series) => series.y.some((value) => value !== null));
      const rows = [];
      for (let i = 0; i < panel.x.length; i += step) {
        rows.push([panel.x[i], ...named.map((series) => series.y[i])]);
      }
      if (step > 1) {
        details.append(element("p", { class: "quiet", text: `Every ${step}th of ${panel.x.length} values.` }));
      }
      const header = [panel.x_label, ...named.map((series) => `${series.name}, ${panel.y_label}`)];
      details.append(tableBlock({ header, rows, shown: 0 }, panel.y_label));
    }
  });
  return details;
}
