// The picture of the points and of the hull in the machine's variables. It computes nothing about the hull.
"use strict";

const hullPicture = (() => {
  const SVG = "http://www.w3.org/2000/svg";

  /**
   * Make a picture that can be turned with the mouse and the arrow keys.
   * @param {SVGSVGElement} svg
   */
  function make(svg) {
    let [turn, tilt] = [0.5, 0.4];
    /** @type {Picture} */
    let shown = { points: [], vertices: 0, faces: [] };
    /** All points of this run by their coordinates. @type {Map<string, number[]>} */
    let all = new Map();
    let old = new Set();

    /** @param {string} name @param {Record<string, any>} attributes */
    function mark(name, attributes) {
      const element = document.createElementNS(SVG, name);
      for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
      svg.append(element);
    }

    /** The position of a point in the picture; the last number grows toward the viewer. */
    function frame() {
      const points = [...all.values()];
      const low = [0, 1, 2].map((k) => Math.min(...points.map((p) => p[k])));
      const high = [0, 1, 2].map((k) => Math.max(...points.map((p) => p[k])));
      const middle = low.map((value, k) => (value + high[k]) / 2);
      const scale = 92 / (Math.max(...points.map((p) => Math.hypot(...p.map((x, k) => x - middle[k])))) || 1);
      // Points with one equal coordinate are seen along its axis.
      const level = [2, 1, 0].find((k) => low[k] === high[k]);
      const [across, up] = level === 2 ? [0, 1] : level === 1 ? [0, 2] : [1, 2];
      return (/** @type {number[]} */ point) => {
        const [x, y, z] = point.map((value, k) => (value - middle[k]) * scale);
        if (level !== undefined) return [[x, y, z][across], -[x, y, z][up], 0];
        const a = x * Math.cos(turn) - y * Math.sin(turn);
        const b = x * Math.sin(turn) + y * Math.cos(turn);
        return [a, -(z * Math.cos(tilt) + b * Math.sin(tilt)), z * Math.sin(tilt) - b * Math.cos(tilt)];
      };
    }

    function draw() {
      svg.replaceChildren();
      if (!all.size) return;
      const place = frame();
      const { points, faces } = shown;
      const isVertex = (/** @type {number} */ n) =>
        Array.isArray(shown.vertices) ? shown.vertices.includes(n) : n < shown.vertices;
      const corners = faces.flat().map((n) => place(points[n]));
      const centre = [0, 1, 2].map((k) => corners.reduce((sum, p) => sum + p[k], 0) / (corners.length || 1));
      const named = faces.map((face) => face.map((n) => points[n].join(" ")).sort().join(";"));
      const flat = faces.map((face) => face.map((n) => place(points[n])));
      // A face is behind if its outward normal points away from the viewer.
      const behind = flat.map((face) => {
        if (face.length < 3) return false;
        const [p, q, r] = face;
        const normal = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
        const [u, v] = [q.map((x, k) => x - p[k]), r.map((x, k) => x - p[k])];
        const cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], normal];
        const out = cross.reduce((sum, x, k) => sum + x * (p[k] - centre[k]), 0);
        return normal * Math.sign(out) < 0;
      });
      for (const hidden of [true, false])
        flat.forEach((face, n) => {
          if (behind[n] !== hidden) return;
          const place2 = face.map((p) => `${p[0].toFixed(1)},${p[1].toFixed(1)}`).join(" ");
          const added = old.size && !old.has(named[n]) ? " is-new" : "";
          const wrong = shown.wrong?.includes(n) ? " is-wrong" : "";
          mark("polygon", { points: place2, class: `m-face${hidden ? " is-behind" : ""}${added}${wrong}` });
        });
      old = new Set(named);
      const held = new Set(points.map(String));
      for (const [name, point] of all) {
        const [x, y] = place(point);
        const n = points.findIndex((other) => String(other) === name);
        const kind = !held.has(name) ? "is-gone" : isVertex(n) ? "is-vertex" : "";
        mark("circle", { cx: x.toFixed(1), cy: y.toFixed(1), r: kind === "is-vertex" ? 3.4 : 2.4, class: `m-point ${kind}` });
        if (shown.missed?.includes(n)) mark("circle", { cx: x.toFixed(1), cy: y.toFixed(1), r: 7, class: "m-mark" });
        if (shown.extra?.includes(n)) mark("path", { d: `M${x - 6} ${y - 6}l12 12m0-12l-12 12`, class: "m-mark" });
      }
    }

    /** Show a picture; the points that the program has deleted stay as rings. @param {Picture} picture */
    function show(picture) {
      if (!picture.points) return;
      shown = picture;
      for (const point of picture.points) all.set(String(point), point);
      draw();
    }

    /** Return whether the program has deleted a point that it had read. */
    const deleted = () => all.size > new Set(shown.points.map(String)).size;

    function clear() {
      all = new Map();
      old = new Set();
      shown = { points: [], vertices: 0, faces: [] };
      svg.replaceChildren();
    }

    svg.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: [-0.2, 0], ArrowRight: [0.2, 0], ArrowUp: [0, 0.15], ArrowDown: [0, -0.15] }[event.key];
      if (!step) return;
      event.preventDefault();
      [turn, tilt] = [turn + step[0], tilt + step[1]];
      draw();
    });
    svg.addEventListener("pointermove", (event) => {
      if (!event.buttons) return;
      [turn, tilt] = [turn + event.movementX / 80, tilt + event.movementY / 80];
      draw();
    });
    return { show, clear, draw, deleted };
  }

  return { make };
})();
