// The desk of the emulator: it shows what modern/publication/desk.py answers, from the worker or from a recorded run.
"use strict";
(() => {
  const at = (/** @type {string} */ id) => /** @type {any} */ (document.getElementById(`desk-${id}`));
  const all = (/** @type {string} */ selector) => /** @type {any[]} */ ([...desk.querySelectorAll(selector)]);
  const desk = /** @type {HTMLElement} */ (document.getElementById("desk"));
  const data = JSON.parse(at("data").textContent);
  const COMPILING = 10000; // the longest time to compile, in milliseconds
  const SHOWN = 2000; // the number of lines and cards that the page shows; saved files are complete
  const STILL = matchMedia("(prefers-reduced-motion: reduce)").matches;
  const FITS = { points: "example5", plane: "example4/punched", space: "example5/punched" };
  const PUNCHED = "PUNCHED";
  const NAMES = { programs: "program", decks: "deck" };

  const picture = hullPicture.make(at("picture"));
  const truth = hullPicture.make(at("true"));
  const core = coreMap.make(at("core"));
  /** The visitor's programs and decks by name. @type {{programs: Map<string, string>, decks: Map<string, string>}} */
  const own = { programs: new Map(), decks: new Map() };
  /** What each program or deck is for: a kind of points, or the stem of a file. @type {Map<string, string>} */
  const kinds = new Map();
  /** @type {Machine | null} */
  let machine = null;
  /** @type {any} */
  let loaded = null; // the answer of the last load
  /** @type {string[]} */
  let typed = [];
  /** @type {string[]} */
  let punched = [];
  let waits = "";
  let running = false;
  let isReplay = false; // a log is being repeated
  let follows = false; // the next program is loaded when program 1 ends
  let wish = ""; // START pressed before the machine is ready
  let frames = 0; // the timer of the recorded run
  let statement = 0;
  let card = 0;
  let looked = 0;
  /** @type {[string, number, number][]} */
  let fields = [];
  /** @type {Picture[]} */
  let stages = [];

  // ---- What the desk shows

  /** @param {string} text */
  function say(text) {
    at("state").textContent = text;
  }

  /** @param {string} text */
  function row(text) {
    return Object.assign(document.createElement("li"), { textContent: text || " " });
  }

  /** Scroll a list so that an element is in its middle. @param {HTMLElement} list @param {HTMLElement | undefined} element */
  function centre(list, element) {
    if (element) list.scrollTop = element.offsetTop - list.clientHeight / 2 + element.offsetHeight / 2;
  }

  /** Add lines to the typewriter's paper. @param {string[]} lines @param {"typed" | "note"} kind */
  function paper(lines, kind) {
    const sheet = at("paper");
    for (const line of lines) {
      const element = Object.assign(document.createElement("span"), { className: `desk-${kind}`, textContent: `${line}\n` });
      const seconds = line.length / 10 / pace();
      if (kind === "typed" && moves() && seconds > 0.08) {
        element.style.animation = `m-type ${seconds}s steps(${Math.max(line.length, 1)})`;
        element.classList.add("is-typing");
      }
      sheet.append(element);
    }
    while (sheet.children.length > SHOWN) sheet.firstChild.remove();
    if (lines.length) sheet.scrollTop = sheet.scrollHeight;
  }

  const pace = () => Number(/** @type {HTMLInputElement} */ (desk.querySelector("[name=desk-speed]:checked")).value);
  const moves = () => !STILL && pace() > 0;

  /** Draw a card and let it slide in. @param {HTMLCanvasElement} canvas @param {string} text */
  function slide(canvas, text) {
    punchedCards.draw(canvas, text);
    if (moves()) canvas.animate([{ transform: "translateX(-12%)", opacity: 0.4 }, { transform: "none", opacity: 1 }], { duration: Math.min(240, 480 / pace()), easing: "ease-out" });
  }

  /** Highlight a card of the program and show the commentary on its block. @param {number} number */
  function light(number) {
    const list = at("listing");
    if (card === number || !list.children.length) return;
    list.children[card - 1]?.removeAttribute("aria-current");
    card = number;
    const lit = list.children[number - 1];
    if (!lit) return;
    lit.setAttribute("aria-current", "step");
    if (lit.offsetTop < list.scrollTop + 20 || lit.offsetTop > list.scrollTop + list.clientHeight - 50) centre(list, lit);
    at("card").textContent = `card ${number}`;
    const blocks = data.commentary[loaded?.program.replace(/\.f$/, "")] ?? [];
    const block = blocks.find((/** @type {any[]} */ [, first, last]) => first <= number && number <= last);
    if (at("about").dataset.title === (block?.[0] ?? "")) return;
    at("about").dataset.title = block?.[0] ?? "";
    at("about").replaceChildren();
    if (block) {
      const head = Object.assign(document.createElement("h3"), { textContent: block[0] });
      at("about").append(head, Object.assign(document.createElement("p"), { textContent: block[3] }));
    }
  }

  /** Mark the cards that have been read. @param {number} count */
  function read(count) {
    const list = at("hopper");
    [...list.children].forEach((element, n) => element.classList.toggle("desk-read", n < count));
    list.querySelector("[aria-current]")?.removeAttribute("aria-current");
    list.children[count]?.setAttribute("aria-current", "true");
    centre(list, list.children[Math.min(count, list.children.length - 1)]);
    at("read").textContent = list.children.length ? `${count} of ${list.children.length} cards` : "empty";
  }

  /** Turn the lamps on that name something that just happened. @param {Set<string>} names */
  function lamps(names) {
    for (const lamp of all("[data-lamp]")) lamp.classList.toggle("is-on", names.has(lamp.dataset.lamp));
  }

  /** Show the ruler of the line that ACCEPT waits for, with the columns that Enter will type. */
  function rule() {
    at("ruler").hidden = !fields.length;
    if (!fields.length) return;
    const line = keypunch.aligned(at("line").value.toUpperCase(), fields);
    const width = Math.max(20, ...fields.map(([, first, size]) => first + size - 1), line.length);
    const names = fields.map(([code, first, size]) => `${code} in ${size > 1 ? `columns ${first} to ${first + size - 1}` : `column ${first}`}`);
    at("ruler").textContent = `FORMAT expects ${names.join(", ")}\n${keypunch.ruler(fields, width)}\n${line || " "}`;
  }

  /** Empty the desk for a new load. @param {any} load */
  function lay(load) {
    loaded = load;
    [typed, punched, card, stages, fields] = [[], [], 0, [], []];
    for (const id of ["listing", "hopper", "stacker", "paper", "about", "variables"]) at(id).replaceChildren();
    delete at("about").dataset.title;
    at("listing").append(...(load?.listing ?? []).map((/** @type {[number, string]} */ [, text]) => row(text)));
    at("hopper").append(...(load?.deck ?? []).map(row));
    punchedCards.draw(at("read-card"), "");
    punchedCards.draw(at("punch-card"), "");
    at("punched").textContent = "0 cards";
    at("next").hidden = true;
    at("true").toggleAttribute("hidden", true); // an SVG element has no property of this name
    at("stage").disabled = true;
    at("card").textContent = "";
    at("caption").textContent = "Points appear when a program reads them.";
    picture.clear();
    truth.clear();
    read(0);
    if (load?.core) core.load(load.core);
    if (load) paper([`${load.program} in core storage, ${load.deck.length} cards in the hopper`], "note");
  }

  /** Show one slice of a run. @param {any} frame */
  function render(frame) {
    const events = (/** @type {string} */ kind) => frame.events.filter((/** @type {string[]} */ [what]) => what === kind).map((/** @type {string[]} */ [, text]) => text);
    const [lines, cards, taken] = [events("type"), events("punch"), events("read")];
    typed.push(...lines);
    punched.push(...cards);
    paper(lines, "typed");
    if (taken.length) slide(at("read-card"), taken.at(-1));
    if (cards.length) {
      slide(at("punch-card"), cards.at(-1));
      at("stacker").append(...cards.map(row));
      while (at("stacker").children.length > SHOWN) at("stacker").firstChild.remove();
      at("stacker").scrollTop = at("stacker").scrollHeight;
      at("punched").textContent = `${punched.length} cards`;
    }
    const time = Math.max(0.04, pace() ? 0.4 / pace() : 0.04);
    for (const [device, texts] of /** @type {const} */ ([["type", lines], ["read", taken], ["punch", cards]]))
      if (texts.length) deskSound.strike(device, device === "type" ? texts.join(" ").length : texts.length, device === "type" ? texts.join(" ").length / 10 / (pace() || 100) : time);
    light(frame.card);
    if (frame.read !== undefined) read(frame.read);
    (frame.switches ?? []).forEach((/** @type {boolean} */ on, /** @type {number} */ n) => (all(`[data-switch="${n + 1}"]`)[0].ariaChecked = String(on)));
    const breaks = new Set(frame.breaks ?? []);
    for (const element of all("#desk-listing .has-break")) if (!breaks.has([...element.parentNode.children].indexOf(element) + 1)) element.classList.remove("has-break");
    for (const number of breaks) at("listing").children[number - 1]?.classList.add("has-break");
    core.touch(frame.wrote ?? [], loaded?.touched?.[frame.card - 1]?.[1] ?? []);
    if (frame.picture?.points) {
      picture.show(frame.picture);
      const { points, vertices, faces } = frame.picture;
      const hull = faces.length ? `Hull ${frame.stages}: ${faces.length} equations through ${vertices} vertices. ` : "";
      at("caption").textContent = `${hull}${points.length} points in the machine. Rings are points that the program has deleted.`;
    }
    [at("fac").textContent, at("fixed").textContent] = frame.registers ?? ["", ""];
    statement = frame.statement ?? 0;
    at("statements").textContent = `of ${statement}`;
    if (document.activeElement !== at("statement")) at("statement").value = String(statement || 1);
    const busy = new Set(["power"]);
    if (!frame.ended && !frame.waits) busy.add("run");
    if (taken.length) busy.add("read");
    if (cards.length) busy.add("punch");
    if (lines.length) busy.add("type");
    if (frame.waits) busy.add("wait");
    if (frame.messages?.some((/** @type {string} */ line) => line.startsWith("hull1620:"))) busy.add("check");
    lamps(busy);
  }

  const clock = (/** @type {any} */ { time }) => `${time} on a 1620`;

  /** Show a slice of the live machine, and what the visitor can do next. @param {any} frame */
  function slice(frame) {
    render(frame);
    paper(frame.did ?? [], "note");
    running = !frame.ended && !frame.waits;
    const became = frame.waits !== waits;
    waits = frame.waits;
    fields = frame.fields ?? [];
    rule();
    desk.dataset.state = frame.ended ? "ended" : waits ? "waits" : "runs";
    if (frame.ended) end(frame);
    else if (waits === "typed") say("The program asks for a line: type it below the typewriter and press Enter.");
    else if (waits && frame.statement === 1) say(`${loaded.program} is loaded. Press START.`);
    else if (waits) say(`${frame.stands}. Press START to continue, or step. ${clock(frame)}.`);
    else say(`Running, ${clock(frame)}.`);
    at("asks").textContent = waits === "typed" ? "Line" : "Console";
    if (waits === "typed" && became) {
      view("paper");
      at("line").focus({ preventScroll: true });
    }
    if (frame.ended || waits || performance.now() - looked > 400) look();
  }

  /** @param {any} frame */
  function end(frame) {
    paper(frame.messages, "note");
    const trouble = frame.messages.findLast((/** @type {string} */ line) => line.startsWith("hull1620:"));
    say(`${trouble ? `The run has stopped: ${trouble.slice(10)}` : "The run has ended."} ${clock(frame)}.`);
    if (frame.queued) return void ask("next_load").then(received);
    isReplay = false;
    if (!frame.next) return;
    choose("programs", frame.next);
    option("decks", PUNCHED, "the cards punched last", frame.next === "program2" ? "plane" : "space");
    choose("decks", PUNCHED);
    at("next").textContent = `Run ${frame.next.replace(/(\d)/, " $1")} with the punched cards`;
    at("next").hidden = false;
    if (follows) load(true);
  }

  /** Ask for what only a visible part of the desk shows. */
  async function look() {
    looked = performance.now();
    if (!machine) return;
    const part = at("picture").closest(".m-picture").querySelector("[data-look][aria-pressed=true]").dataset.look;
    if (part === "variables") at("variables").textContent = (await ask("show", "VARIABLES")).lines.join("\n");
    if (part === "points" && (waits || desk.dataset.state === "ended")) {
      stages = await ask("stages");
      at("stage").max = Math.max(stages.length, 1);
      at("stage").value = at("stage").max;
      at("stage").disabled = stages.length < 2;
    }
  }

  // ---- The machine

  /** @param {string} name @param {any[]} parameters */
  function ask(name, ...parameters) {
    if (!machine) throw new Error("the machine is not ready");
    return machine.ask(name, ...parameters).catch((error) => {
      say(`The emulator reports: ${error.message}`);
      throw error;
    });
  }

  async function connect() {
    at("progress").max = hull1620.bytes;
    at("progress").hidden = false;
    const began = performance.now();
    const connection = await hull1620.connect((bytes) => {
      at("progress").value = bytes;
      const size = `${(bytes / 1e6).toFixed(1)} of ${(hull1620.bytes / 1e6).toFixed(1)} MB`;
      const remaining = ((performance.now() - began) / 1000) * (hull1620.bytes / bytes - 1);
      const time = bytes < hull1620.bytes ? `about ${Math.ceil(remaining) + 3} seconds more` : "starting Python, a few seconds";
      at("progress").title = size;
      if (!wish) say(`A recorded run of example 5, while the emulator loads: ${size}, ${time}. Nothing leaves your computer.`);
    }, slice);
    machine = connection;
    at("progress").hidden = true;
    offer(connection.offers);
    await ask("pace", pace());
    desk.dataset.state = "on";
  }

  /** Load what is chosen; with ``start`` also press START. @param {boolean} [start] @param {string} [stop] */
  async function load(start = false, stop = "") {
    recordedEnds();
    if (!machine) {
      wish = start ? "START" : "LOAD";
      return say("The emulator is still loading. It will begin by itself.");
    }
    const on = all("[data-switch]").filter((element) => element.ariaChecked === "true").map((element) => Number(element.dataset.switch));
    desk.dataset.state = "loading";
    say("Compiling …");
    const late = setTimeout(restart, COMPILING);
    const answer = await ask("load", { program: chosen("programs"), deck: chosen("decks"), switches: on, upcase: at("upcase").checked });
    clearTimeout(late);
    if (!received(answer)) return;
    if (stop) await act(`BREAK ${stop}`);
    if (start) await act("START");
  }

  /** Show the answer of a load. @param {any} answer */
  function received(answer) {
    running = false;
    waits = answer.refused ? "" : "answer";
    lay(answer.refused ? null : answer);
    if (!answer.refused) return true;
    desk.dataset.state = "refused";
    lamps(new Set(["power", "check"]));
    say(`Refused: ${answer.refused[0]}. Nothing is loaded. Correct the cards or choose others, and press Load.`);
    paper(answer.refused, "note");
    return false;
  }

  function restart() {
    machine?.stop();
    machine = null;
    say("The compiler was stopped after 10 seconds. The command hull1620 check has no time limit. Loading again …");
    connect().then(() => say("The compiler was stopped after 10 seconds. The machine is on again. Load a program."));
  }

  /** Send a command of the operator. @param {string} words */
  async function act(words) {
    const { lines } = await ask("act", words);
    paper(lines, "note");
  }

  /** Go to a statement of the run. @param {number} number */
  async function jump(number) {
    const answer = await ask("jump", number);
    if (!answer.undone) return;
    typed.length = Math.min(typed.length, answer.undone.typed);
    punched.length = Math.min(punched.length, answer.undone.punched);
    at("paper").replaceChildren();
    paper(typed, "note");
    for (const line of all("#desk-paper .desk-note")) line.className = "desk-typed";
    at("stacker").replaceChildren(...punched.slice(-SHOWN).map(row));
    at("punched").textContent = `${punched.length} cards`;
    punchedCards.draw(at("punch-card"), punched.at(-1) ?? "");
    if (loaded?.core) core.load(loaded.core);
    picture.clear();
    if (stages[0]) picture.show(stages[0]);
    at("next").hidden = true;
    slice(answer);
  }

  // ---- Programs and decks

  /** @param {"programs" | "decks"} what @param {string} name @param {string} title @param {string} [kind] */
  function option(what, name, title, kind = "") {
    const select = at(NAMES[what]);
    if (kind) kinds.set(`${what} ${name}`, kind);
    if (![...select.options].some((element) => element.value === name)) select.add(new Option(title, name));
  }

  /** @param {"programs" | "decks"} what @param {string} name */
  function choose(what, name) {
    at(NAMES[what]).value = name;
  }

  /** @param {"programs" | "decks"} what */
  function chosen(what) {
    const name = at(NAMES[what]).value;
    return own[what].has(name) ? [name, own[what].get(name)] : name;
  }

  /** @param {any} offers */
  function offer(offers) {
    for (const what of /** @type {const} */ (["programs", "decks"]))
      for (const [name, title, kind] of offers[what]) option(what, name, title, kind);
  }

  /** Add a program or a deck of the visitor. @param {"programs" | "decks"} what @param {string} name @param {string} text @param {string} [title] */
  function add(what, name, text, title = name) {
    own[what].set(name, text);
    option(what, name, title, name.replace(/\.\w+$/, ""));
    choose(what, name);
  }

  /** Choose a deck that fits the program. */
  function fit() {
    const kind = kinds.get(`programs ${at("program").value}`) ?? "";
    if (kinds.get(`decks ${at("deck").value}`) === kind) return;
    const deck = FITS[/** @type {keyof FITS} */ (kind)] ?? [...own.decks.keys()].find((name) => kinds.get(`decks ${name}`) === kind) ?? "";
    choose("decks", deck);
    say(`${at("program").value} with ${deck || "no deck"}. Press Load, then START.`);
  }

  /** @param {FileList} files */
  async function take(files) {
    for (const file of files) {
      const text = await file.text();
      if (/^(LOAD|CARDS) /m.test(text)) {
        recordedEnds();
        isReplay = received(await ask("replay", text));
      } else {
        const what = /\.(f|for|ftn|f77)$/i.test(file.name) || /^\s{6,}[A-Z]|^C /m.test(text.slice(0, 400)) ? "programs" : "decks";
        add(what, file.name, text);
        say(`${file.name} is read as a ${NAMES[what]}. Press Load.`);
      }
    }
  }

  // ---- The recorded run

  function recordedEnds() {
    clearTimeout(frames);
    frames = 0;
    at("replay").hidden = true;
  }

  function play() {
    recordedEnds();
    lay(data.recorded.load);
    let n = 0;
    const next = () => {
      render(data.recorded.frames[n]);
      n += 1;
      if (n < data.recorded.frames.length) frames = window.setTimeout(next, 1000 / data.pace);
      else recordedEnds();
    };
    next();
  }

  // ---- What the visitor does

  /** Show one part of the desk on a small screen. @param {string} name */
  function view(name) {
    desk.dataset.view = name;
    for (const button of all(".m-tabs button")) button.ariaPressed = String(button.dataset.view === name);
    core.draw();
  }

  at("choose").addEventListener("submit", (/** @type {Event} */ event) => {
    event.preventDefault();
    follows = false;
    load();
  });
  at("program").addEventListener("change", fit);
  at("next").addEventListener("click", () => load(true));
  at("replay").addEventListener("click", play);
  at("files").addEventListener("change", (/** @type {any} */ { target }) => take(target.files));
  desk.addEventListener("dragover", (event) => event.preventDefault());
  desk.addEventListener("drop", (event) => {
    event.preventDefault();
    if (machine && event.dataTransfer) take(event.dataTransfer.files);
  });
  for (const button of all(".m-tabs button")) button.addEventListener("click", () => view(button.dataset.view));
  for (const button of all("[data-look]"))
    button.addEventListener("click", () => {
      for (const other of all("[data-look]")) other.ariaPressed = String(other === button);
      for (const part of all("[data-part]")) part.hidden = part.dataset.part !== button.dataset.look;
      core.draw();
      look();
    });
  for (const button of all("[data-words]"))
    button.addEventListener("click", () => {
      // START on an empty machine or after the end loads what is chosen.
      if (button.dataset.words === "START" && (!machine || !running && !waits)) load(true);
      else if (machine) act(button.dataset.words);
    });
  for (const button of all("[data-switch]"))
    button.addEventListener("click", () => {
      const on = button.ariaChecked !== "true";
      button.ariaChecked = String(on);
      if (machine && (running || waits)) act(`SWITCH ${button.dataset.switch} ${on ? "ON" : "OFF"}`);
    });
  for (const button of all("[name=desk-speed]")) button.addEventListener("change", () => machine && ask("pace", pace()));
  at("sound").addEventListener("change", () => deskSound.turn(at("sound").checked));
  at("back").addEventListener("click", () => machine && statement > 1 && jump(waits ? statement - 1 : statement));
  at("jump").addEventListener("submit", (/** @type {Event} */ event) => {
    event.preventDefault();
    if (machine && loaded) jump(Number(at("statement").value));
  });
  at("break").addEventListener("submit", (/** @type {Event} */ event) => {
    event.preventDefault();
    if (machine) act(`BREAK ${at("where").value}`);
  });
  at("clear").addEventListener("click", () => machine && act("CLEAR"));
  at("listing").addEventListener("click", (/** @type {any} */ { target }) => {
    const element = target.closest("li");
    if (!element || !machine || !(waits || running)) return;
    const number = [...at("listing").children].indexOf(element) + 1;
    act(`${element.classList.contains("has-break") ? "CLEAR" : "BREAK"} CARD ${number}`);
  });
  at("stage").addEventListener("input", () => {
    const number = Number(at("stage").value);
    picture.show(stages[number - 1]);
    at("caption").textContent = `Hull ${number} of ${stages.length}: ${stages[number - 1].faces.length} equations.`;
  });
  at("decide").addEventListener("click", async () => {
    if (!machine || !loaded) return say("Load a program first.");
    say("Exact arithmetic runs the same program …");
    const { lines, statement: differs, hull } = await ask("decide");
    paper(lines, "note");
    if (hull) {
      truth.show(hull);
      at("true").toggleAttribute("hidden", false);
    }
    if (!differs) return say(`${lines[0]}.`);
    await jump(differs);
    if (hull) at("caption").textContent = "Left: the hull in the machine. Right: the true hull.";
    say(`The first decision that exact arithmetic takes otherwise: ${lines.join("; ")}. Press START to watch it.`);
  });

  /** Show the field at the cursor of the map, with the digits as the 1620 held them. @param {number} digit */
  async function field(digit) {
    const region = core.region(digit);
    const found = machine && loaded ? await ask("field", digit) : {};
    if (!region) return;
    const place = `${String(region[2]).padStart(5, "0")} to ${String(region[3]).padStart(5, "0")}`;
    if (!found.name) return (at("field").textContent = `${region[0]}, ${place}.`);
    const [first, last] = found.addresses.map((/** @type {number} */ n) => String(n).padStart(5, "0"));
    const parts = [`${found.name} = ${found.value}, positions ${first} to ${last}.`];
    if (found.digits) parts.push(`Digits ${found.digits}${found.floating ? `: mantissa ${found.digits.slice(0, 8)}, characteristic ${found.digits.slice(8)}` : ""}. A letter or ] is a digit with a flag.`);
    if (found.writer.length) parts.push(`Written last by card ${found.writer[0]}, statement ${found.writer[1]} of the run.`);
    at("field").textContent = parts.join(" ");
  }
  at("core").addEventListener("click", (/** @type {MouseEvent} */ event) => field(core.point(core.address(event.clientX, event.clientY))));
  at("core").addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => {
    const step = { ArrowLeft: -coreMap.FIELD, ArrowRight: coreMap.FIELD, ArrowUp: -coreMap.ACROSS, ArrowDown: coreMap.ACROSS, Enter: 0 }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    const digit = core.point(core.cursor + step);
    field(digit);
  });

  at("line").addEventListener("input", rule);
  at("typing").addEventListener("submit", (/** @type {Event} */ event) => {
    event.preventDefault();
    const line = waits === "typed" ? keypunch.aligned(at("line").value, fields) : at("line").value;
    at("line").value = "";
    if (!machine) return say("The emulator is still loading.");
    if (waits === "typed") {
      paper([line.toUpperCase()], "typed");
      act(`ENTER ${line}`);
    } else {
      paper([`1620> ${line}`], "note");
      act(line);
    }
  });

  const punching = keypunch.open({
    check: async (text) => (machine ? ask("check", text) : []),
    use(what, name, text) {
      add(what, name, text);
      say(`${name} is the ${NAMES[what]}. Press Load.`);
    },
  });
  at("punch-open").addEventListener("click", () => {
    const program = at("program").value;
    if (own.programs.has(program)) punching.show("programs", program, own.programs.get(program) ?? "", loaded?.formats ?? []);
    else punching.show("programs", "mine.f", "", loaded?.formats ?? []);
  });

  const FILES = { punched: "cards.punch", typed: "typewriter.txt", log: "session.operator" };
  for (const button of all("[data-save]"))
    button.addEventListener("click", async () => {
      const what = /** @type {keyof FILES} */ (button.dataset.save);
      const text = what === "log" ? (machine ? await ask("log") : "") : (what === "typed" ? typed : punched).map((line) => `${line}\n`).join("");
      const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(new Blob([text], { type: "text/plain" })), download: FILES[what] });
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 1000);
    });
  at("link").addEventListener("click", async () => {
    const on = all("[data-switch]").filter((element) => element.ariaChecked === "true").map((element) => Number(element.dataset.switch));
    const hash = await deskLink.write({ program: chosen("programs"), deck: chosen("decks"), switches: on, speed: String(pace()), stop: at("where").value, next: false, upcase: at("upcase").checked });
    history.replaceState(null, "", `#${hash}`);
    try {
      await navigator.clipboard.writeText(location.href);
      say("The link is in the clipboard and in the address of the page.");
    } catch {
      say("The link is in the address of the page.");
    }
  });

  // ---- The beginning

  /** Choose what a link names. @param {import("./link.js").Moment} moment */
  function set(moment) {
    for (const what of /** @type {const} */ (["programs", "decks"])) {
      const value = what === "programs" ? moment.program : moment.deck;
      if (typeof value === "string") {
        option(what, value, value);
        choose(what, value);
      } else add(what, value[0], value[1]);
    }
    for (const button of all("[data-switch]")) button.ariaChecked = String(moment.switches.includes(Number(button.dataset.switch)));
    all(`[name=desk-speed][value="${moment.speed}"]`)[0].checked = true;
    at("where").value = moment.stop;
    follows = moment.next;
    at("upcase").checked = moment.upcase;
  }

  async function begin() {
    for (const [name, text] of Object.entries(data.period)) add(name.endsWith(".f") ? "programs" : "decks", name, /** @type {string} */ (text), `${name}, in the style of the period`);
    option("decks", "", "no deck");
    option("programs", "program1_examples", "program 1 in the state that produced the examples", "points");
    option("decks", "example5", "example 5 of chapter 6", "points");
    choose("programs", "program1_examples");
    choose("decks", "example5");
    const moment = await deskLink.read();
    if (moment) set(moment);
    if (moment || STILL) {
      lay(STILL && !moment ? data.recorded.load : null);
      if (!moment) render({ ...data.recorded.frames.at(-1), picture: data.recorded.frames.findLast((/** @type {any} */ frame) => frame.picture).picture });
      at("replay").hidden = Boolean(moment);
    } else play();
    if (!hull1620.bytes) {
      at("replay").hidden = false;
      return say("A recorded run of example 5. This site was built without the emulator: run “npm ci --prefix docs/console” and “make edition”.");
    }
    try {
      await connect();
    } catch (error) {
      at("progress").hidden = true;
      desk.dataset.state = "off";
      at("replay").hidden = false;
      return say(`The emulator is not available: ${/** @type {Error} */ (error).message}. The recorded run is unchanged.`);
    }
    if (moment) await load(true, moment.stop);
    else if (wish) await load(wish === "START");
    else say("The machine is on. Press START to run example 5, or choose another program.");
  }

  addEventListener("hashchange", async () => {
    const moment = await deskLink.read();
    if (!moment) return;
    set(moment);
    if (machine) load(true, moment.stop);
  });
  begin();
})();
