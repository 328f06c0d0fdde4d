// What the visitor does at the desk of the emulator, and how the desk begins: with a recorded run while Python loads.
"use strict";

/** The recorded run of example 5. */
const deskTape = (() => {
  const { at, data } = deskPage;
  const button = at("replay", HTMLButtonElement);
  let timer = 0;
  let isChosen = false; // the selectors name the program and the deck of the recorded run

  /** Choose the program and the deck of the recorded run, so that the whole desk shows the same run. */
  function choose() {
    deskChoice.pick("program3", "example5/punched", ["program 3", "example 5, punched by program 1"]);
    isChosen = true;
  }

  /** Leave the choice to the visitor. */
  function release() {
    clearTimeout(timer);
    isChosen = false;
  }

  /** End the recorded run; without a choice of the visitor, program 1 with example 5 is next. */
  function end() {
    if (isChosen) deskChoice.pick("program1_examples", "example5");
    release();
    button.hidden = true;
  }

  function play() {
    end();
    choose();
    deskShow.lay(data.recorded.load);
    let n = 0;
    const next = () => {
      deskShow.render(data.recorded.frames[n]);
      n += 1;
      if (n < data.recorded.frames.length) timer = window.setTimeout(next, 1000 / data.pace);
    };
    next();
  }

  /** Show the end of the run without motion. */
  function still() {
    const { load, frames } = data.recorded;
    const last = frames[frames.length - 1];
    choose();
    deskShow.lay(load);
    deskShow.render({ ...last, picture: frames.findLast(({ picture }) => picture)?.picture });
    offer();
  }

  const offer = () => void (button.hidden = false);
  button.addEventListener("click", play);
  return { play, still, end, release, offer };
})();

(() => {
  const { at, all, desk, say } = deskPage;
  const where = at("where", HTMLInputElement);
  const map = at("core", HTMLCanvasElement);

  /** Handle a form without leaving the page. @param {string} id @param {() => void} action */
  function submitted(id, action) {
    at(id, HTMLFormElement).addEventListener("submit", (event) => {
      event.preventDefault();
      action();
    });
  }

  /** @param {string} id @param {() => void} action */
  const clicked = (id, action) => at(id, HTMLElement).addEventListener("click", action);

  // ---- Programs and decks

  /** @param {FileList | null | undefined} files */
  async function take(files) {
    for (const file of files ?? []) {
      const text = await file.text();
      if (!/^(LOAD|CARDS) /m.test(text)) {
        deskChoice.take(file.name, text);
        deskRun.change();
      } else if (deskRun.isOn) await deskRun.replay(text);
    }
  }

  submitted("choose", () => {
    deskRun.follow(false);
    deskRun.load();
  });
  for (const id of ["program", "deck"]) at(id, HTMLSelectElement).addEventListener("change", deskRun.change);
  clicked("next", () => deskRun.load(true));
  const files = at("files", HTMLInputElement);
  files.addEventListener("change", () => take(files.files));
  desk.addEventListener("dragover", (event) => event.preventDefault());
  desk.addEventListener("drop", (event) => {
    event.preventDefault();
    if (deskRun.isOn) take(event.dataTransfer?.files);
  });
  const punch = keypunch.open({
    check: async (text) => (deskRun.isOn ? deskRun.ask("check", text) : []),
    editable: deskChoice.editable,
    unused: deskChoice.unused,
    use(...cards) {
      deskTape.release();
      deskChoice.keep(...cards);
      deskRun.load();
    },
  });
  clicked("punch-open", () => punch.show(deskShow.loaded?.formats ?? []));

  // ---- The parts of the desk

  for (const button of all(".m-tabs button")) button.addEventListener("click", () => deskRun.view(button.dataset.view ?? ""));
  for (const button of all("[data-look]"))
    button.addEventListener("click", () => {
      for (const other of all("[data-look]")) other.ariaPressed = String(other === button);
      for (const part of all("[data-part]")) part.hidden = part.dataset.part !== button.dataset.look;
      deskShow.core.draw();
      deskRun.look();
    });
  map.addEventListener("click", (event) => deskRun.field(deskShow.core.point(deskShow.core.address(event.clientX, event.clientY))));
  map.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -coreMap.FIELD, ArrowRight: coreMap.FIELD, ArrowUp: -coreMap.ACROSS, ArrowDown: coreMap.ACROSS, Enter: 0 }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    deskRun.field(deskShow.core.point(deskShow.core.cursor + step));
  });

  // ---- The console

  for (const button of all("[data-words]")) button.addEventListener("click", () => deskRun.press(button.dataset.words ?? ""));
  for (const button of all("[data-switch]"))
    button.addEventListener("click", () => {
      const isOn = button.ariaChecked !== "true";
      button.ariaChecked = String(isOn);
      deskRun.turn(button.dataset.switch ?? "", isOn);
    });
  for (const button of deskPage.speeds) button.addEventListener("change", () => deskRun.isOn && deskRun.ask("pace", deskPage.pace()));
  const sound = at("sound", HTMLInputElement);
  sound.addEventListener("change", () => deskSound.turn(sound.checked));
  clicked("back", deskRun.back);
  submitted("jump", () => deskRun.jump(Number(at("statement", HTMLInputElement).value)));
  submitted("break", () => deskRun.isOn && deskRun.act(`BREAK ${where.value}`));
  clicked("clear", () => deskRun.isOn && deskRun.act("CLEAR"));
  submitted("typing", deskRun.type);
  clicked("decide", deskRun.decide);
  const listing = at("listing", HTMLElement);
  listing.addEventListener("click", ({ target }) => {
    const card = target instanceof Element ? target.closest("li") : null;
    if (!card || !deskRun.isOn || !deskRun.isBusy) return;
    deskRun.act(`${card.classList.contains("has-break") ? "CLEAR" : "BREAK"} CARD ${[...listing.children].indexOf(card) + 1}`);
  });

  // ---- Files and links

  const lines = (/** @type {string[]} */ texts) => texts.map((text) => `${text}\n`).join("");
  /** The files that can be saved: their names and their contents. @type {Record<string, [string, () => string | Promise<string>]>} */
  const FILES = {
    punched: ["cards.punch", () => lines(deskShow.punched)],
    typed: ["typewriter.txt", () => lines(deskShow.typed)],
    log: ["session.operator", () => (deskRun.isOn ? deskRun.ask("log") : "")],
  };
  for (const button of all("[data-save]"))
    button.addEventListener("click", async () => {
      const [download, text] = FILES[button.dataset.save ?? ""];
      const href = URL.createObjectURL(new Blob([await text()], { type: "text/plain" }));
      Object.assign(document.createElement("a"), { href, download }).click();
      setTimeout(() => URL.revokeObjectURL(href), 1000);
    });
  clicked("link", async () => {
    history.replaceState(null, "", `#${await deskChoice.link()}`);
    try {
      await navigator.clipboard.writeText(location.href);
      say("The link is in the clipboard and in the address of the page.");
    } catch {
      say("The link is in the address of the page.");
    }
  });

  // ---- The beginning

  /** The moment of the last link. @type {Moment | null} */
  let moment = null;
  let damage = "";

  /** Read the address of the page, and return the moment that it names, or null. */
  async function linked() {
    damage = "";
    try {
      const named = await deskLink.read();
      moment = named ?? moment;
      return named;
    } catch {
      moment = null;
      damage = "The cards in the address of the page are damaged.";
      return null;
    }
  }

  async function begin() {
    await linked();
    // The emulator loads while the first frame of the recorded run is drawn.
    const label = moment ? undefined : "A recorded run of example 5, while the emulator loads";
    const connecting = hull1620.bytes ? deskRun.connect(label) : null;
    if (moment) {
      deskChoice.set(moment);
      deskShow.lay(null);
    } else if (deskPage.STILL) deskTape.still();
    else deskTape.play();
    if (!connecting) {
      deskTape.offer();
      return say("A recorded run of example 5. This site was built without the emulator: run “npm ci --prefix docs/console” and “make edition”.");
    }
    try {
      await connecting;
    } catch (error) {
      deskTape.offer();
      return deskRun.absent(/** @type {Error} */ (error));
    }
    if (moment) await deskRun.open(moment);
    else if (deskRun.wish) await deskRun.load(deskRun.wish === "START");
    else if (damage) say(damage);
    else if (!deskRun.isBusy) await deskRun.load();
  }

  /** Open the moment that the address of the page names. */
  async function follow() {
    const named = await linked();
    if (damage) say(damage);
    else if (named && deskRun.isOn) deskRun.open(named);
    else if (named) {
      deskTape.release();
      deskChoice.set(named);
    }
  }

  // These links need no second start of the emulator.
  for (const link of all(".m-try a"))
    link.addEventListener("click", (event) => {
      event.preventDefault();
      const before = location.hash;
      location.hash = link.getAttribute("href")?.split("?")[1] ?? "";
      if (location.hash === before) follow();
    });
  addEventListener("hashchange", follow);
  begin();
})();
