// Compare the programs of 1963 with exact arithmetic: enter or drag points, draw both hulls (modern/publication/parting.py).
"use strict";
(() => {
  /** @typedef {{vertices: number[], faces: number[][]}} Hull */
  /** The answer of modern/publication/parting.py. @typedef {{refused?: string, points: string[][], true: Hull & {text: string}, found: Hull, says: string[], reason: string[], part: string}} Answer */

  /** @param {string} id @returns {any} */
  const at = (id) => document.getElementById(`parting-${id}`);
  const { bytes } = hull1620;
  const sets = JSON.parse(at("sets-data").textContent);
  /** @type {SVGSVGElement} */
  const picture = at("picture");
  const SVG = "http://www.w3.org/2000/svg";
  const LATEST = 60000; // the largest time for a set in milliseconds
  /** @type {Answer | null} */
  let answer = JSON.parse(at("first").textContent);
  /** @type {Machine | null} */
  let machine = null;
  let busy = false;
  let turn = 0.5;
  let tilt = 0.35;
  let held = -1;

  const OWN = "your own points";
  for (const name of Object.keys(sets)) at("sets").add(new Option(name, name));
  const first = at("sets").value;
  let own = ""; // the points that the visitor has typed or dragged last

  /** Let the menu name the set that the points are; other points are the visitor's own. */
  function name() {
    const text = at("points").value;
    const known = Object.keys(sets).find((title) => sets[title].trim() === text.trim());
    if (known === undefined) {
      own = text;
      if (![...at("sets").options].some(({ value }) => value === OWN)) at("sets").add(new Option(OWN, OWN));
    }
    at("sets").value = known ?? OWN;
  }

  at("sets").addEventListener("change", () => {
    at("points").value = sets[at("sets").value] ?? own;
    at("answer").replaceChildren();
    answer = null;
    draw();
    if (machine) go();
  });

  /** @returns {number[][]} */
  const typed = () =>
    at("points").value.split("\n").map((/** @type {string} */ line) => line.trim().split(/[\s,;]+/).map(Number))
      .filter((/** @type {number[]} */ point) => point.length === 3 && point.every(Number.isFinite));
  const level = (/** @type {number[][]} */ points) => new Set(points.map((point) => point[2])).size < 2;

  // The position of a point in the picture: a plane is seen from above, a solid from the chosen direction.
  /** @param {number[][]} points */
  function frame(points) {
    const flat = level(points);
    const size = Math.max(1, ...points.flat().map(Math.abs));
    const [cosine, sine] = [Math.cos(turn), Math.sin(turn)];
    const [up, over] = [Math.cos(tilt), Math.sin(tilt)];
    const middle = [0, 1, 2].map((k) => points.reduce((sum, point) => sum + point[k], 0) / Math.max(points.length, 1));
    const reach = flat ? size : Math.max(1, ...points.map((p) => Math.hypot(...p.map((x, k) => x - middle[k]))));
    const scale = 100 / reach;
    const place = (/** @type {number[]} */ [x, y, z]) => {
      if (flat) return [x * scale, -y * scale];
      [x, y, z] = [x - middle[0], y - middle[1], z - middle[2]];
      const [a, b] = [x * cosine - y * sine, x * sine + y * cosine];
      return [a * scale, -(z * up + b * over) * scale];
    };
    return { flat, scale, place };
  }

  /** @param {string} name @param {Record<string, any>} attributes @param {string} [text] */
  function mark(name, attributes, text) {
    const one = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) one.setAttribute(key, value);
    if (text) one.textContent = text;
    picture.append(one);
    return one;
  }

  /** The distance of a point from the line between two others. @param {number[]} point @param {number[][]} line */
  function away([x, y], [[a, b], [c, d]]) {
    const [u, v] = [c - a, d - b];
    const share = Math.max(0, Math.min(1, ((x - a) * u + (y - b) * v) / (u * u + v * v || 1)));
    return Math.hypot(x - a - share * u, y - b - share * v);
  }

  /**
   * Place the number of each point next to its dot: outward from the centre of the picture, unless dots, lines or other
   * numbers are there.
   * @param {[number, number, number][]} dots The place and the size of each dot.
   * @param {number[][][]} edges
   */
  function labels(dots, edges) {
    const middle = [0, 1].map((k) => dots.reduce((sum, dot) => sum + dot[k], 0) / (dots.length || 1));
    /** @type {[number, number, number][]} */
    const placed = [];
    dots.forEach(([x, y, size], n) => {
      const half = n < 9 ? 3 : 4.5; // half of the size of a number
      const outward = Math.atan2(y - middle[1], x - middle[0]);
      const overlap = (/** @type {number[]} */ at) => {
        let sum = 0;
        for (const [a, b, other] of [...dots, ...placed]) sum += 3 * Math.max(0, half + other - Math.hypot(at[0] - a, at[1] - b));
        for (const edge of edges) sum += Math.max(0, half + 0.5 - away(at, edge));
        return sum + 9 * Math.max(0, Math.abs(at[0]) + half - 110, Math.abs(at[1]) + half - 110);
      };
      /** @type {[number, number, number]} */
      let best = [x, y, half];
      let least = Infinity;
      for (const far of [0.5, 4])
        for (let step = 0; step < 24; step += 1) {
          const turned = (step % 2 ? 1 : -1) * Math.ceil(step / 2) * (Math.PI / 12);
          const reach = size + half + far;
          const spot = [x + reach * Math.cos(outward + turned), y + reach * Math.sin(outward + turned)];
          const cost = overlap(spot) + Math.abs(turned) / 4 + far / 4;
          if (cost < least) [best, least] = [[spot[0], spot[1], half], cost];
        }
      placed.push(best);
    });
    return placed;
  }

  function draw() {
    const points = typed();
    const { place } = frame(points);
    const at2 = points.map(place);
    picture.replaceChildren();
    mark("title", {}, "The points, the true hull and the hull of the programs of 1963");
    const same = answer?.points?.length === points.length ? answer : null;
    // Each edge is drawn once: the dashes of two faces would fill each other's gaps.
    /** @param {number[][]} faces @returns {number[][]} */
    const edgesOf = (faces) => {
      const pairs = faces.flatMap((face) => face.map((n, k) => [n, face[(k + 1) % face.length]].sort((a, b) => a - b)));
      return [...new Map(pairs.map((pair) => [pair.join(), pair])).values()];
    };
    const ends = (/** @type {number[][]} */ edges) => edges.map(([a, b]) => [at2[a], at2[b]]);
    const [trueEdges, foundEdges] = same ? [same.true, same.found].map((hull) => ends(edgesOf(hull.faces))) : [[], []];
    for (const [edges, kind] of /** @type {[number[][][], string][]} */ ([[trueEdges, "true"], [foundEdges, "found"]]))
      for (const [[x1, y1], [x2, y2]] of edges) mark("line", { x1, y1, x2, y2, class: `parting-${kind}` });
    /** @type {[number, number, number][]} The place and the size of each dot with its ring or cross. */
    const dots = [];
    at2.forEach(([x, y], n) => {
      const dot = mark("circle", { cx: x, cy: y, r: 2.6, class: "parting-point", "data-n": n });
      dot.append(Object.assign(document.createElementNS(SVG, "title"), { textContent: `point ${n + 1}: ${points[n]}` }));
      if (!same) return;
      const is = same.true.vertices.includes(n);
      const said = same.found.vertices.includes(n);
      const isMissed = is && !said && same.found.vertices.length > 0;
      const isExtra = said && !is;
      if (isMissed) mark("circle", { cx: x, cy: y, r: 6, class: "parting-missed" });
      if (isExtra) mark("path", { d: `M${x - 5} ${y - 5}l10 10m0-10l-10 10`, class: "parting-extra" });
      dots.push([x, y, isMissed || isExtra ? 7 : 3]);
    });
    if (!same) return;
    for (const [n, [x, y]] of labels(dots, [...trueEdges, ...foundEdges]).entries()) mark("text", { x, y }, String(n + 1));
  }

  /** A paragraph in which the file of the faults is a link to their page. @param {string} text */
  function linked(text) {
    const paragraph = document.createElement("p");
    const [before, after] = text.split("fortran_src/KNOWN-FAULTS.md");
    paragraph.append(before);
    if (after !== undefined) {
      const fault = /fault (\d+) in $/.exec(before);
      const href = `known-faults.html${fault ? `#fault-${fault[1]}` : ""}`;
      paragraph.append(Object.assign(document.createElement("a"), { href, textContent: "Faults of the originals" }), after);
    }
    return paragraph;
  }

  function tell() {
    if (!answer) return;
    const box = at("answer");
    box.replaceChildren();
    const lines = (/** @type {string} */ title, /** @type {string[]} */ texts) => {
      if (!texts.length) return;
      box.append(Object.assign(document.createElement("h2"), { textContent: title }));
      for (const text of texts) box.append(linked(text));
    };
    if (answer.refused) return lines("Not run", [answer.refused]);
    lines("The programs of 1963", answer.says);
    lines("Why there is no hull", answer.reason);
    lines("The true hull", [answer.true.text]);
    lines("Eight digits and exact arithmetic", [answer.part, "Both arithmetics begin with these points; exact arithmetic also keeps all digits on the cards between the programs."]);
  }

  async function connect() {
    try {
      machine = await hull1620.connect((loaded) => (at("progress").value = loaded), () => {});
    } catch (error) {
      at("begin").hidden = at("begin").disabled = false;
      at("says").textContent = `Loading failed: ${/** @type {Error} */ (error).message}`;
      return;
    } finally {
      at("progress").hidden = true;
    }
    /** @type {HTMLElement} */ (document.getElementById("parting")).dataset.state = "on";
    at("begin").hidden = true;
    go();
  }

  async function go() {
    if (busy || !machine) return;
    busy = true;
    at("go").disabled = true;
    at("says").textContent = "The programs are running …";
    const late = setTimeout(() => {
      machine?.stop();
      machine = null;
      busy = false;
      at("says").textContent = "The run was stopped after a minute.";
      at("begin").hidden = at("begin").disabled = false;
    }, LATEST);
    const text = at("points").value;
    const result = await machine.ask("part", text);
    clearTimeout(late);
    busy = false;
    at("go").disabled = false;
    at("says").textContent = "";
    if (text !== at("points").value) return go(); // the points have changed in the meantime
    answer = result;
    tell();
    draw();
  }

  at("begin").addEventListener("click", () => {
    at("begin").disabled = true;
    at("progress").hidden = false;
    at("says").textContent = "Loading …";
    connect();
  });
  at("form").addEventListener("submit", (/** @type {Event} */ event) => {
    event.preventDefault();
    go();
  });
  at("points").addEventListener("input", () => {
    answer = null;
    name();
    draw();
  });
  for (const button of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("#parting [data-turn], #parting [data-tilt]")))
    button.addEventListener("click", () => {
      turn += 0.3 * Number(button.dataset.turn ?? 0);
      tilt += 0.2 * Number(button.dataset.tilt ?? 0);
      draw();
    });

  /** @param {PointerEvent} event */
  function pointer(event) {
    const spot = new DOMPoint(event.clientX, event.clientY).matrixTransform(picture.getScreenCTM()?.inverse());
    return [spot.x, spot.y];
  }
  /** @type {number[] | null} */
  let last = null;
  picture.addEventListener("pointerdown", (event) => {
    held = Number(/** @type {SVGElement} */ (event.target).dataset?.n ?? -1);
    last = pointer(event);
    picture.setPointerCapture(event.pointerId);
  });
  picture.addEventListener("pointermove", (event) => {
    if (last === null) return;
    const [x, y] = pointer(event);
    const points = typed();
    const { flat, scale } = frame(points);
    if (flat && held >= 0) {
      points[held] = [Math.round(x / scale), Math.round(-y / scale), points[held][2]];
      at("points").value = points.map((point) => point.join(" ")).join("\n");
      answer = null;
      name();
    } else if (!flat) {
      turn += (x - last[0]) / 60;
      tilt += (y - last[1]) / 60;
    }
    last = [x, y];
    draw();
  });
  picture.addEventListener("pointerup", () => {
    const moved = held >= 0 && answer === null;
    last = null;
    held = -1;
    if (moved) go();
  });

  // A browser may restore the points that were typed before a reload.
  name();
  if (at("sets").value !== first) answer = null;
  draw();
  if (answer) tell();
  if (!bytes) at("says").textContent = "This site was built without the emulator. The answer shown is that of the first set.";
  else {
    at("says").textContent = `The page loads Python and this project (${(bytes / 1e6).toFixed(1)} MB). Nothing leaves your computer.`;
    at("progress").max = bytes;
    at("begin").hidden = false;
  }
})();
