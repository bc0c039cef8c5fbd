// SPDX-License-Identifier: MIT
// A square table as colours, which is read by pointing at it or by walking with the arrow keys.
import { colour, element, numberText } from "./dom.js";

const kFont = "11px system-ui, sans-serif";
const kRow = 13;            // pixels: the least height of a row whose name is written
const kMost = 18;           // pixels: the largest square
const kSteps = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0] };
const matrices = new Set();

class Matrix {
  constructor({ names, hundredths }, canvas, reading) {
    this.names = names;
    this.rows = hundredths;
    this.canvas = canvas;
    this.reading = reading;
    this.at = [0, 0];
    matrices.add(this);
    canvas.addEventListener("pointermove", (event) => {
      const box = canvas.getBoundingClientRect();
      this.show(Math.floor((event.clientY - box.top) / this.size), Math.floor((event.clientX - box.left - this.left) / this.size));
    });
    canvas.addEventListener("keydown", (event) => {
      const step = kSteps[event.key];
      if (step) this.show(this.at[0] + step[0], this.at[1] + step[1]);
      else if (event.key === "Home") this.show(0, 0);
      else return;
      event.preventDefault();
    });
  }
  value(i, j) {
    return i >= j ? this.rows[i][j] : this.rows[j][i];
  }
  show(i, j) {
    const inside = (place) => Math.min(Math.max(place, 0), this.names.length - 1);
    this.at = [inside(i), inside(j)];
    const value = this.value(...this.at);
    this.reading.textContent = `${this.names[this.at[0]]} and ${this.names[this.at[1]]}: ${numberText(value === null ? null : value / 100)}`;
    this.draw();
  }
  /** Squares as large as the page is wide; names of the rows where there is room for them. */
  draw() {
    const count = this.names.length, width = Math.max(260, this.canvas.parentElement.clientWidth);
    const paint = this.canvas.getContext("2d");
    paint.font = kFont;
    const longest = Math.ceil(Math.max(...this.names.map((name) => paint.measureText(name).width))) + 10;
    const named = (width - longest) / count >= kRow;
    this.left = named ? longest : 0;
    this.size = Math.min(kMost, (width - this.left) / count);
    const height = this.size * count, scale = window.devicePixelRatio || 1;
    this.canvas.width = Math.round(width * scale);
    this.canvas.height = Math.round(height * scale);
    this.canvas.style.height = `${height}px`;
    paint.setTransform(scale, 0, 0, scale, 0, 0);
    paint.clearRect(0, 0, width, height);
    paint.fillStyle = colour("after");
    for (let i = 0; i < count; ++i) {
      for (let j = 0; j < count; ++j) {
        const value = this.value(i, j);
        if (!value) continue;
        paint.globalAlpha = value / 100;
        paint.fillRect(this.left + j * this.size, i * this.size, this.size, this.size);
      }
    }
    paint.globalAlpha = 1;
    if (named) {
      paint.font = kFont;
      paint.fillStyle = colour("ink");
      paint.textBaseline = "middle";
      paint.textAlign = "right";
      this.names.forEach((name, i) => paint.fillText(name, this.left - 5, (i + 0.5) * this.size));
    }
    paint.strokeStyle = colour("model");
    paint.lineWidth = 1.5;
    paint.strokeRect(this.left + this.at[1] * this.size, this.at[0] * this.size, this.size, this.size);
  }
}

export function matrixBlock(block) {
  const canvas = element("canvas", { tabindex: "0", role: "img",
    "aria-label": `${block.title}: ${block.names.length} by ${block.names.length}. Arrow keys walk through it; the table below has its largest values.` });
  const reading = element("p", { class: "reading", "aria-live": "polite" });
  new Matrix(block, canvas, reading);
  return element("figure", { class: "matrix", id: block.id }, element("figcaption", { text: block.title }), reading, canvas,
    block.caption ? element("p", { class: "note", text: block.caption }) : null);
}

/** Once the page has its width; and again where the width or the colours change. */
export function drawMatrices() {
  const again = () => matrices.forEach((matrix) => matrix.draw());
  again();
  addEventListener("resize", again);
  addEventListener("beforeprint", again);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", again);
}
