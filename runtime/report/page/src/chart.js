// SPDX-License-Identifier: MIT
// A chart: panels with one x axis, that are zoomed by dragging and by keys, and read with a cursor.
import uPlot from "uplot";
import { colour, element, numberText } from "./dom.js";
import { drawMarks, drawUnder, extent, keyOf, wholeRange } from "./paint.js";
import { numbersOf } from "./tables.js";

const kOne = 300, kSeveral = 190;  // pixels: heights of a panel alone, and of one among others
const kPaper = 660;                // pixels: the width of a chart on paper
const charts = new Set();
const waiting = new Map();  // figures that are not drawn yet, with what draws them

/** What is recorded lies broad under the model that follows it. */
function widthOf(series, panel) {
  if (panel.clouds.length > 0) return 2;
  return series.role === "data" ? 3.5 : 1.25;
}

class Chart {
  constructor(chart, panels, holder) {
    this.chart = chart;
    this.panels = panels;
    this.holder = holder;
    this.whole = wholeRange(panels);
    this.zoomed = null;  // told when the range changes
    this.plots = panels.map((panel, place) => this.plotOf(panel, place));
    this.reset();
    charts.add(this);
    this.watch = new ResizeObserver(() => this.fit());
    this.watch.observe(holder);
  }

  plotOf(panel, place) {
    const last = place === this.panels.length - 1;
    const key = keyOf(panel);
    this.holder.append(element("ul", { class: "key" }, key.map((entry) => entry.node)));
    const holder = element("div", { class: "plot" });
    this.holder.append(holder);
    const axis = (own) => ({
      stroke: () => colour("quiet"), grid: { stroke: () => colour("grid"), width: 1 },
      ticks: { stroke: () => colour("line"), width: 1, size: 5 },
      font: "12px system-ui, sans-serif", labelFont: "12px system-ui, sans-serif", labelGap: 2, ...own,
    });
    const options = {
      width: this.width(), height: this.panels.length > 1 ? kSeveral + (last ? 26 : 0) : kOne,
      padding: [10, 14, 0, 0],
      scales: {
        x: { time: false, range: (_, from, to) => (from === null || from === undefined ? this.whole : [from, to]) },
        y: { auto: false, range: (_, from, to) => (from === null || from === undefined ? extent(panel, ...this.whole) : [from, to]) },
      },
      axes: [
        axis({ label: last ? panel.x_label : undefined, labelSize: last ? 22 : 0, size: last ? 34 : 28,
          values: (_, ticks) => ticks.map((tick) => numberText(tick)) }),
        axis({ label: panel.y_label, labelSize: 20, size: 58,
          values: (_, ticks) => ticks.map((tick) => numberText(tick)) }),
      ],
      series: [{}, ...panel.series.map((series) => ({
        stroke: () => colour(series.role === "data" ? "recorded" : series.role), width: widthOf(series, panel),
        dash: series.dashed ? [7, 5] : undefined, points: { show: false }, spanGaps: panel.clouds.length > 0,
        paths: series.marks ? () => null : undefined,
      }))],
      legend: { show: false },
      cursor: { drag: { x: true, y: false, setScale: true }, points: { size: 7 }, sync: { key: this.chart.id, scales: ["x", null] }, y: false },
      hooks: {
        drawAxes: [(plot) => drawUnder(plot, panel)],
        draw: [(plot) => drawMarks(plot, panel)],
        setScale: [(plot, scale) => { if (scale === "x") this.follow(plot); }],
        setCursor: [(plot) => {
          const i = plot.cursor.idx;
          for (const entry of key) {
            const value = i === null || i === undefined ? null : entry.series.y[i];
            entry.value.textContent = value === null ? "" : ` ${numberText(value)}`;
          }
        }],
      },
    };
    return new uPlot(options, [panel.x, ...panel.series.map((series) => series.y)], holder);
  }

  width() {
    return Math.max(260, this.paper ? kPaper : this.holder.clientWidth);
  }
  fit() {
    for (const plot of this.plots) {
      if (plot.width !== this.width()) plot.setSize({ width: this.width(), height: plot.height });
    }
  }
  /** All panels have the x axis of the one that was zoomed, and the height of what is shown. */
  follow(plot) {
    const { min, max } = plot.scales.x;
    if (this.following || this.plots === undefined) return;
    this.following = true;
    this.plots.forEach((other, place) => {
      if (other !== plot) other.setScale("x", { min, max });
      const [low, high] = extent(this.panels[place], min, max);
      other.setScale("y", { min: low, max: high });
    });
    this.following = false;
    this.zoomed?.(this.isZoomed());
  }
  isZoomed() {
    const { min, max } = this.plots[0].scales.x;
    const length = this.whole[1] - this.whole[0];
    return max - min < 0.999 * length;
  }
  show(min, max) {
    const [first, last] = this.whole;
    const length = Math.min(max - min, last - first);
    if (length < 1e-6 * (last - first)) return;
    const from = Math.min(Math.max(min, first), last - length);
    this.plots[0].setScale("x", { min: from, max: from + length });
  }
  /** @param scale of the shown range; @param shift in its lengths */
  move(scale, shift) {
    const { min, max } = this.plots[0].scales.x;
    const middle = (min + max) / 2 + shift * (max - min), half = (scale * (max - min)) / 2;
    this.show(middle - half, middle + half);
  }
  reset() {
    this.show(...this.whole);
  }
  redraw() {
    this.fit();
    for (const plot of this.plots) plot.redraw(false, true);
  }
  destroy() {
    this.watch.disconnect();
    charts.delete(this);
    for (const plot of this.plots) plot.destroy();
    this.holder.replaceChildren();
  }
}

const kKeys = {
  "+": [0.5, 0], "=": [0.5, 0], "-": [2, 0], ArrowLeft: [1, -0.2], ArrowRight: [1, 0.2],
  ArrowUp: [0.7, 0], ArrowDown: [1 / 0.7, 0],
};

function summary(panels) {
  return panels.map((panel) => {
    const names = panel.series.filter((series) => series.name !== "").map((series) => {
      const values = series.y.filter((value) => value !== null);
      return values.length === 0 ? series.name :
        `${series.name} from ${numberText(Math.min(...values))} to ${numberText(Math.max(...values))}`;
    });
    return `${panel.y_label} over ${panel.x_label}: ${names.join("; ")}`;
  }).join(". ");
}

/** Charts that show the views of another one get them; panels of one x have it all. */
export function completed(report) {
  const charts = report.sections.flatMap((section) => section.parts.flatMap((part) =>
    part.blocks.filter((block) => block.type === "chart")));
  const views = new Map(charts.map((chart) => [chart.id, chart.views]));
  for (const chart of charts) {
    if (chart.views.length === 0) chart.views = views.get(chart.same_as);
    for (const view of chart.views) {
      for (const panel of view.panels) panel.x ??= view.panels[0].x;
    }
  }
  return report;
}

export function chartBlock(chart) {
  const holder = element("div", { class: "plots", tabindex: "0", role: "group" });
  const numbers = element("div");
  let shown = null;
  const button = (text, label, act) => {
    const own = element("button", { type: "button", "aria-label": `${label}: ${chart.title}`, title: label, text });
    own.addEventListener("click", act);
    return own;
  };
  const reset = button("reset", "show all", () => shown.reset());
  const tools = element("div", { class: "tools" },
    button("+", "zoom in", () => shown.move(0.5, 0)), button("\u2212", "zoom out", () => shown.move(2, 0)), reset);
  const open = (place) => {
    shown?.destroy();
    const { panels } = chart.views[place];
    holder.setAttribute("aria-label", `${chart.title}. ${summary(panels)}. Keys: + and \u2212 zoom, arrows move, 0 shows all.`);
    shown = new Chart(chart, panels, holder);
    shown.zoomed = (zoomed) => { reset.disabled = !zoomed; };
    reset.disabled = true;
    numbers.replaceChildren(numbersOf(panels));
  };
  holder.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (kKeys[event.key]) shown.move(...kKeys[event.key]);
    else if (event.key === "0" || event.key === "Escape" || event.key === "Home") shown.reset();
    else return;
    event.preventDefault();
  });
  holder.addEventListener("dblclick", () => shown.reset());
  let choice = null;
  if (chart.views.length > 1) {
    const select = element("select", {},
      chart.views.map((view, i) => element("option", { value: i, text: view.panels[0].clouds.length > 0 ?
        view.panels[0].x_label : view.name })));
    select.addEventListener("change", () => open(Number(select.value)));
    choice = element("label", { class: "choice" },
      chart.views[0].panels[0].clouds.length > 0 ? "over " : `${chart.choice} `, select);
  }
  const figure = element("figure", { class: "chart", id: chart.id },
    element("figcaption", { text: chart.title }), element("div", { class: "bar" }, choice, tools), holder,
    chart.caption ? element("p", { class: "note", text: chart.caption }) : null, numbers);
  // a chart needs a width, which it has once it is in the page
  waiting.set(figure, () => open(0));
  return figure;
}

function begin(figure) {
  const start = waiting.get(figure);
  waiting.delete(figure);
  start?.();
}

/** Draws what can be seen at once, and the rest one by one while nothing else is to be done, or on paper. */
export function drawCharts(done) {
  const soon = 1.5 * innerHeight;
  for (const figure of [...waiting.keys()]) {
    const { top, bottom } = figure.getBoundingClientRect();
    if (top < soon && bottom > -soon) begin(figure);
  }
  const seen = new IntersectionObserver((entries) => {
    for (const entry of entries) {
      if (!entry.isIntersecting) continue;
      begin(entry.target);
      seen.unobserve(entry.target);
    }
  }, { rootMargin: "400px" });
  for (const figure of waiting.keys()) seen.observe(figure);
  const idle = window.requestIdleCallback ?? ((act) => setTimeout(act, 30));
  const next = () => {
    const [figure] = waiting.keys();
    if (figure === undefined) {
      done();
      return;
    }
    begin(figure);
    idle(next);
  };
  idle(next);
  addEventListener("beforeprint", () => [...waiting.keys()].forEach(begin));
}

/** Charts are painted again where their colours or their width change: dark, light, paper. */
export function watchMedia() {
  const again = () => charts.forEach((chart) => chart.redraw());
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", again);
  const paper = (on) => {
    charts.forEach((chart) => { chart.paper = on; });
    again();
  };
  matchMedia("print").addEventListener("change", (event) => paper(event.matches));
  addEventListener("beforeprint", () => paper(true));
  addEventListener("afterprint", () => paper(false));
}
