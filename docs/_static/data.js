// Filter the statements; without this script the page shows all of them.
"use strict";
for (const form of /** @type {NodeListOf<HTMLFormElement>} */ (document.querySelectorAll("form.filter"))) {
  form.hidden = false;
  const rows = [...document.querySelectorAll(".statements > li")];
  const result = /** @type {HTMLOutputElement} */ (form.querySelector("output"));
  /** @type {any} */
  const controls = form.elements;
  const choose = () => {
    const shown = new Set([...controls.verdict].filter((box) => box.checked).map((box) => box.value));
    const query = controls.words.value.toLowerCase();
    let count = 0;
    for (const row of rows) {
      const visible = shown.has(row.className.split(" ")[0]) && (!query || row.textContent.toLowerCase().includes(query));
      row.classList.toggle("hidden-by-filter", !visible);
      count += Number(visible);
    }
    for (const list of document.querySelectorAll(".statements")) {
      list.classList.add("filtered");
      list.closest("section")?.classList.toggle("nothing-left", !list.querySelector("li:not(.hidden-by-filter)"));
    }
    result.textContent = count === rows.length ? "" : `${count} of ${rows.length} statements`;
  };
  form.addEventListener("input", choose);
  form.addEventListener("submit", (event) => event.preventDefault());
}
