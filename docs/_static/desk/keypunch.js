// The keypunch: cards are written below a ruler of 80 columns, and the compiler's messages stand beside their cards.
"use strict";

/**
 * @typedef {object} Punching
 * @property {(text: string) => Promise<[number, number, string][]>} check Return the messages of the compiler.
 * @property {(what: "programs" | "decks", name: string, text: string) => void} use Put the cards into the machine.
 */

const keypunch = (() => {
  const at = (/** @type {string} */ id) => /** @type {any} */ (document.getElementById(`punch-${id}`));
  const COLUMNS = 80;
  const SAMPLE = { programs: "      TYPE 5\n    5 FORMAT(5HHELLO)\n      END\n", decks: "" };
  /** The fields of a program card (C26-5619 p. 6). @type {Field[]} */
  const PROGRAM = [["label", 1, 5], ["+", 6, 1], ["statement", 7, 66], ["unused", 73, 8]];

  /**
   * Return the ruler: tens, units, and the fields.
   * @param {Field[]} fields
   * @param {number} [columns]
   */
  function ruler(fields, columns = COLUMNS) {
    const digits = Array.from({ length: columns }, (_, n) => n + 1);
    const marks = Array(columns).fill(" ");
    for (const [name, first, width] of fields) {
      const label = name.slice(0, width).padEnd(width, "-");
      [...label].forEach((letter, n) => (marks[first - 1 + n] = letter));
    }
    const tens = digits.map((n) => (n % 10 ? " " : String(n / 10))).join("");
    return [tens, digits.map((n) => n % 10).join(""), marks.join("")].join("\n");
  }

  /**
   * Put the numbers of a line into the fields of its FORMAT, at their right ends.
   * The line stays as it is if it fills the record, or if its numbers are not as many as the fields or too long.
   * @param {string} line
   * @param {Field[]} fields
   */
  function aligned(line, fields) {
    const numbers = line.trim().split(/[\s,]+/);
    const last = fields.at(-1);
    if (!last || line.length >= last[1] + last[2] - 1 || numbers.length > fields.length || !line.trim()) return line;
    if (numbers.some((number, n) => number.length > fields[n][2])) return line;
    return numbers.reduce((text, number, n) => text.padEnd(fields[n][1] + fields[n][2] - 1 - number.length) + number, "");
  }

  /** @param {Punching} punching */
  function open(punching) {
    const dialog = /** @type {HTMLDialogElement} */ (document.getElementById("desk-keypunch"));
    /** @type {[string, Field[]][]} */
    let formats = [];
    let late = 0;

    function rule() {
      const isProgram = at("what").value === "programs";
      at("forms").hidden = isProgram || !formats.length;
      at("ruler").textContent = ruler(isProgram ? PROGRAM : (formats[at("format").value]?.[1] ?? []));
    }

    async function check() {
      const lines = at("text").value.split("\n");
      const long = lines.findIndex((/** @type {string} */ line) => line.length > COLUMNS);
      at("messages").replaceChildren();
      /** @type {[number, number, string][]} */
      let messages = long < 0 ? [] : [[long + 1, COLUMNS + 1, "a card has 80 columns"]];
      if (long < 0 && at("what").value === "programs") messages = await punching.check(at("text").value);
      const rows = lines.map(() => document.createElement("li"));
      for (const [card, column, message] of messages) {
        const row = rows[Math.max(card, 1) - 1];
        if (row) row.textContent += `${row.textContent ? "; " : ""}${column ? `column ${column}: ` : ""}${message}`;
      }
      at("messages").replaceChildren(...rows);
      at("state").textContent = messages.length ? `${messages.length} ${messages.length > 1 ? "errors" : "error"}` : "No errors.";
    }

    /** @param {"programs" | "decks"} what @param {string} name @param {string} text @param {[string, Field[]][]} forms */
    function show(what, name, text, forms) {
      at("what").value = what;
      at("name").value = name;
      at("text").value = text || SAMPLE[what];
      formats = forms;
      at("format").replaceChildren(...formats.map(([title], n) => new Option(title, String(n))));
      rule();
      dialog.showModal();
      check();
    }

    at("text").addEventListener("input", () => {
      clearTimeout(late);
      late = setTimeout(check, 500);
    });
    at("text").addEventListener("scroll", () => {
      at("messages").scrollTop = at("text").scrollTop;
      at("ruler").scrollLeft = at("text").scrollLeft;
    });
    at("what").addEventListener("change", () => {
      at("name").value = at("name").value.replace(/(\.\w+)?$/, at("what").value === "programs" ? ".f" : ".deck");
      rule();
      check();
    });
    at("format").addEventListener("change", rule);
    at("close").addEventListener("click", () => dialog.close());
    at("use").addEventListener("click", () => {
      punching.use(at("what").value, at("name").value.trim() || "mine", at("text").value);
      dialog.close();
    });
    return { show };
  }

  return { open, ruler, aligned };
})();
