// SPDX-License-Identifier: MIT
// Shows the document that stands in the page: sections of parts of blocks.
import { armBlock } from "./arm.js";
import { barsBlock } from "./bars.js";
import { chartBlock, completed, drawCharts, watchMedia } from "./chart.js";
import { element } from "./dom.js";
import { formulaBlock } from "./mathml.js";
import { drawMatrices, matrixBlock } from "./matrix.js";
import { tableBlock } from "./tables.js";

const kBlocks = {
  text: ({ text, tone }) => element("p", { class: tone === "plain" ? null : tone, text }),
  list: ({ items }) => element("ul", {}, items.map((text) => element("li", { text }))),
  facts: ({ items }) => element("dl", { class: "facts" }, items.map(({ label, value, note }) =>
    element("div", {}, element("dt", { text: label }), element("dd", {}, element("span", { class: "big", text: value }),
      note ? element("span", { class: "quiet", text: note }) : null)))),
  table: (block) => tableBlock(block),
  code: ({ text }) => element("pre", { tabindex: "0" }, element("code", { text: text.trimEnd() })),
  formula: formulaBlock,
  bars: barsBlock,
  matrix: matrixBlock,
  chart: chartBlock,
  arm: armBlock,
};

function partOf(part) {
  const blocks = part.blocks.map((block) => kBlocks[block.type](block));
  if (part.word === "" && part.title === "") return element("div", { class: "part", id: part.id || null }, blocks);
  const heading = element("h3", {}, part.word ? element("span", { class: "word", text: part.word }) : null,
    part.word && part.title ? " " : null, part.title ? element("span", { text: part.title }) : null);
  return element("div", { class: part.word ? "part step" : "part", id: part.id || null }, heading,
    element("div", { class: "body" }, blocks));
}

function sectionOf(section) {
  return element("section", { class: section.kind, id: section.id, "aria-labelledby": `${section.id}-title` },
    element("h2", { id: `${section.id}-title`, text: section.title }), section.parts.map(partOf));
}

function show(report) {
  document.title = `${report.title}: ${report.kind}`;
  const body = element("main", { id: "content" }, report.sections.map(sectionOf));
  const header = element("header", {},
    element("p", { class: "kind", text: report.subtitle }), element("h1", { text: report.title }));
  if (report.state) header.append(element("p", { class: `state ${report.state}`, text: report.state_text }));
  const contents = element("nav", { "aria-label": "Contents" }, element("ol", {}, report.sections.map((section) =>
    element("li", { class: section.kind }, element("a", { href: `#${section.id}`, text: section.title })))));
  const footer = element("footer", {}, element("p", { text: report.origin }));
  document.body.append(element("a", { class: "skip", href: "#content", text: "To the report" }), header, contents, body, footer);
  if (location.hash) document.getElementById(location.hash.slice(1))?.scrollIntoView();
  drawCharts(() => { document.documentElement.dataset.drawn = "all"; });
  drawMatrices();
  watchMedia();
  // charts paint before the next frame: then it is there to be read
  requestAnimationFrame(() => requestAnimationFrame(() => {
    document.documentElement.dataset.seconds = (performance.now() / 1000).toFixed(3);
  }));
}

show(completed(JSON.parse(document.getElementById("report").textContent)));
