// SPDX-License-Identifier: MIT
import { element, numberText } from "./dom.js";

const kShort = 9;  // letters of a label that fit beside the bars of a joint

/** Bars of numbers side by side, a group a joint, as a list that can be read without seeing it. */
export function barsBlock({ id, title, caption, groups }) {
  const key = element("ul", { class: "key" }, (groups[0]?.bars ?? []).map((bar) =>
    element("li", {}, element("span", { class: `swatch ${bar.role}`, "aria-hidden": "true" }), bar.name)));
  const rows = groups.map((group) => {
    const most = Math.max(1e-300, ...group.bars.map((bar) => bar.value ?? 0));
    const bars = group.bars.map((bar) => {
      const fill = element("span", { class: `fill ${bar.role}` });
      fill.style.width = `${(100 * (bar.value ?? 0)) / most}%`;
      return element("li", {},
        element("span", { class: "track", "aria-hidden": "true" }, fill),
        element("span", { class: "value" },
          element("span", { class: "hidden", text: `${bar.name}: ` }),
          bar.value === null ? "not known" : numberText(bar.value, 3),
          element("span", { class: "hidden", text: ` ${group.unit}` })));
    });
    return element("div", { class: group.marked ? "group marked" : "group" },
      element("p", { class: "label" }, element("strong", { text: group.label }),
        element("span", { class: "quiet", text: group.unit })),
      element("ul", { class: "bars" }, bars));
  });
  const wide = groups.some(({ label }) => label.length > kShort);
  return element("figure", { class: "barfigure", id },
    element("figcaption", { text: title }), key, element("div", { class: wide ? "groups wide" : "groups" }, rows),
    caption ? element("p", { class: "note", text: caption }) : null);
}
