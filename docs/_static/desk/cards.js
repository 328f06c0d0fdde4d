// Punched cards, drawn on a canvas: 80 columns of 12 rows in the card code of IBM's 026 with FORTRAN's characters.
"use strict";

const punchedCards = (() => {
  /** The rows of each character: 12, 11 and the digits 0 to 9. @type {Map<string, number[]>} */
  const CODE = new Map();
  for (let digit = 0; digit < 10; digit += 1) CODE.set(String(digit), [digit]);
  [..."ABCDEFGHI"].forEach((letter, n) => CODE.set(letter, [12, n + 1]));
  [..."JKLMNOPQR"].forEach((letter, n) => CODE.set(letter, [11, n + 1]));
  [..."STUVWXYZ"].forEach((letter, n) => CODE.set(letter, [0, n + 2]));
  const SPECIAL = { "+": [12], "-": [11], "/": [0, 1], "=": [3, 8], ".": [12, 3, 8], ")": [12, 4, 8], $: [11, 3, 8] };
  for (const [letter, rows] of Object.entries({ ...SPECIAL, "*": [11, 4, 8], ",": [0, 3, 8], "(": [0, 4, 8] }))
    CODE.set(letter, rows);

  /**
   * Draw a card with its text along the top edge.
   * @param {HTMLCanvasElement} canvas
   * @param {string} text
   */
  function draw(canvas, text) {
    const [width, height] = [660, 290];
    canvas.width = width;
    canvas.height = height;
    canvas.setAttribute("aria-label", text.trim() ? `card: ${text.trim()}` : "blank card");
    const pen = canvas.getContext("2d");
    if (!pen) return;
    const style = getComputedStyle(canvas);
    pen.fillStyle = style.getPropertyValue("--m-card");
    pen.strokeStyle = style.getPropertyValue("--m-print");
    pen.lineWidth = 2;
    pen.beginPath();
    for (const [x, y] of [[26, 1], [width - 1, 1], [width - 1, height - 1], [1, height - 1], [1, 26]]) pen.lineTo(x, y);
    pen.closePath();
    pen.fill();
    pen.stroke();
    pen.fillStyle = style.getPropertyValue("--m-print");
    pen.font = "11px monospace";
    const [step, left] = [8, 10];
    const row = (/** @type {number} */ n) => (n === 12 ? 30 : n === 11 ? 51 : 72 + 21 * n);
    [...text.slice(0, 80)].forEach((letter, column) => pen.fillText(letter, left + step * column, 14));
    for (let digit = 0; digit < 10; digit += 1)
      for (let column = 0; column < 80; column += 4) pen.fillText(String(digit), left + step * column, row(digit) + 11);
    pen.fillStyle = style.getPropertyValue("--m-hole");
    [...text.slice(0, 80)].forEach((letter, column) => {
      for (const hole of CODE.get(letter) ?? []) pen.fillRect(left + step * column, row(hole), 5, 14);
    });
  }

  return { draw };
})();
