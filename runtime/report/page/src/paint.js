// SPDX-License-Identifier: MIT
// What a chart paints besides the curves of the library: spans, bands, single samples, marks; and its key.
import { colour, element, svg } from "./dom.js";

/** Extremes of what lies between two x: of curves and bands all of it, of clouds all but some. */
export function extent(panel, from, to) {
  let low = Infinity, high = -Infinity;
  const look = (value) => {
    if (value === null || value === undefined) return;
    if (value < low) low = value;
    if (value > high) high = value;
  };
  panel.x.forEach((x, i) => {
    if (x < from || x > to) return;
    for (const series of panel.series) {
      look(series.y[i]);
      if (series.low && series.role !== "floor") {
        look(series.low[i]);
        look(series.high[i]);
      }
    }
  });
  for (const cloud of panel.clouds) {
    const inside = cloud.y.filter((y, i) => y !== null && cloud.x[i] >= from && cloud.x[i] <= to).sort((a, b) => a - b);
    if (inside.length === 0) continue;
    look(inside[Math.floor(0.01 * (inside.length - 1))]);
    look(inside[Math.ceil(0.99 * (inside.length - 1))]);
  }
  if (low > high) return [-1, 1];
  const margin = 0.06 * (high - low || Math.abs(high) || 1);
  return [low - margin, high + margin];
}

export function wholeRange(panels) {
  let low = Infinity, high = -Infinity;
  for (const panel of panels) {
    for (const xs of [panel.x, ...panel.clouds.map((cloud) => cloud.x)]) {
      for (const x of xs) {
        if (x < low) low = x;
        if (x > high) high = x;
      }
    }
  }
  const margin = panels.some((panel) => panel.clouds.length > 0) ? 0.02 * (high - low) : 0;
  return [low - margin, high + margin];
}

/** What lies under the curves: shaded spans, bands, single samples. */
export function drawUnder(plot, panel) {
  const { ctx, bbox } = plot;
  const ratio = plot.pxRatio ?? devicePixelRatio;
  const x = (value) => plot.valToPos(value, "x", true);
  const y = (value) => plot.valToPos(value, "y", true);
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  for (const span of panel.spans) {
    ctx.fillStyle = colour("span");
    ctx.fillRect(x(span.from), bbox.top, x(span.to) - x(span.from), bbox.height);
    ctx.strokeStyle = colour("spanline");
    ctx.lineWidth = ratio;
    for (const end of [span.from, span.to]) {
      ctx.beginPath();
      ctx.moveTo(x(end), bbox.top);
      ctx.lineTo(x(end), bbox.top + bbox.height);
      ctx.stroke();
    }
  }
  for (const cloud of panel.clouds) {
    ctx.fillStyle = colour(cloud.role);
    ctx.globalAlpha = 0.28;
    const size = 1.3 * ratio;
    for (let i = 0; i < cloud.x.length; ++i) {
      if (cloud.y[i] === null) continue;
      ctx.fillRect(x(cloud.x[i]) - size, y(cloud.y[i]) - size, 2 * size, 2 * size);
    }
  }
  for (const series of panel.series) {
    if (!series.low) continue;
    ctx.fillStyle = colour(series.role);
    ctx.globalAlpha = series.role === "floor" ? 0.16 : 0.22;
    // a band is filled piece by piece, between gaps
    let piece = [];
    const close = () => {
      if (piece.length > 1) {
        ctx.beginPath();
        piece.forEach((i, k) => ctx[k === 0 ? "moveTo" : "lineTo"](x(panel.x[i]), y(series.low[i])));
        piece.reverse().forEach((i) => ctx.lineTo(x(panel.x[i]), y(series.high[i])));
        ctx.closePath();
        ctx.fill();
      }
      piece = [];
    };
    panel.x.forEach((_, i) => {
      if (series.low[i] !== null && series.high[i] !== null) piece.push(i);
    });
    close();
  }
  ctx.restore();
}

/** Marks of binned values: a form for each role, so that colour is not needed. */
export function drawMarks(plot, panel) {
  const { ctx, bbox } = plot;
  const ratio = plot.pxRatio ?? devicePixelRatio;
  const size = 3.4 * ratio;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left - size, bbox.top - size, bbox.width + 2 * size, bbox.height + 2 * size);
  ctx.clip();
  for (const series of panel.series) {
    if (!series.marks) continue;
    ctx.fillStyle = colour(series.role);
    ctx.strokeStyle = colour("paper");
    ctx.lineWidth = 0.8 * ratio;
    panel.x.forEach((value, i) => {
      if (series.y[i] === null) return;
      const cx = plot.valToPos(value, "x", true), cy = plot.valToPos(series.y[i], "y", true);
      ctx.beginPath();
      if (series.role === "forward" || series.role === "backward") {
        const side = series.role === "forward" ? -1 : 1;
        ctx.moveTo(cx, cy + 1.2 * side * size);
        ctx.lineTo(cx - 1.1 * size, cy - 0.8 * side * size);
        ctx.lineTo(cx + 1.1 * size, cy - 0.8 * side * size);
        ctx.closePath();
      } else {
        ctx.arc(cx, cy, size, 0, 2 * Math.PI);
      }
      ctx.fill();
      ctx.stroke();
    });
  }
  ctx.restore();
}

function swatch(series) {
  const picture = svg("svg", { class: `line ${series.role}`, width: 26, height: 12, "aria-hidden": "true" });
  if (series.low) picture.append(svg("rect", { class: "band", x: 1, y: 1, width: 24, height: 10 }));
  if (series.marks) {
    const form = series.role === "forward" ? "M13 2l4 7h-8z" : series.role === "backward" ? "M13 10l4-7h-8z" :
      "M13 2a4 4 0 1 0 .01 0z";
    picture.append(svg("path", { class: "mark", d: form }));
  } else if (series.y.some((value) => value !== null)) {
    picture.append(svg("path", { class: series.dashed ? "stroke dashed" : "stroke", d: "M1 6h24" }));
  }
  return picture;
}

export function keyOf(panel) {
  return panel.series.filter((series) => series.name !== "").map((series) => {
    const value = element("output", { class: "reading" });
    return { series, value, node: element("li", {}, swatch(series), element("span", { text: series.name }), value) };
  });
}
