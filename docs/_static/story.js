/* The figures of the home page: one stage at a time, and a slider.  Without this script they are a row and a table. */
(function () {
  "use strict";

  /** @param {string} label @param {() => void} act */
  function button(label, act) {
    var made = document.createElement("button");
    made.type = "button";
    made.textContent = label;
    made.addEventListener("click", act);
    return made;
  }

  /** @param {Element} list */
  function stepper(list) {
    /** @type {HTMLElement[]} */
    var stages = Array.prototype.slice.call(list.children), shown = 0;
    var bar = document.createElement("p"), state = document.createElement("output");
    /** @param {number} number */
    function show(number) {
      shown = Math.max(0, Math.min(stages.length - 1, number));
      stages.forEach(function (stage, at) { stage.hidden = at !== shown; });
      state.textContent = "Stage " + (shown + 1) + " of " + stages.length;
      back.disabled = shown === 0;
      next.disabled = shown === stages.length - 1;
    }
    var back = button("Back", function () { show(shown - 1); });
    var next = button("Next point", function () { show(shown + 1); });
    bar.className = "steps";
    bar.append(back, next, state);
    list.classList.add("single");
    list.before(bar);
    show(0);
  }

  /** @param {HTMLElement} box */
  function slider(box) {
    var rows = JSON.parse(box.dataset.rows || ""), label = document.createElement("label");
    var input = document.createElement("input"), result = document.createElement("output");
    input.type = "range";
    input.min = "0";
    input.max = String(rows.length - 1);
    input.value = "60";
    label.append("x of the first point (move it to the right) ", input);
    function show() {
      var row = rows[Number(input.value)], values = row.slice(3), zero = values.every(function (/** @type {string} */ value) { return value === "0"; });
      input.setAttribute("aria-valuetext", row[0]);
      result.innerHTML = "";
      [["x", row[0]], ["D, exactly", row[1]], ["D in eight digits", row[2]], ["the plane at its own points", values.join(", ")]]
        .forEach(function (pair) {
          var line = document.createElement("span"), name = document.createElement("span"), value = document.createElement("b");
          name.textContent = pair[0];
          value.textContent = pair[1];
          line.append(name, value);
          result.append(line);
        });
      var verdict = document.createElement("strong");
      verdict.textContent = zero ? "All three are zero. The program continues." : "DATA NOT ACCEPTABLE";
      verdict.className = zero ? "fits" : "misses";
      result.append(verdict);
    }
    input.addEventListener("input", show);
    box.replaceChildren(label, result);
    show();
  }

  document.querySelectorAll("ol.stepper").forEach(stepper);
  /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("div.slider")).forEach(slider);
})();
