// The map of core storage: each of the 40,000 digits has the same area. Statements and fields are modelled, not instructions.
"use strict";

const coreMap = (() => {
  const ACROSS = 250;
  const FIELD = 10;
  const NAMES = 120; // positions above the data
  /** Red, green, blue of each kind of region in the light theme. @type {Record<string, number[]>} */
  const COLOURS = { system: [148, 144, 136], program: [120, 142, 168], free: [236, 233, 224], array: [226, 208, 160] };
  const [SINGLE, HELD, WRITTEN, READ] = [[214, 190, 176], [150, 96, 40], [196, 40, 20], [60, 120, 60]];

  /** @param {HTMLCanvasElement} canvas */
  function make(canvas) {
    let size = 40000;
    /** @type {[string, string, number, number][]} */
    let regions = [];
    /** The kind of each digit, and the brightness of the last write, from 1 down to 0. */
    let base = new Uint8ClampedArray(0);
    let heat = new Float32Array(0);
    let held = new Uint8Array(0);
    /** @type {string[]} */
    let reading = [];
    let cursor = -1;

    /** @param {{size: number, regions: [string, string, number, number][]}} map */
    function load(map) {
      ({ size, regions } = map);
      base = new Uint8ClampedArray(size * 3);
      heat = new Float32Array(size);
      held = new Uint8Array(size);
      reading = [];
      for (const [, kind, first, last] of regions)
        for (let digit = first; digit <= last; digit += 1) base.set(COLOURS[kind] ?? SINGLE, digit * 3);
      canvas.width = ACROSS;
      canvas.height = Math.ceil(size / ACROSS);
      draw();
    }

    /** Mark fields as written, and the variables that the present card reads. */
    function touch(/** @type {number[]} */ fields, /** @type {string[]} */ names) {
      for (let digit = 0; digit < size; digit += 1) heat[digit] *= 0.7;
      for (const field of fields) {
        const first = size - NAMES - FIELD * (field + 1);
        heat.fill(1, first, first + FIELD);
        held.fill(1, first, first + FIELD);
      }
      reading = names;
      draw();
    }

    function draw() {
      const pen = canvas.getContext("2d");
      if (!pen || !size || !canvas.offsetParent) return;
      const image = pen.createImageData(canvas.width, canvas.height);
      const read = new Uint8Array(size);
      for (const [name, , first, last] of regions) if (reading.includes(name)) read.fill(1, first, last + 1);
      for (let digit = 0; digit < size; digit += 1) {
        const mix = heat[digit];
        for (let k = 0; k < 3; k += 1) {
          const plain = read[digit] ? (base[digit * 3 + k] + READ[k]) / 2 : base[digit * 3 + k];
          const below = held[digit] ? (plain + HELD[k]) / 2 : plain;
          image.data[digit * 4 + k] = below * (1 - mix) + WRITTEN[k] * mix;
        }
        image.data[digit * 4 + 3] = 255;
      }
      for (let k = 0; cursor >= 0 && k < FIELD; k += 1) image.data.set([0, 0, 0, 255], (cursor - (cursor % FIELD) + k) * 4);
      pen.putImageData(image, 0, 0);
    }

    /** The address at a place of the canvas. @param {number} x @param {number} y */
    const address = (x, y) => {
      const box = canvas.getBoundingClientRect();
      const row = Math.floor(((y - box.top) / box.height) * canvas.height);
      return row * ACROSS + Math.floor(((x - box.left) / box.width) * ACROSS);
    };

    /** @param {number} digit */
    const region = (digit) => regions.find(([, , first, last]) => first <= digit && digit <= last);

    /** @param {number} digit */
    function point(digit) {
      cursor = Math.min(Math.max(digit, 0), size - 1);
      draw();
      return cursor;
    }

    return { load, touch, address, region, point, draw, get cursor() { return cursor; } };
  }

  return { make, ACROSS, FIELD };
})();
