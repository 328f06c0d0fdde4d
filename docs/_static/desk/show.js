// What the desk shows of a run: the answers of modern/publication/desk.py, from the worker or from a recorded run.
"use strict";

const deskShow = (() => {
  const { at, all, data, say, paper } = deskPage;
  const listing = at("listing", HTMLElement);
  const about = at("about", HTMLElement);
  const caption = at("caption", HTMLElement);
  const line = at("line", HTMLInputElement);
  const range = at("stage", HTMLInputElement);
  const picture = hullPicture.make(at("picture", SVGSVGElement));
  const truth = hullPicture.make(at("true", SVGSVGElement));
  const core = coreMap.make(at("core", HTMLCanvasElement));
  /** The answer of the last load. @type {Load | null} */
  let loaded = null;
  /** @type {string[]} */
  let typed = [];
  /** @type {string[]} */
  let punched = [];
  /** The fields that ACCEPT waits for. @type {Field[]} */
  let fields = [];
  /** @type {Picture[]} */
  let stages = [];
  /** The comparison with exact arithmetic, if the visitor has asked for it. @type {Verdict | null} */
  let verdict = null;
  let statement = 0;
  let card = 0;

  /** Highlight a card of the program and show the commentary on its block. @param {number} number */
  function light(number) {
    if (card === number || !listing.children.length) return;
    listing.children[card - 1]?.removeAttribute("aria-current");
    card = number;
    const lit = listing.children[number - 1];
    if (!(lit instanceof HTMLElement)) return;
    lit.setAttribute("aria-current", "step");
    if (lit.offsetTop < listing.scrollTop + 20 || lit.offsetTop > listing.scrollTop + listing.clientHeight - 50) deskPage.centre(listing, lit);
    at("card", HTMLElement).textContent = `card ${number}`;
    const blocks = data.commentary[loaded?.program.replace(/\.f$/, "") ?? ""] ?? [];
    const [title, , , text] = blocks.find(([, first, last]) => first <= number && number <= last) ?? ["", 0, 0, ""];
    if (about.dataset.title === title) return;
    about.dataset.title = title;
    about.replaceChildren();
    if (title) {
      const head = Object.assign(document.createElement("h3"), { textContent: title });
      about.append(head, Object.assign(document.createElement("p"), { textContent: text }));
    }
  }

  /** Show the ruler of the line that ACCEPT waits for, with the columns that Enter will type. */
  function rule() {
    const ruler = at("ruler", HTMLElement);
    ruler.hidden = !fields.length;
    if (!fields.length) return;
    const text = keypunch.aligned(line.value.toUpperCase(), fields);
    const width = Math.max(20, ...fields.map(([, first, size]) => first + size - 1), text.length);
    const names = fields.map(([code, first, size]) => `${code} in ${size > 1 ? `columns ${first} to ${first + size - 1}` : `column ${first}`}`);
    ruler.textContent = `FORMAT expects ${names.join(", ")}\n${keypunch.ruler(fields, width)}\n${text || " "}`;
  }

  /** Empty the desk for a new load. @param {Load | null} load */
  function lay(load) {
    loaded = load;
    verdict = null;
    [typed, punched, card, stages, fields] = [[], [], 0, [], []];
    for (const id of ["listing", "hopper", "stacker", "paper", "about", "variables"]) at(id, HTMLElement).replaceChildren();
    delete about.dataset.title;
    listing.append(...(load?.listing ?? []).map(([, text]) => deskPage.row(text)));
    at("hopper", HTMLElement).append(...(load?.deck ?? []).map(deskPage.row));
    for (const id of ["read-card", "punch-card"]) punchedCards.draw(at(id, HTMLCanvasElement), "");
    at("punched", HTMLElement).textContent = "0 cards";
    at("next", HTMLElement).hidden = true;
    at("true", SVGSVGElement).toggleAttribute("hidden", true); // an SVG element has no property of this name
    range.disabled = true;
    at("card", HTMLElement).textContent = "";
    caption.textContent = "Points appear when a program reads them.";
    picture.clear();
    truth.clear();
    deskPage.read(0);
    count(0);
    if (!load) return;
    core.load(load.core);
    paper([`${load.program} in core storage, ${deskPage.counted(load.deck.length)} in the hopper`], "note");
  }

  /** Show the number of the present statement in the run. @param {number} number */
  function count(number) {
    statement = number;
    at("statements", HTMLElement).textContent = `of ${statement}`;
    const jump = at("statement", HTMLInputElement);
    if (document.activeElement !== jump) jump.value = String(statement || 1);
  }

  /** Show one slice of a run. @param {Frame} frame */
  function render(frame) {
    const texts = (/** @type {string} */ kind) => frame.events.filter(([what]) => what === kind).map(([, text]) => text);
    const events = { type: texts("type"), read: texts("read"), punch: texts("punch") };
    typed.push(...events.type);
    punched.push(...events.punch);
    paper(events.type, "typed");
    if (events.read.length) deskPage.slide("read-card", events.read.at(-1) ?? "");
    if (events.punch.length) {
      deskPage.slide("punch-card", events.punch.at(-1) ?? "");
      deskPage.stack(events.punch, punched.length);
    }
    deskPage.sound(events);
    light(frame.card);
    if (frame.read !== undefined) deskPage.read(frame.read);
    const { switches } = frame;
    if (switches) deskPage.turn((number) => switches[number - 1]);
    const breaks = new Set(frame.breaks ?? []);
    for (const element of all("#desk-listing .has-break")) element.classList.remove("has-break");
    for (const number of breaks) listing.children[number - 1]?.classList.add("has-break");
    core.touch(frame.wrote ?? [], loaded?.touched?.[frame.card - 1]?.[1] ?? []);
    if (frame.picture?.points?.length) {
      picture.show(frame.picture);
      const { points, vertices, faces } = frame.picture;
      const hull = faces.length ? `Hull ${frame.stages}: ${faces.length} equations through ${vertices} vertices. ` : "";
      const deleted = picture.deleted() ? " Rings are points that the program has deleted." : "";
      caption.textContent = `${hull}${points.length} points in the machine.${deleted}`;
    }
    if (verdict) contrast(frame.ended);
    [at("fac", HTMLElement).textContent, at("fixed", HTMLElement).textContent] = frame.registers ?? ["", ""];
    count(frame.statement ?? 0);
    const lamps = ["power"];
    if (frame.waits) lamps.push("wait");
    else if (!frame.ended) lamps.push("run");
    if (frame.messages?.some((text) => text.startsWith("hull1620:"))) lamps.push("check");
    deskPage.lamps(lamps, Object.entries(events).filter(([, lines]) => lines.length).map(([device]) => device));
  }

  /** Show the load of a refused program: nothing is in the machine. @param {string[]} messages */
  function refuse(messages) {
    lay(null);
    deskPage.enter("refused");
    deskPage.lamps(["power", "check"]);
    say(`Refused: ${messages[0]}. Nothing is loaded. Correct the cards at the Keypunch, or choose others and press Load.`);
    paper(messages, "note");
  }

  /** Remove what came after a statement: only so many typed lines and punched cards remain. @param {{typed: number, punched: number}} undone */
  function undo(undone) {
    typed.length = Math.min(typed.length, undone.typed);
    punched.length = Math.min(punched.length, undone.punched);
    for (const id of ["paper", "stacker"]) at(id, HTMLElement).replaceChildren();
    paper(typed, "typed", false);
    deskPage.stack(punched, punched.length);
    punchedCards.draw(at("punch-card", HTMLCanvasElement), punched.at(-1) ?? "");
    if (loaded) core.load(loaded.core);
    picture.clear();
    if (stages[0]) picture.show(stages[0]);
    at("next", HTMLElement).hidden = true;
  }

  /** Show the columns of the line that ACCEPT waits for, or none. @param {Field[]} expected */
  function expect(expected) {
    fields = expected;
    rule();
  }

  /** Offer the successive hulls of the run to look at. @param {Picture[]} hulls */
  function offerStages(hulls) {
    stages = hulls;
    range.max = String(Math.max(stages.length, 1));
    range.value = range.max;
    range.disabled = stages.length < 2;
  }

  function showStage() {
    const number = Number(range.value);
    picture.show(stages[number - 1]);
    caption.textContent = `Hull ${number} of ${stages.length}: ${stages[number - 1].faces.length} equations.`;
  }

  /** Show the true hull next to the hull of the program, with their differences. @param {boolean} isFinal */
  function contrast(isFinal) {
    const { hull, final } = verdict ?? {};
    if (!hull) return;
    truth.show(hull);
    at("true", SVGSVGElement).toggleAttribute("hidden", false);
    const isPunched = isFinal && final;
    if (isPunched) picture.show(final);
    const legend = [`Left: the hull ${isPunched ? "on the punched cards" : "in the machine"}. Right: the true hull.`];
    if (hull.missed?.length) legend.push("Blue ring: a vertex that the program does not punch.");
    if (hull.extra?.length) legend.push("Blue cross: a point that it wrongly punches as a vertex.");
    if (hull.wrong?.length || final?.wrong?.length) legend.push("Blue: a face that only one of the hulls has.");
    caption.textContent = legend.join(" ");
  }

  /** Keep the comparison with exact arithmetic until the next load, and show its hulls. @param {Verdict} answer @param {boolean} isFinal */
  function compare(answer, isFinal) {
    verdict = answer;
    contrast(isFinal);
  }

  /** Return the line to type, with its numbers in the columns of the FORMAT. */
  const aligned = () => keypunch.aligned(line.value, fields);

  line.addEventListener("input", rule);
  range.addEventListener("input", showStage);
  return {
    core, lay, render, refuse, undo, expect, offerStages, compare, aligned,
    get loaded() { return loaded; },
    get verdict() { return verdict?.says ?? ""; },
    get statement() { return statement; },
    get typed() { return typed; },
    get punched() { return punched; },
  };
})();
