/* Conveniences; every page can be read without them. A classic script, because modules do not load from the file system. */
(function () {
  "use strict";

  function reveal() {
    var id = decodeURIComponent(location.hash.slice(1)), there = id && document.getElementById(id);
    if (!there) { return; }
    for (var at = /** @type {Element | null} */ (there); at; at = at.parentElement) {
      if (at instanceof HTMLDetailsElement) { at.open = true; }
    }
    var box = there.classList.contains("also-at") ? there.parentElement : there;
    var about = box && box.querySelector(":scope > .about");
    if (about instanceof HTMLDetailsElement) { about.open = true; }
    if (there.classList.contains("row")) { there.scrollIntoView(); }
  }

  /** @param {number} by */
  function step(by) {
    var found = Array.prototype.slice.call(document.querySelectorAll(".card.changed, .card.blanks, .card.ours"));
    if (!found.length) { return; }
    var at = found.findIndex(function (card) { return "#" + card.id === decodeURIComponent(location.hash); });
    if (at < 0) {
      at = found.findIndex(function (card) { return card.getBoundingClientRect().top > 0; });
      at = by > 0 ? at - 1 : at;
    }
    var next = found[(at + by + found.length) % found.length];
    location.hash = next.id;
    next.querySelector("summary").focus({ preventScroll: true });
  }

  /** @param {KeyboardEvent} event */
  function keys(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target instanceof Element && /^(INPUT|TEXTAREA|SELECT)$/.test(event.target.tagName)) { return; }
    if (event.key === "n") { step(1); }
    if (event.key === "p") { step(-1); }
  }

  function finder() {
    const field = document.getElementById("find"), result = document.getElementById("found");
    if (!(field instanceof HTMLInputElement && result)) { return; }
    var lines = Array.prototype.slice.call(document.querySelectorAll("ul.addresses li"));
    var words = lines.map(function (line) { return line.textContent.toLowerCase(); });
    const look = () => {
      var wanted = field.value.toLowerCase().split(/\s+/).filter(Boolean), count = 0;
      lines.forEach(function (line, at) {
        var fits = wanted.every(function (/** @type {string} */ word) { return words[at].indexOf(word) >= 0; });
        line.hidden = !fits;
        count += Number(fits);
      });
      document.querySelectorAll("ul.addresses").forEach(function (list) {
        /** @type {HTMLElement} */ (list.parentElement).hidden = wanted.length > 0 && !list.querySelector("li:not([hidden])");
      });
      result.textContent = wanted.length ? count + " found" : "";
    };
    field.disabled = false;
    field.addEventListener("input", look);
    if (field.form) { field.form.addEventListener("submit", submit); }
    /** @param {Event} event */
    function submit(event) {
      event.preventDefault();
      var first = document.querySelector("ul.addresses li:not([hidden]) a");
      if (first instanceof HTMLAnchorElement) { location.href = first.href; }
    }
    if (location.search.indexOf("?q=") === 0) { field.value = decodeURIComponent(location.search.slice(3).replace(/\+/g, " ")); }
    look();
  }

  /** @param {boolean} open */
  function print(open) {
    document.querySelectorAll(".about").forEach(function (about) {
      if (about instanceof HTMLDetailsElement && about.querySelector(".row")) {
        if (open) { about.dataset.was = about.open ? "1" : ""; about.open = true; } else { about.open = about.dataset.was === "1"; }
      }
    });
  }

  document.addEventListener("keydown", keys);
  window.addEventListener("hashchange", reveal);
  window.addEventListener("beforeprint", function () { print(true); });
  window.addEventListener("afterprint", function () { print(false); });
  if (document.readyState === "loading") { document.addEventListener("DOMContentLoaded", function () { reveal(); finder(); }); } else { reveal(); finder(); }
}());
