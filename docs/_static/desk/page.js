// The parts of the desk that need no knowledge of the machine: its elements, its lists, paper, cards and lamps.
"use strict";

const deskPage = (() => {
  const SHOWN = 2000; // the number of lines and cards that the page shows; saved files are complete
  const STILL = matchMedia("(prefers-reduced-motion: reduce)").matches;
  const desk = at("", HTMLElement);

  /**
   * Return an element of the desk.
   * @template {Element} T
   * @param {string} id The id without its first part, "desk-".
   * @param {new () => T} kind
   * @returns {T}
   */
  function at(id, kind) {
    const element = document.getElementById(id ? `desk-${id}` : "desk");
    if (!(element instanceof kind)) throw new Error(`#desk-${id} is missing`);
    return element;
  }

  /** Return the elements of the desk that match a selector. @param {string} selector */
  const all = (selector) => /** @type {HTMLElement[]} */ ([...desk.querySelectorAll(selector)]);

  /** @type {DeskData} */
  const data = JSON.parse(at("data", HTMLScriptElement).textContent ?? "");
  const speeds = /** @type {NodeListOf<HTMLInputElement>} */ (desk.querySelectorAll("[name=desk-speed]"));
  /** The speed relative to the 1620; 0 means at once. */
  const pace = () => Number([...speeds].find(({ checked }) => checked)?.value ?? 10);
  const moves = () => !STILL && pace() > 0;
  /** The numbers of the sense switches that are on. */
  const switches = () => all("[data-switch]").filter(({ ariaChecked }) => ariaChecked === "true").map(({ dataset }) => Number(dataset.switch));

  /** Turn the sense switches to the given positions. @param {(number: number) => boolean} isOn */
  function turn(isOn) {
    for (const button of all("[data-switch]")) button.ariaChecked = String(isOn(Number(button.dataset.switch)));
  }

  /** @param {string} text */
  function say(text) {
    at("state", HTMLElement).textContent = text;
  }

  /** Show a state of the machine, by which the style and the tests know it. @param {string} name */
  function enter(name) {
    desk.dataset.state = name;
  }

  /** @param {string} text */
  function row(text) {
    return Object.assign(document.createElement("li"), { textContent: text || " " });
  }

  /** Scroll a list so that an element is in its middle. @param {HTMLElement} list @param {Element | undefined} element */
  function centre(list, element) {
    if (element instanceof HTMLElement) list.scrollTop = element.offsetTop - list.clientHeight / 2 + element.offsetHeight / 2;
  }

  // A list that was hidden, or becomes smaller, shows its last row or its highlighted one again.
  const resized = new ResizeObserver((entries) => {
    for (const { target } of entries) {
      const list = /** @type {HTMLElement} */ (target);
      if (["desk-paper", "desk-stacker"].includes(list.id)) list.scrollTop = list.scrollHeight;
      else centre(list, list.querySelector("[aria-current]") ?? undefined);
    }
  });
  for (const id of ["paper", "stacker", "listing", "hopper"]) resized.observe(at(id, HTMLElement));

  /** Add rows to the end of a list or of the paper, and show the last ones. @param {HTMLElement} list @param {Element[]} rows */
  function extend(list, rows) {
    list.append(...rows);
    while (list.children.length > SHOWN) list.firstElementChild?.remove();
    if (rows.length) list.scrollTop = list.scrollHeight;
  }

  /** Add lines to the typewriter's paper. @param {string[]} lines @param {"typed" | "note"} kind @param {boolean} [isNew] */
  function paper(lines, kind, isNew = true) {
    const rows = lines.map((line) => {
      const element = Object.assign(document.createElement("span"), { className: `desk-${kind}`, textContent: line });
      const seconds = line.length / 10 / pace();
      if (isNew && kind === "typed" && moves() && seconds > 0.08) {
        element.style.animation = `m-type ${seconds}s steps(${Math.max(line.length, 1)})`;
        element.classList.add("is-typing");
      }
      return element;
    });
    extend(at("paper", HTMLElement), rows);
  }

  /** Draw a card and let it slide in. @param {string} canvas @param {string} text */
  function slide(canvas, text) {
    const card = at(canvas, HTMLCanvasElement);
    punchedCards.draw(card, text);
    if (moves()) card.animate([{ transform: "translateX(-12%)", opacity: 0.4 }, { transform: "none", opacity: 1 }], { duration: Math.min(240, 480 / pace()), easing: "ease-out" });
  }

  const counted = (/** @type {number} */ count) => `${count} ${count === 1 ? "card" : "cards"}`;

  /** Show the cards that the punch has stacked. @param {string[]} cards @param {number} count */
  function stack(cards, count) {
    extend(at("stacker", HTMLElement), cards.slice(-SHOWN).map(row));
    at("punched", HTMLElement).textContent = counted(count);
  }

  /** Mark the cards that have been read. @param {number} count */
  function read(count) {
    const list = at("hopper", HTMLElement);
    [...list.children].forEach((element, n) => element.classList.toggle("desk-read", n < count));
    list.querySelector("[aria-current]")?.removeAttribute("aria-current");
    list.children[count]?.setAttribute("aria-current", "true");
    centre(list, list.children[Math.min(count, list.children.length - 1)]);
    at("read", HTMLElement).textContent = list.children.length ? `${count} of ${counted(list.children.length)}` : "empty";
  }

  let settling = 0;

  /**
   * Turn the lamps on that name the state of the machine, and for a moment those of the devices that it has just used.
   * @param {string[]} names
   * @param {string[]} [devices]
   */
  function lamps(names, devices = []) {
    clearTimeout(settling);
    for (const lamp of all("[data-lamp]")) lamp.classList.toggle("is-on", [...names, ...devices].includes(lamp.dataset.lamp ?? ""));
    if (devices.length) settling = window.setTimeout(() => lamps(names), 600);
  }

  /** Sound the devices, each for the time that it takes at the present speed. @param {Record<"type" | "read" | "punch", string[]>} texts */
  function sound({ type, read: taken, punch }) {
    const seconds = pace() ? Math.max(0.04, 0.4 / pace()) : 0.04;
    const letters = type.join(" ").length;
    if (letters) deskSound.strike("type", letters, letters / 10 / (pace() || 100));
    if (taken.length) deskSound.strike("read", taken.length, seconds);
    if (punch.length) deskSound.strike("punch", punch.length, seconds);
  }

  return { desk, at, all, data, STILL, speeds, pace, moves, switches, turn, say, enter, row, centre, paper, counted, slide, stack, read, lamps, sound };
})();
