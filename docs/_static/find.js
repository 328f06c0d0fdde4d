// Show the addresses that match the query above the results of the search (modern/publication/site/pages/addresses.py).
"use strict";
(() => {
  const MOST = 8;
  const list = /** @type {HTMLElement} */ (document.getElementById("places"));
  const query = (new URLSearchParams(location.search).get("q") ?? "").toLowerCase();
  // The reader may write “statement 147 of program 3”, “variable KELEQ” or “row P1-039”.
  const words = query.replace(/program (\d)/, "program$1").split(/\s+/)
    .filter((word) => word && !["statement", "card", "variable", "row", "of", "in", "the"].includes(word));
  const program = words.find((word) => /^program\d/.test(word));
  const rest = words.filter((word) => word !== program).join(" ");
  if (!rest) return;
  const rank = (/** @type {[string, string, string]} */ [name, address, description]) => {
    const text = name.toLowerCase();
    if (program && !address.startsWith(`${program}.`)) return 9;
    if (text === rest || `${text}s` === rest || text === `${rest}s`) return 0;
    if (text.startsWith(`${rest} `) || text.startsWith(`${rest}+`)) return 1;
    const whole = `${text} ${description.toLowerCase()}`.split(/[^\w+-]+/);
    return rest.split(" ").every((word) => whole.includes(word)) ? 2 : 9;
  };
  const matches = window.hull1620Places.map((place) => /** @type {const} */ ([rank(place), place])).filter(([order]) => order < 9);
  matches.sort((a, b) => a[0] - b[0]); // the order of the list decides between equal ranks
  for (const [, [name, address, description]] of matches.slice(0, MOST)) {
    const item = document.createElement("li");
    const link = document.createElement("a");
    link.href = address;
    link.textContent = name;
    item.append(link, ` ${description}`);
    list.append(item);
  }
})();
