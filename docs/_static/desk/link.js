// Links that open the desk with a program, a deck, switches, a speed and a statement to stop before.
"use strict";

/**
 * @typedef {object} Moment
 * @property {string | [string, string]} program A built-in name, or the name and the text of a program.
 * @property {string | [string, string]} deck
 * @property {number[]} switches The sense switches that are on.
 * @property {string} speed 1, 10 or 0.
 * @property {string} stop The operands of BREAK, such as "131" or "CARD 24", or empty.
 * @property {boolean} upcase Read lower case as capitals.
 * @property {boolean} next Load the next program when program 1 has ended.
 */

const deskLink = (() => {
  /** Compress a text for an address. @param {string} text */
  async function squeezed(text) {
    const stream = new Blob([text]).stream().pipeThrough(new CompressionStream("deflate-raw"));
    const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
    return btoa(String.fromCharCode(...bytes)).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
  }

  /** @param {string} code */
  async function expanded(code) {
    const bytes = Uint8Array.from(atob(code.replaceAll("-", "+").replaceAll("_", "/")), (letter) => letter.charCodeAt(0));
    return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"))).text();
  }

  /** Return the part of an address after #. @param {Moment} moment */
  async function write({ program, deck, switches, speed, stop, next, upcase }) {
    const parts = new URLSearchParams();
    for (const [key, value] of /** @type {const} */ ([["program", program], ["deck", deck]])) {
      if (typeof value === "string") parts.set(key, value);
      else {
        parts.set(key, value[0]);
        parts.set(`${key}-cards`, await squeezed(value[1]));
      }
    }
    if (switches.length) parts.set("switches", switches.join(""));
    parts.set("speed", speed);
    if (stop) parts.set("stop", stop);
    if (next) parts.set("next", "1");
    if (upcase) parts.set("upcase", "1");
    return parts.toString().replaceAll("%2F", "/");
  }

  /** Return the moment of an address, or null if the address names no program. @returns {Promise<Moment | null>} */
  async function read() {
    const [hash, query] = [location.hash, location.search].map((part) => new URLSearchParams(part.slice(1)));
    const parts = hash.has("program") ? hash : query;
    const text = (/** @type {string} */ key) => parts.get(key) ?? "";
    if (!text("program")) return null;
    const cards = async (/** @type {string} */ key) =>
      parts.has(`${key}-cards`) ? /** @type {[string, string]} */ ([text(key), await expanded(text(`${key}-cards`))]) : text(key);
    const speed = ["1", "10", "0"].includes(text("speed")) ? text("speed") : "10";
    const switches = [...text("switches")].map(Number).filter((n) => n >= 1 && n <= 4);
    return { program: await cards("program"), deck: await cards("deck"), switches, speed, stop: text("stop"), next: text("next") === "1", upcase: text("upcase") === "1" };
  }

  return { write, read };
})();
