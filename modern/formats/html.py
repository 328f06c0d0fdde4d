"""Write a hull as HTML: a self-contained page on which the reader can rotate it.

The page responds to dragging, the arrow keys, the mouse wheel, +, - and 0.  Without JavaScript it shows a notice and a
table of the exact vertices.
"""

import json
from html import escape
from string import Template

from modern.geometry.mesh import ExportError, Mesh


def write(mesh: Mesh, digits: int | None = None) -> str:
    """Return the page as HTML.  Coordinates without a finite decimal expansion are rounded to ``digits`` digits."""
    try:
        points = [[float(number) for number in point] for point in mesh.numbers()]
    except OverflowError:
        raise ExportError("a coordinate is too large for a picture in binary floats") from None
    # The picture shows the hull centred at the origin and scaled to a largest extent of 1.
    low, high = ([bound(column) for column in zip(*points, strict=True)] for bound in (min, max))
    size = max((b - a for a, b in zip(low, high, strict=True)), default=0.0) or 1.0
    middle = [a / 2 + b / 2 for a, b in zip(low, high, strict=True)]
    scaled = [[round((x - m) / size, 9) for x, m in zip(point, middle, strict=True)] for point in points]
    rows = "".join(
        f"<tr><td>{number}</td>" + "".join(f"<td>{escape(text)}</td>" for text in line.split()) + "</tr>"
        for number, line in enumerate(mesh.decimals(digits), 1)
    )
    faces, edges = [list(face) for face in mesh.faces], [list(edge) for edge in mesh.edges()]
    return _PAGE.substitute(
        title=f"Convex hull: {len(points)} vertices, {len(edges)} edges, {len(faces)} faces",
        rows=rows,
        data=json.dumps(
            {"points": scaled, "faces": faces, "edges": edges, "solid": mesh.dimension == 3}, separators=(",", ":")
        ),
    )


_PAGE = Template("""\
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>$title</title>
<style>
:root { color-scheme: light dark; --ink: #000; --paper: #fff; --face: #d9dde3; --far: #767676; }
@media (prefers-color-scheme: dark) { :root { --ink: #f2f2f2; --paper: #16181c; --face: #3a4150; --far: #9a9a9a; } }
body { margin: 1rem auto; max-width: 60rem; padding: 0 1rem; font: 16px/1.4 system-ui, sans-serif;
  color: var(--ink); background: var(--paper); }
h1 { font-size: 1.2rem; }
svg { width: 100%; height: 70vh; touch-action: none; cursor: grab; }
svg:focus-visible { outline: 3px solid #4a90d9; }
.face { fill: var(--face); fill-opacity: .75; stroke: none; }
.edge { stroke: var(--ink); stroke-width: 1.5; stroke-linecap: round; vector-effect: non-scaling-stroke; }
.far { stroke: var(--far); stroke-width: 1; stroke-dasharray: 4 4; vector-effect: non-scaling-stroke; }
text { fill: var(--ink); font-size: .035px; text-anchor: middle; pointer-events: none; }
td, th { text-align: right; padding: 0 .8em 0 0; font-variant-numeric: tabular-nums; }
</style>
</head>
<body>
<h1>$title</h1>
<p id="help">Drag or use the arrow keys to turn the hull. Press + or - to change its size, 0 to reset the view.
<label><input type="checkbox" id="numbers" checked> numbers</label></p>
<noscript><p>The picture needs JavaScript. The vertices are listed below.</p></noscript>
<svg id="view" viewBox="-1 -1 2 2" tabindex="0" role="img" aria-label="$title" aria-describedby="help"></svg>
<details><summary>Vertices</summary>
<table><thead><tr><th>no.</th><th>x</th><th>y</th><th>z</th></tr></thead><tbody>$rows</tbody></table>
</details>
<script type="application/json" id="hull">$data</script>
<script>
"use strict";
const hull = JSON.parse(document.getElementById("hull").textContent);
const view = document.getElementById("view"), numbers = document.getElementById("numbers");
const NS = "http://www.w3.org/2000/svg";
let turn, tilt, size;
function reset() { turn = 0.6; tilt = 0.35; size = 1; }
function project(p) {
  const c = Math.cos(turn), s = Math.sin(turn), u = Math.cos(tilt), v = Math.sin(tilt);
  const x = c * p[0] + s * p[1], y = c * p[1] - s * p[0];
  return [1.1 * size * x, -1.1 * size * (u * p[2] + v * y), u * y - v * p[2]];
}
function add(name, attributes, text) {
  const element = document.createElementNS(NS, name);
  for (const key in attributes) element.setAttribute(key, attributes[key]);
  if (text) element.textContent = text;
  view.append(element);
}
function draw() {
  const at = hull.points.map(project), near = new Set();
  const facing = hull.faces.map(face => {
    let area = 0;
    face.forEach((k, i) => {
      const l = face[(i + 1) % face.length];
      area += at[k][0] * at[l][1] - at[l][0] * at[k][1];
    });
    return !hull.solid || area < 0;
  });
  view.replaceChildren();
  hull.faces.forEach((face, order) => {
    if (facing[order]) face.forEach((k, i) => {
      const l = face[(i + 1) % face.length];
      near.add(Math.min(k, l) + " " + Math.max(k, l));
    });
  });
  const line = (edge, kind) => add("line", { class: kind, x1: at[edge[0]][0], y1: at[edge[0]][1],
    x2: at[edge[1]][0], y2: at[edge[1]][1] });
  const isNear = edge => !hull.solid || near.has(edge[0] + " " + edge[1]);
  hull.edges.filter(edge => !isNear(edge)).forEach(edge => line(edge, "far"));
  hull.faces.forEach((face, order) => {
    if (facing[order]) add("polygon", { class: "face", points: face.map(k => at[k][0] + "," + at[k][1]).join(" ") });
  });
  hull.edges.filter(isNear).forEach(edge => line(edge, "edge"));
  if (hull.points.length === 1) add("circle", { r: 0.02, fill: "currentColor" });
  if (numbers.checked && at.length <= 200) at.forEach((p, k) =>
    add("text", { x: 1.06 * p[0], y: 1.06 * p[1] + 0.012 }, String(k + 1)));
}
let dragFrom = null;
view.addEventListener("pointerdown", event => {
  dragFrom = [event.clientX, event.clientY];
  view.setPointerCapture(event.pointerId);
});
view.addEventListener("pointermove", event => {
  if (!dragFrom) return;
  turn += (event.clientX - dragFrom[0]) / 150;
  tilt = Math.max(-1.57, Math.min(1.57, tilt + (event.clientY - dragFrom[1]) / 150));
  dragFrom = [event.clientX, event.clientY];
  draw();
});
view.addEventListener("pointerup", () => { dragFrom = null; });
view.addEventListener("wheel", event => { event.preventDefault(); size *= Math.exp(-event.deltaY / 600); draw(); },
  { passive: false });
view.addEventListener("keydown", event => {
  const step = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] }[event.key];
  if (step) { turn += step[0]; tilt = Math.max(-1.57, Math.min(1.57, tilt + step[1])); }
  else if (event.key === "+") size *= 1.15;
  else if (event.key === "-") size /= 1.15;
  else if (event.key === "0") reset();
  else return;
  event.preventDefault();
  draw();
});
numbers.addEventListener("change", draw);
reset();
draw();
</script>
</body>
</html>
""")
