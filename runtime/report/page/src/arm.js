// SPDX-License-Identifier: MIT
// The arm as lines in space, seen from where most of it shows; turned by dragging and by arrow keys.
import { element, svg } from "./dom.js";

const kWidth = 420, kHeight = 300, kMargin = 34, kBadge = 11;

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const scaled = (a, s) => a.map((value) => value * s);
const added = (a, b) => a.map((value, i) => value + b[i]);
const unit = (a) => scaled(a, 1 / (Math.hypot(...a) || 1));

/** Directions on the screen, for an eye at an azimuth and a height. */
function screen(up, azimuth, height) {
  const seed = Math.abs(up[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0];
  const east = unit(cross(seed, up)), north = cross(up, east);
  const right = added(scaled(east, Math.cos(azimuth)), scaled(north, Math.sin(azimuth)));
  const away = cross(up, right);
  return {
    right,
    up: added(scaled(up, Math.cos(height)), scaled(away, Math.sin(height))),
    depth: added(scaled(away, Math.cos(height)), scaled(up, -Math.sin(height))),
  };
}

/** How much of the links is seen from there. */
function shown(joints, view) {
  let length = 0;
  for (const { link } of joints) {
    for (let i = 1; i < link.length; ++i) {
      const step = added(link[i], scaled(link[i - 1], -1));
      length += Math.hypot(dot(step, view.right), dot(step, view.up));
    }
  }
  return length;
}

function bestView(joints, up) {
  let best = { azimuth: 0.6, height: 0.35, length: -1 };
  for (const height of [0.35, 0.05, 1.45]) {
    for (let step = 0; step < 24; ++step) {
      const azimuth = 0.1 + (step * Math.PI) / 12;
      const view = screen(up, azimuth, height);
      const end = joints[joints.length - 1]?.link.at(-1) ?? [0, 0, 0];
      // from a little above, and reaching to the right, as drawings of arms do
      const length = shown(joints, view) * (height === 0.35 ? 1.15 : 1) * (dot(end, view.right) >= 0 ? 1.05 : 1);
      if (length > best.length + 1e-9) best = { azimuth, height, length };
    }
  }
  return best;
}

/** Places of badges, moved apart where joints lie upon each other. */
function badgePlaces(points) {
  const placed = [];
  for (const point of points) {
    let best = point;
    for (let ring = 0, found = false; ring < 8 && !found; ++ring) {
      for (let turn = 0; turn < (ring === 0 ? 1 : 12) && !found; ++turn) {
        const angle = -Math.PI / 4 + (turn * Math.PI) / 6;
        const place = [point[0] + ring * 9 * Math.cos(angle), point[1] + ring * 9 * Math.sin(angle)];
        if (placed.every((other) => Math.hypot(other[0] - place[0], other[1] - place[1]) > 2 * kBadge + 2)) {
          best = place;
          found = true;
        }
      }
    }
    placed.push(best);
  }
  return placed;
}

export function armBlock({ joints, up }) {
  const direction = unit(up);
  const start = bestView(joints, direction);
  let { azimuth, height } = start;
  const marked = joints.filter((joint) => joint.marked).map((joint) => joint.label);
  const label = `Kinematic drawing of the arm, ${joints.filter((joint) => joint.coordinate >= 0).length} joints` +
    (marked.length > 0 ? `; marked: ${marked.join(", ")}` : "; no joint is marked");
  const picture = svg("svg", { class: "arm", viewBox: `0 0 ${kWidth} ${kHeight}`, role: "img",
    "aria-label": label, tabindex: "0" });

  const draw = () => {
    const view = screen(direction, azimuth, height);
    const flat = (p) => [dot(p, view.right), -dot(p, view.up)];
    const all = joints.flatMap((joint) => [joint.at, ...joint.link].map(flat));
    all.push([0, 0]);
    const low = [0, 1].map((i) => Math.min(...all.map((p) => p[i])));
    const high = [0, 1].map((i) => Math.max(...all.map((p) => p[i])));
    const size = Math.min((kWidth - 2 * kMargin) / Math.max(high[0] - low[0], 1e-9),
      (kHeight - 2 * kMargin) / Math.max(high[1] - low[1], 1e-9));
    const place = (p) => {
      const q = flat(p);
      return [kWidth / 2 + size * (q[0] - (low[0] + high[0]) / 2), kHeight / 2 + size * (q[1] - (low[1] + high[1]) / 2)];
    };
    const line = (points, name) => svg("polyline", { class: name,
      points: points.map((p) => p.map((value) => value.toFixed(1)).join(",")).join(" ") });
    const parts = [];
    const base = place([0, 0, 0]);
    parts.push(svg("path", { class: "ground",
      d: `M${base[0] - 22} ${base[1] + 6}h44m-40 0l-7 8m17-8l-7 8m17-8l-7 8m17-8l-7 8m17-8l-7 8` }));
    for (const joint of joints) parts.push(line(joint.link.map(place), "link"));
    const moving = joints.filter((joint) => joint.coordinate >= 0);
    const points = moving.map((joint) => place(joint.at));
    moving.forEach((joint, i) => {
      const along = [dot(joint.axis, view.right), -dot(joint.axis, view.up)];
      parts.push(line([[points[i][0] - 24 * along[0], points[i][1] - 24 * along[1]],
        [points[i][0] + 24 * along[0], points[i][1] + 24 * along[1]]], "axis"));
    });
    const badges = badgePlaces(points);
    moving.forEach((joint, i) => {
      const [x, y] = badges[i];
      if (Math.hypot(x - points[i][0], y - points[i][1]) > 1) parts.push(line([points[i], badges[i]], "leader"));
      const shape = joint.prismatic ?
        svg("rect", { x: x - kBadge, y: y - kBadge, width: 2 * kBadge, height: 2 * kBadge, rx: 3 }) :
        svg("circle", { cx: x, cy: y, r: kBadge });
      parts.push(svg("g", { class: joint.marked ? "joint marked" : "joint" },
        joint.marked ? svg("circle", { class: "halo", cx: x, cy: y, r: kBadge + 5 }) : null, shape,
        svg("text", { x, y: y + 4, text: String(joint.coordinate + 1) }),
        svg("title", { text: joint.label })));
    });
    picture.replaceChildren(...parts);
  };

  let from = null;
  picture.addEventListener("pointerdown", (event) => {
    from = [event.clientX, event.clientY];
    picture.setPointerCapture(event.pointerId);
  });
  picture.addEventListener("pointerup", () => { from = null; });
  picture.addEventListener("pointermove", (event) => {
    if (from === null) return;
    turn((event.clientX - from[0]) / 120, (event.clientY - from[1]) / 160);
    from = [event.clientX, event.clientY];
  });
  const turn = (sideways, upwards) => {
    azimuth -= sideways;
    height = Math.min(1.55, Math.max(-0.5, height + upwards));
    draw();
  };
  picture.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: [0.12, 0], ArrowRight: [-0.12, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] }[event.key];
    if (step) turn(...step);
    else if (event.key === "0" || event.key === "Escape") {
      ({ azimuth, height } = start);
      draw();
    } else return;
    event.preventDefault();
  });
  draw();
  return element("figure", { class: "armfigure" }, picture, element("figcaption", { class: "note" },
    marked.length > 0 ? "Joints with findings are filled. " : null,
    element("span", { class: "gesture", text: "Drag to turn." })));
}
