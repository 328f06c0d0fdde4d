// The controls of the emulator (modern/publication/desk.py), which runs in a worker of this page.
"use strict";
(() => {
  const at = (id) => document.getElementById(`desk-${id}`);
  const desk = document.getElementById("desk");
  const there = new URL("../console/", document.currentScript.src).href;
  const bytes = window.hull1620Bytes ?? 0; // set by console/size.js; 0 if the site was built without the emulator
  const PACES = [1, 10, 100, 1000, 10000, 0];
  const SPEEDS = ["as in 1963", "10 times 1963", "100 times", "1,000 times", "10,000 times", "full speed"];
  const COMPILING = 10000; // the largest compile time in milliseconds
  const SHOWN = 2000; // the number of lines and cards that the page shows; saved files are complete
  const period = JSON.parse(at("period").textContent);
  const own = { programs: new Map(), decks: new Map() };
  let worker = null;
  let asked = new Map();
  let number = 0;
  let typed = [];
  let punched = [];
  let waits = "";
  let running = false;
  let oldCard = 0;
  let lastLook = 0;

  if (location.protocol === "file:") {
    at("says").textContent =
      "The emulator needs a web server: run “python3 -m http.server” in the folder of this page, and open " +
      "http://localhost:8000/console.html. Below is a recorded session.";
    return;
  }
  if (!bytes) {
    at("says").textContent =
      "This site was built without the emulator. To include it, run “npm ci --prefix docs/console” and “make edition”.";
    return;
  }
  at("says").textContent =
    `The page loads Python and this project (${(bytes / 1e6).toFixed(1)} MB). Nothing leaves your computer.`;
  at("progress").max = bytes;
  at("begin").hidden = false;
  at("begin").addEventListener("click", begin);

  function ask(what, more = {}) {
    return new Promise((done, failed) => {
      number += 1;
      asked.set(number, { done, failed });
      worker.postMessage({ id: number, do: what, ...more });
    });
  }

  function employ() {
    worker = new Worker(there + "worker.mjs", { type: "module" });
    asked = new Map();
    worker.onmessage = ({ data }) => {
      if (data.progress !== undefined) at("progress").value = data.progress;
      else if (data.slice) slice(data.slice);
      else {
        const { done, failed } = asked.get(data.id);
        asked.delete(data.id);
        if (data.failed !== undefined) failed(new Error(data.failed));
        else done(data.answer);
      }
    };
    worker.onerror = (event) => stopped(event.message || "the emulator could not be loaded");
  }

  async function begin() {
    at("begin").disabled = true;
    at("progress").hidden = false;
    at("says").textContent = "Loading …";
    employ();
    try {
      offer(await ask("begin"));
    } catch (error) {
      stopped(error.message);
      return;
    }
    at("progress").hidden = true;
    at("begin").hidden = true;
    desk.dataset.state = "on";
    desk.querySelector(".desk-parts").hidden = false;
    desk.querySelector(".desk-recorded").hidden = true;
    at("says").textContent = "";
    say("Choose a program and a deck and load them.");
    pace();
    at("program").focus();
  }

  function stopped(why) {
    at("progress").hidden = true;
    at("begin").disabled = false;
    at("says").textContent = `The emulator is not available: ${why}. The recorded session below is unchanged.`;
  }

  function option(select, value, text) {
    const found = [...select.options].find((one) => one.value === value);
    if (found) return found;
    const one = new Option(text, value);
    select.add(one);
    return one;
  }

  function offer(offers) {
    for (const [name, title] of offers.programs) option(at("program"), name, title);
    option(at("deck"), "", "no deck");
    for (const [name, title] of offers.decks) option(at("deck"), name, title);
    for (const [name, text] of Object.entries(period)) {
      const what = name.endsWith(".f") ? "programs" : "decks";
      own[what].set(name, text);
      option(at(what === "programs" ? "program" : "deck"), name, `${name}, in the style of the period`);
    }
    at("program").value = "program1_examples";
    at("deck").value = "example4";
  }

  async function take(files) {
    for (const file of files) {
      const text = await file.text();
      const what = /\.(f|for|ftn|f77)$/i.test(file.name) || /^\s{6,}|^C/m.test(text.slice(0, 400)) ? "programs" : "decks";
      own[what].set(file.name, text);
      const select = at(what === "programs" ? "program" : "deck");
      option(select, file.name, file.name);
      select.value = file.name;
      say(`${file.name} is read as a ${what === "programs" ? "program" : "deck"}.`);
    }
  }
  at("files").addEventListener("change", ({ target }) => take(target.files));
  desk.addEventListener("dragover", (event) => event.preventDefault());
  desk.addEventListener("drop", (event) => {
    event.preventDefault();
    if (worker) take(event.dataTransfer.files);
  });

  function chosen(select, what) {
    const name = at(select).value;
    return own[what].has(name) ? [name, own[what].get(name)] : name;
  }

  at("choose").addEventListener("submit", (event) => {
    event.preventDefault();
    load(chosen("deck", "decks"));
  });
  at("again").addEventListener("click", () => {
    option(at("deck"), "stacker", "the cards punched last");
    at("deck").value = "stacker";
    say("The cards are in the reader. Choose a program and load it.");
    at("program").focus();
  });

  async function load(deck) {
    const switches = [...desk.querySelectorAll("[data-switch]")];
    const on = switches.filter((one) => one.ariaChecked === "true").map((one) => Number(one.dataset.switch));
    say("Compiling …");
    const late = setTimeout(() => {
      worker.terminate();
      say("The compiler was stopped after 10 seconds. The command hull1620 check has no time limit. Loading again …");
      employ();
      ask("begin").then(() => say("The compiler was stopped after 10 seconds. The machine is on again."));
    }, COMPILING);
    const answer = await ask("load", { request: { program: chosen("program", "programs"), deck, switches: on, upcase: at("upcase").checked } });
    clearTimeout(late);
    if (answer.refused) {
      const [first, ...rest] = answer.refused;
      say(first + (rest.length ? ` (and ${rest.length} more lines on the typewriter)` : ""));
      paper(answer.refused, "note");
      return;
    }
    typed = [];
    punched = [];
    oldCard = 0;
    at("listing").replaceChildren(...answer.listing.map(([, text]) => card(text)));
    at("hopper").replaceChildren(...answer.deck.map(card));
    at("stacker").replaceChildren();
    at("paper").replaceChildren();
    at("variables").textContent = "";
  }

  function card(text) {
    const one = document.createElement("li");
    one.textContent = text || " ";
    return one;
  }

  function add(list, texts) {
    const end = list.scrollHeight - list.scrollTop - list.clientHeight < 40;
    list.append(...texts.map(card));
    while (list.children.length > SHOWN) list.firstChild.remove();
    if (end) list.scrollTop = list.scrollHeight;
  }

  function paper(lines, kind) {
    if (!lines.length) return;
    const sheet = at("paper");
    for (const line of lines) {
      const one = document.createElement("span");
      one.className = `desk-${kind}`;
      one.textContent = line + "\n";
      sheet.append(one);
    }
    while (sheet.children.length > SHOWN) sheet.firstChild.remove();
    sheet.scrollTop = sheet.scrollHeight;
  }

  function say(text) {
    at("state").textContent = text;
  }

  function slice(answer) {
    const cards = answer.events.filter(([what]) => what === "punch").map(([, text]) => text);
    const lines = answer.events.filter(([what]) => what === "type").map(([, text]) => text);
    typed.push(...lines);
    punched.push(...cards);
    paper(lines, "typed");
    add(at("stacker"), cards);
    light(answer.card);
    read(answer.read ?? 0);
    switches(answer.switches ?? []);
    paper(answer.did ?? [], "note");
    running = !answer.ended && !answer.waits;
    const became = answer.waits !== waits;
    waits = answer.waits;
    desk.dataset.state = answer.ended ? "ended" : waits ? "waits" : "runs";
    const time = `${answer.seconds.toLocaleString("en")} s on a 1620`;
    if (answer.ended) {
      paper(answer.messages, "note");
      say(`The run has ended${answer.messages.length ? `: ${answer.messages.at(-1)}` : " normally"}. ${time}.`);
    } else say(`${waits ? answer.stands : "Running"}. ${time}.`);
    at("asks").textContent = waits === "typed" ? "ACCEPT: type the line" : "Console";
    if (waits === "typed" && became) at("line").focus();
    if (answer.ended || waits || performance.now() - lastLook > 400) look();
  }

  async function look() {
    lastLook = performance.now();
    const { lines } = await ask("show", { words: "VARIABLES" });
    at("variables").textContent = lines.join("\n");
  }

  function light(number) {
    const cards = at("listing").children;
    if (oldCard === number || !cards.length) return;
    cards[oldCard - 1]?.removeAttribute("aria-current");
    const lit = cards[number - 1];
    oldCard = number;
    if (!lit) return;
    lit.setAttribute("aria-current", "step");
    const list = at("listing");
    if (lit.offsetTop < list.scrollTop || lit.offsetTop > list.scrollTop + list.clientHeight - 40)
      list.scrollTop = lit.offsetTop - list.clientHeight / 2;
  }

  function read(count) {
    const list = at("hopper");
    const before = Number(list.dataset.read ?? 0);
    for (let n = Math.min(before, count); n < Math.max(before, count) && n < list.children.length; n += 1)
      list.children[n].classList.toggle("desk-read", n < count);
    list.dataset.read = count;
    const next = list.children[count];
    list.querySelector("[aria-current]")?.removeAttribute("aria-current");
    next?.setAttribute("aria-current", "true");
    if (next) list.scrollTop = next.offsetTop - list.clientHeight / 2;
  }

  function switches(on) {
    on.forEach((state, n) => {
      desk.querySelector(`[data-switch="${n + 1}"]`).ariaChecked = String(state);
    });
  }

  async function act(words) {
    const { lines } = await ask("act", { words });
    paper(lines, "note");
  }

  for (const button of desk.querySelectorAll("[data-words]"))
    button.addEventListener("click", () => act(button.dataset.words));
  for (const button of desk.querySelectorAll("[data-switch]"))
    button.addEventListener("click", () => {
      const on = button.ariaChecked !== "true";
      if (running || waits) act(`SWITCH ${button.dataset.switch} ${on ? "ON" : "OFF"}`);
      else button.ariaChecked = String(on);
    });
  at("typing").addEventListener("submit", (event) => {
    event.preventDefault();
    const line = at("line").value;
    at("line").value = "";
    if (waits === "typed") {
      paper([line.toUpperCase()], "typed");
      act(`ENTER ${line}`);
    } else {
      paper([`1620> ${line}`], "note");
      act(line);
    }
  });

  function pace() {
    const chosenSpeed = Number(at("speed").value);
    at("speed-says").textContent = SPEEDS[chosenSpeed];
    if (worker) ask("pace", { value: PACES[chosenSpeed] });
  }
  at("speed").addEventListener("input", pace);

  for (const button of desk.querySelectorAll("[data-save]"))
    button.addEventListener("click", async () => {
      const what = button.dataset.save;
      const text = what === "log" ? await ask("log") : (what === "typed" ? typed : punched).map((line) => `${line}\n`).join("");
      const link = document.createElement("a");
      link.href = URL.createObjectURL(new Blob([text], { type: "text/plain" }));
      link.download = { punched: "cards.punch", typed: "typewriter.txt", log: "run.operator" }[what];
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 1000);
    });
})();
