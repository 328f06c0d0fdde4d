// The keypunch: cards are written below a ruler of 80 columns, and the compiler's messages stand beside their cards.
"use strict";

/**
 * @typedef {object} Punching
 * @property {(text: string) => Promise<[number, number, string][]>} check Return the messages of the compiler.
 * @property {(what: What, name: string, text: string, isNew: boolean) => void} use Put the cards into the machine.
 * @property {(what: What) => [string, string] | null} editable Return the name and the cards of the visitor's choice.
 * @property {(what: What) => string} unused Return a name for new cards.
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
    let isNew = false;
    /** The cards that are being written, for each kind. @type {Map<What, [string, string, boolean]>} */
    const drafts = new Map();

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

    /** Put cards on the sheet. @param {string} name @param {string} text @param {boolean} areNew */
    function fill(name, text, areNew) {
      at("name").value = name;
      at("text").value = text;
      isNew = areNew;
      rule();
      check();
    }

    /** Begin new cards with an example. */
    const begin = () => fill(punching.unused(at("what").value), SAMPLE[/** @type {What} */ (at("what").value)], true);

    /** Continue with the cards of the chosen kind, with the visitor's choice, or with new cards. */
    function change() {
      const draft = drafts.get(at("what").value);
      const cards = punching.editable(at("what").value);
      if (draft) fill(...draft);
      else if (cards) fill(...cards, false);
      else begin();
    }

    /** @param {[string, Field[]][]} forms */
    function show(forms) {
      formats = forms;
      at("format").replaceChildren(...formats.map(([title], n) => new Option(title, String(n))));
      drafts.clear();
      at("what").value = "programs";
      change();
      dialog.showModal();
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
      const before = at("what").value === "programs" ? "decks" : "programs";
      drafts.set(before, [at("name").value, at("text").value, isNew]);
      change();
    });
    at("new").addEventListener("click", () => {
      begin();
      at("text").focus();
    });
    at("format").addEventListener("change", rule);
    at("close").addEventListener("click", () => dialog.close());
    at("use").addEventListener("click", () => {
      const name = at("name").value.trim().replace(/\s+/g, "-") || punching.unused(at("what").value);
      punching.use(at("what").value, name, at("text").value, isNew);
      dialog.close();
    });
    return { show };
  }

  return { open, ruler, aligned };
})();
