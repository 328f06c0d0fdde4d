// The choice of statements shown; without this script all are.
"use strict";
for (const form of document.querySelectorAll("form.filter")) {
  form.hidden = false;
  const rows = [...document.querySelectorAll(".statements > li")];
  const said = form.querySelector("output");
  const choose = () => {
    const shown = new Set([...form.elements.verdict].filter((box) => box.checked).map((box) => box.value));
    const words = form.elements.words.value.toLowerCase();
    let count = 0;
    for (const row of rows) {
      const here = shown.has(row.className.split(" ")[0]) && (!words || row.textContent.toLowerCase().includes(words));
      row.classList.toggle("hidden-by-filter", !here);
      count += here;
    }
    for (const list of document.querySelectorAll(".statements")) {
      list.classList.add("filtered");
      list.closest("section").classList.toggle("nothing-left", !list.querySelector("li:not(.hidden-by-filter)"));
    }
    said.textContent = count === rows.length ? "" : `${count} of ${rows.length} statements`;
  };
  form.addEventListener("input", choose);
  form.addEventListener("submit", (event) => event.preventDefault());
}
