// The machine of the desk: it is loaded, started, stopped and turned back, and its answers are shown.
"use strict";

const deskRun = (() => {
  const { at, say, paper, desk } = deskPage;
  const COMPILING = 10000; // the longest time to compile, in milliseconds
  const LOOK = 400; // milliseconds between two looks at the variables of a running machine
  const line = at("line", HTMLInputElement);
  const next = at("next", HTMLButtonElement);
  const progress = at("progress", HTMLProgressElement);
  /** @type {Machine | null} */
  let machine = null;
  let waits = "";
  let running = false;
  let isLoading = false; // slices that arrive during a load belong to the machine before it
  let follows = false; // the next program is loaded when program 1 ends
  let isChanged = false; // another program or deck has been chosen since the last load
  let wish = ""; // START or LOAD, pressed before the machine is ready
  let looked = 0;
  let loads = 0; // counts loads, so that an earlier one does not act on the machine of a later one
  let late = 0;
  let isStarting = false; // START was pressed during a load

  const clock = (/** @type {Frame} */ { time }) => `${time} on a 1620`;

  const statements = (/** @type {number} */ count) => (count > 1 ? `the same ${count.toLocaleString("en")} statements` : "the same statement");

  /** @param {string} name @param {any[]} parameters @returns {Promise<any>} */
  function ask(name, ...parameters) {
    if (!machine) throw new Error("the machine is not ready");
    return machine.ask(name, ...parameters).catch((error) => {
      say(`The emulator reports: ${error.message}`);
      throw error;
    });
  }

  /** Show the message of a slice that failed; START then loads the program again. @param {string} message */
  function trouble(message) {
    running = false;
    waits = "";
    deskPage.enter("ended");
    say(`The emulator reports: ${message}`);
  }

  /** Load the emulator; the desk shows how much of it has arrived. @param {string} [label] The state of the page meanwhile. */
  async function connect(label = "The emulator is loading") {
    progress.max = hull1620.bytes;
    progress.hidden = false;
    const began = performance.now();
    const connection = await hull1620.connect((bytes) => {
      progress.value = bytes;
      const size = `${(bytes / 1e6).toFixed(1)} of ${(hull1620.bytes / 1e6).toFixed(1)} MB`;
      const remaining = ((performance.now() - began) / 1000) * (hull1620.bytes / bytes - 1);
      const time = bytes < hull1620.bytes ? `about ${Math.ceil(remaining) + 3} seconds more` : "starting Python, a few seconds";
      progress.title = size;
      if (!wish) say(`${label}: ${size}, ${time}. Nothing leaves your computer.`);
    }, slice, trouble);
    machine = connection;
    progress.hidden = true;
    deskChoice.offer(connection.offers);
    await ask("pace", deskPage.pace());
    deskPage.enter("on");
  }

  /** Load what is chosen; with ``start`` also press START. @param {boolean} [start] @param {string} [stop] */
  async function load(start = false, stop = "") {
    deskTape.end();
    if (!machine) {
      wish = start ? "START" : "LOAD";
      return say("The emulator is still loading. It will begin by itself.");
    }
    wish = "";
    if (!(await begin("load", deskChoice.request()))) return;
    const own = loads;
    if (stop) await act(`BREAK ${stop}`);
    if ((start || isStarting) && own === loads) await act("START");
  }

  /**
   * Let the emulator load a program and show its answer, unless a later load replaces it. Return whether it is loaded.
   * @param {"load" | "next_load" | "replay"} name @param {any[]} parameters
   */
  async function begin(name, ...parameters) {
    const own = ++loads;
    isChanged = isStarting = false;
    isLoading = true;
    deskPage.enter("loading");
    say("Compiling …");
    clearTimeout(late);
    late = window.setTimeout(restart, COMPILING);
    /** @type {Load | Error} */
    const answer = await ask(name, ...parameters).catch((error) => error);
    if (own !== loads) return false;
    clearTimeout(late);
    running = isLoading = false;
    return received(answer);
  }

  /** Show the answer of a load, and return whether the machine is loaded. @param {Load | Error} answer */
  function received(answer) {
    const isLoaded = !(answer instanceof Error || answer.refused);
    waits = isLoaded ? "answer" : "";
    if (answer instanceof Error) {
      deskShow.lay(null);
      trouble(answer.message);
    } else if (answer.refused) deskShow.refuse(answer.refused);
    else deskShow.lay(answer);
    return isLoaded;
  }

  function restart() {
    machine?.stop();
    machine = null;
    running = isLoading = false;
    waits = "";
    const stopped = "The compiler was stopped after 10 seconds.";
    say(`${stopped} The command hull1620 check has no time limit. Loading again …`);
    connect(`${stopped} The emulator is loading again`).then(
      () => (wish ? load(wish === "START") : say(`${stopped} The machine is on again. Load a program.`)),
      absent,
    );
  }

  /** Show that the emulator cannot be loaded. @param {Error} error */
  function absent(error) {
    wish = "";
    progress.hidden = true;
    deskPage.enter("off");
    say(`The emulator is not available: ${error.message}.`);
  }

  /** Send a command of the operator. @param {string} words */
  async function act(words) {
    const { lines } = await ask("act", words);
    paper(lines, "note");
  }

  /** Press a key of the console. START on a machine that has not begun loads what is chosen. @param {string} words */
  function press(words) {
    const isIdle = !running && !waits;
    const isOther = isChanged && !running && deskShow.statement <= 1;
    if (words === "START" && isLoading && !isChanged) isStarting = true;
    else if (words === "START" && (!machine || isIdle || isOther)) load(true);
    else if (machine) act(words);
  }

  /** Say what to do after another program or deck has been chosen. */
  function change() {
    isChanged = true;
    deskTape.release();
    const isHeld = (running || waits) && deskShow.statement > 1;
    say(`${deskChoice.names()}. Press ${isHeld ? "Load: it replaces the program in the machine" : "START"}.`);
  }

  /** Turn a sense switch. @param {string} number @param {boolean} isOn */
  function turn(number, isOn) {
    if (machine && (running || waits)) act(`SWITCH ${number} ${isOn ? "ON" : "OFF"}`);
  }

  /** Go to a statement of the run. @param {number} number */
  async function jump(number) {
    if (!machine || !deskShow.loaded) return;
    /** @type {Frame} */
    const answer = await ask("jump", number);
    if (!answer.undone) return;
    deskShow.undo(answer.undone);
    slice(answer);
  }

  /** Go back by one statement. */
  function back() {
    if (deskShow.statement > 1) jump(waits ? deskShow.statement - 1 : deskShow.statement);
  }

  /** Show a slice of the live machine, and what the visitor can do next. @param {Frame} frame */
  function slice(frame) {
    if (isLoading) return;
    deskShow.render(frame);
    paper(frame.did ?? [], "note");
    running = !frame.ended && !frame.waits;
    const became = frame.waits !== waits;
    waits = frame.waits;
    deskShow.expect(frame.fields ?? []);
    deskPage.enter(frame.ended ? "ended" : waits ? "waits" : "runs");
    const program = deskShow.loaded?.program;
    if (frame.ended) end(frame);
    else if (frame.repeats) say(`Without an action of yours, this run never ends: it repeats ${statements(frame.repeats)} with the same values. ${clock(frame)}. Press “end run”; if the program tests a sense switch, turn it and press START.`);
    else if (waits === "typed") say("The program asks for a line: type it below the typewriter and press Enter.");
    else if (waits && frame.statement === 1) say(`${program} is loaded. Press START.`);
    else if (waits) say(`${frame.stands}. Press START to continue, or step. ${clock(frame)}.`);
    else say(`Running, ${clock(frame)}.`);
    line.placeholder = waits === "typed" ? "" : "? for help";
    at("asks", HTMLElement).textContent = waits === "typed" ? "Line" : "Console";
    if (waits === "typed" && became) {
      view("paper");
      line.focus({ preventScroll: true });
    }
    if (frame.ended || waits || performance.now() - looked > LOOK) look();
  }

  /** @param {Frame} frame */
  function end(frame) {
    paper(frame.messages ?? [], "note");
    const trouble = frame.messages?.findLast((text) => text.startsWith("hull1620:"));
    const isHull = (frame.stages ?? 0) > 0 && !frame.next;
    const verdict = deskShow.verdict || (isHull ? "Is the hull right? Press “Compare with exact arithmetic” below the points." : "");
    say(`${trouble ? `The run has stopped: ${trouble.slice(10)}` : "The run has ended."} ${clock(frame)}. ${verdict}`);
    if (isHull) view("picture");
    if (frame.queued) return void begin("next_load");
    if (!frame.next) return;
    deskChoice.choosePunched(frame.next);
    next.textContent = `Run ${frame.next.replace(/(\d)/, " $1")} with the punched cards`;
    next.hidden = false;
    if (follows) load(true);
  }

  /** Ask for what only a visible part of the desk shows. */
  async function look() {
    looked = performance.now();
    if (!machine) return;
    const part = deskPage.all("[data-look][aria-pressed=true]")[0]?.dataset.look;
    if (part === "variables") at("variables", HTMLElement).textContent = (await ask("show", "VARIABLES")).lines.join("\n");
    if (part === "points" && (waits || desk.dataset.state === "ended")) deskShow.offerStages(await ask("stages"));
  }

  /** Show one part of the desk on a small screen. @param {string} name */
  function view(name) {
    desk.dataset.view = name;
    for (const button of deskPage.all(".m-tabs button")) button.ariaPressed = String(button.dataset.view === name);
    deskShow.core.draw();
  }

  /** Show the first decision that is different in exact arithmetic. */
  async function decide() {
    if (!machine || !deskShow.loaded) return say("Load a program first.");
    say("Exact arithmetic runs the same program …");
    /** @type {Verdict} */
    const answer = await ask("decide");
    const { lines, statement, says } = answer;
    paper(lines, "note");
    deskShow.compare(answer, desk.dataset.state === "ended");
    if (!statement) return say(`${lines[0][0].toUpperCase()}${lines[0].slice(1)}. ${says ?? ""}`);
    await jump(statement);
    say(`The first decision that is different in exact arithmetic, which begins with the cards of this run: ${lines.join("; ")}. Press START to see its effect on the hull.`);
  }

  /** Show the field at an address, with the digits as the 1620 held them. @param {number} digit */
  async function field(digit) {
    const region = deskShow.core.region(digit);
    const found = machine && deskShow.loaded ? await ask("field", digit) : {};
    if (!region) return;
    const five = (/** @type {number} */ address) => String(address).padStart(5, "0");
    const parts = [`${region[0]}, ${five(region[2])} to ${five(region[3])}.`];
    if (found.name) {
      parts[0] = `${found.name} = ${found.value}, positions ${found.addresses.map(five).join(" to ")}.`;
      const { digits } = found;
      if (digits) parts.push(`Digits ${digits}${found.floating ? `: mantissa ${digits.slice(0, 8)}, characteristic ${digits.slice(8)}` : ""}. A letter or ] is a digit with a flag.`);
      if (found.writer.length) parts.push(`Written last by card ${found.writer[0]}, statement ${found.writer[1]} of the run.`);
    }
    at("field", HTMLElement).textContent = parts.join(" ");
  }

  /** Type a line: the answer to ACCEPT, or a command of the operator. */
  function type() {
    const isAnswer = waits === "typed";
    const text = isAnswer ? deskShow.aligned() : line.value;
    line.value = "";
    if (!machine) return say("The emulator is still loading.");
    paper([isAnswer ? text.toUpperCase() : `1620> ${text}`], isAnswer ? "typed" : "note");
    act(isAnswer ? `ENTER ${text}` : text);
  }

  /** Repeat the log of a session. @param {string} text */
  function replay(text) {
    deskTape.end();
    follows = false;
    return begin("replay", text);
  }

  /** Open the desk at a moment that a link names. @param {Moment} moment */
  async function open(moment) {
    deskChoice.set(moment);
    follows = moment.next;
    if (machine) await ask("pace", deskPage.pace());
    return load(true, moment.stop);
  }

  return {
    absent, act, ask, back, change, connect, decide, field, jump, load, look, open, press, replay, turn, type, view,
    /** Say whether a program and its deck follow program 1 without a key. @param {boolean} on */
    follow: (on) => void (follows = on),
    get isOn() { return machine !== null; },
    get isBusy() { return running || waits !== ""; },
    get wish() { return wish; },
  };
})();
