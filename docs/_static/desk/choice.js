// The choice of a program and a deck: those that are built in, those of the visitor, and those of a link.
"use strict";

const deskChoice = (() => {
  const { at, data } = deskPage;
  const SELECTS = { programs: at("program", HTMLSelectElement), decks: at("deck", HTMLSelectElement) };
  const upcase = at("upcase", HTMLInputElement);
  const where = at("where", HTMLInputElement);
  /** The deck that fits each kind of program. @type {Record<string, string>} */
  const FITS = { points: "example5", plane: "example4/punched", space: "example5/punched" };
  const PUNCHED = "PUNCHED";
  /** The visitor's programs and decks by name. @type {Record<What, Map<string, string>>} */
  const own = { programs: new Map(), decks: new Map() };
  /** What each program or deck is for: a kind of points, or the stem of a file. @type {Map<string, string>} */
  const kinds = new Map();

  /** @param {What} what @param {string} name @param {string} title @param {string} [kind] */
  function option(what, name, title, kind = "") {
    const select = SELECTS[what];
    if (kind) kinds.set(`${what} ${name}`, kind);
    const offered = [...select.options].find((element) => element.value === name);
    if (!offered) select.add(new Option(title, name));
    else if (title !== name) offered.text = title;
  }

  /** Return a choice: a built-in name, or the name and the cards. @param {What} what @returns {string | [string, string]} */
  function chosen(what) {
    const name = SELECTS[what].value;
    const cards = own[what].get(name);
    return cards === undefined ? name : [name, cards];
  }

  /** @param {Offers} offers */
  function offer(offers) {
    for (const what of /** @type {const} */ (["programs", "decks"]))
      for (const [name, title, kind] of offers[what]) option(what, name, title, kind);
  }

  /** Add a program or a deck of the visitor and choose it. @param {What} what @param {string} name @param {string} text @param {string} [title] */
  function add(what, name, text, title = name) {
    own[what].set(name, text);
    option(what, name, title, name.replace(/\.\w+$/, ""));
    SELECTS[what].value = name;
  }

  /** Choose a built-in program and a deck. @param {string} program @param {string} deck @param {string[]} [titles] */
  function pick(program, deck, titles = [program, deck]) {
    option("programs", program, titles[0]);
    option("decks", deck, titles[1]);
    [SELECTS.programs.value, SELECTS.decks.value] = [program, deck];
  }

  /** Return a name that no cards have. @param {What} what @param {string} [stem] */
  function unused(what, stem = "mine") {
    const name = (/** @type {number} */ n) => `${stem}${n > 1 ? n : ""}.${what === "programs" ? "f" : "deck"}`;
    let n = 1;
    while (own[what].has(name(n))) n += 1;
    return name(n);
  }

  /**
   * Choose cards from the keypunch. The period programs are not overwritten; their changed cards get another name.
   * @param {What} what
   * @param {string} name
   * @param {string} text
   * @param {boolean} isNew Choose a deck that fits a new program.
   */
  function keep(what, name, text, isNew) {
    const isSample = name in data.period && data.period[name] !== text;
    add(what, isSample ? unused(what, name.replace(/\.\w+$/, "")) : name, text);
    if (isNew && what === "programs") fit();
  }

  /** Read a file of the visitor as a program or a deck. @param {string} name @param {string} text */
  function take(name, text) {
    const isProgram = /\.(f|for|ftn|f77)$/i.test(name) || /^\s{6,}[A-Z]|^C /m.test(text.slice(0, 400));
    add(isProgram ? "programs" : "decks", name, text);
  }

  /** Choose a deck that fits the program. */
  function fit() {
    const program = SELECTS.programs.value;
    const kind = kinds.get(`programs ${program}`) ?? "";
    if (kinds.get(`decks ${SELECTS.decks.value}`) !== kind)
      SELECTS.decks.value = FITS[kind] ?? [...own.decks.keys()].find((name) => kinds.get(`decks ${name}`) === kind) ?? "";
  }

  /** Choose a second program and the cards that the first has punched. @param {string} program */
  function choosePunched(program) {
    option("decks", PUNCHED, "the cards punched last", program === "program2" ? "plane" : "space");
    SELECTS.programs.value = program;
    SELECTS.decks.value = PUNCHED;
  }

  /** Choose what a link names. @param {Moment} moment */
  function set(moment) {
    for (const [what, value] of /** @type {const} */ ([["programs", moment.program], ["decks", moment.deck]])) {
      if (typeof value === "string") {
        option(what, value, value);
        SELECTS[what].value = value;
      } else add(what, value[0], value[1]);
    }
    deskPage.turn((number) => moment.switches.includes(number));
    for (const button of deskPage.speeds) button.checked = button.value === moment.speed;
    where.value = moment.stop;
    upcase.checked = moment.upcase;
  }

  /** Return the program and the deck that a load requests. */
  const request = () => ({ program: chosen("programs"), deck: chosen("decks"), switches: deskPage.switches(), upcase: upcase.checked });

  /** Return the names of the choice. */
  const names = () => `${SELECTS.programs.value} with ${SELECTS.decks.value || "no deck"}`;

  /** Return the part of an address that makes the same choice. */
  const link = () => deskLink.write({ ...request(), speed: String(deskPage.pace()), stop: where.value, next: false });

  /** Return the chosen cards to edit, a period program under another name, or null. @param {What} what @returns {[string, string] | null} */
  function editable(what) {
    const name = SELECTS[what].value;
    const cards = own[what].get(name);
    if (cards === undefined) return null;
    return [name in data.period ? unused(what, name.replace(/\.\w+$/, "")) : name, cards];
  }

  for (const [name, text] of Object.entries(data.period)) add(name.endsWith(".f") ? "programs" : "decks", name, text, `${name}, in the style of the period`);
  option("decks", "", "no deck");
  option("programs", "program1_examples", "program 1 in the state that produced the examples", "points");
  option("decks", "example5", "example 5 of chapter 6", "points");
  pick("program1_examples", "example5");
  SELECTS.programs.addEventListener("change", fit);
  return { offer, pick, take, choosePunched, set, request, names, link, keep, editable, unused };
})();
