// Return a list of problems in the layout of the page: texts that overlap or are clipped, and empty boxes.
(open) => {
  if (open) for (const details of document.querySelectorAll("details")) details.open = true;
  const problems = [];
  const shown = (text) => text.trim().replace(/\s+/g, " ").slice(0, 40);
  const known = new Map();
  // The area in which an element is visible, the element that scrolls over the page with it, and whether text may leave it.
  const surroundings = (element) => {
    if (element === document.documentElement) return { left: -1e6, right: 1e6, top: -1e6, bottom: 1e6, layer: null, hides: false };
    if (known.has(element)) return known.get(element);
    const outer = surroundings(element.parentElement);
    const style = getComputedStyle(element);
    let result = outer;
    if (["fixed", "sticky"].includes(style.position)) result = { ...result, layer: element };
    if (style.overflowX !== "visible" && element !== document.body && !(element instanceof SVGElement)) {
      const box = element.getBoundingClientRect();
      result = {
        ...result,
        left: Math.max(result.left, box.left), right: Math.min(result.right, box.right),
        top: Math.max(result.top, box.top), bottom: Math.min(result.bottom, box.bottom),
        hides: style.overflowX !== "auto" && style.overflowX !== "scroll",
      };
    }
    known.set(element, result);
    return result;
  };
  const boxes = [], letters = [];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  const range = document.createRange();
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const parent = node.parentElement;
    if (!node.data.trim() || parent.closest("script, style, noscript, option, textarea, title, desc, .sr, .skip-to-content")) continue;
    if (!parent.checkVisibility({ checkOpacity: true, checkVisibilityCSS: true })) continue;
    const area = surroundings(parent);
    range.selectNodeContents(node);
    // The digits that are printed on a card are small.
    const scale = parent instanceof SVGElement ? Math.hypot(parent.getScreenCTM().a, parent.getScreenCTM().b) : 1;
    if (!parent.closest(".punched")) letters.push({ size: parseFloat(getComputedStyle(parent).fontSize) * scale * 0.75, node });
    for (const { left, right, top, bottom } of range.getClientRects()) {
      if (right - left < 2) continue;
      if (right <= area.left || left >= area.right || bottom <= area.top || top >= area.bottom) {
        if (area.hides) problems.push(`hidden: “${shown(node.data)}”`);
        continue;
      }
      if (area.hides && (left < area.left - 2 || right > area.right + 2)) problems.push(`clipped: “${shown(node.data)}”`);
      if (!area.layer && right > document.documentElement.clientWidth + 1 && area.right > 1e5)
        problems.push(`beyond the window: “${shown(node.data)}”`);
      // Letters rarely fill the line box, so its middle represents them.
      const margin = (bottom - top) / 4;
      boxes.push({
        left: Math.max(left, area.left) + 1, right: Math.min(right, area.right) - 1,
        top: Math.max(top + margin, area.top), bottom: Math.min(bottom - margin, area.bottom), node, layer: area.layer,
      });
    }
  }
  boxes.sort((a, b) => a.top - b.top);
  let active = [];
  for (const box of boxes) {
    active = active.filter((before) => before.bottom > box.top + 1);
    for (const before of active)
      if (before.node !== box.node && before.layer === box.layer && before.left < box.right - 1 && box.left < before.right - 1)
        problems.push(`overlap: “${shown(before.node.data)}” and “${shown(box.node.data)}”`);
    active.push(box);
  }
  for (const element of document.querySelectorAll("article :is(p, li, h1, h2, h3, h4, figure, figcaption, dt, summary, pre, caption)"))
    // A card may be blank.
    if (!element.closest("td, th, .desk-cards") && element.checkVisibility() && element.getClientRects().length && !element.textContent.trim() && !element.querySelector("svg, img, input, button, progress, canvas"))
      problems.push(`empty: ${element.outerHTML.slice(0, 80)}`);
  for (const table of document.querySelectorAll(".wide, .table-wrapper"))
    if (table.scrollWidth > table.clientWidth + 1) problems.push(`scrolls sideways: “${shown(table.textContent)}”`);
  if (document.documentElement.scrollWidth > document.documentElement.clientWidth + 1) problems.push("beyond the window: the page scrolls sideways");
  // The triangle of a summary is no text: a summary beside a card must not be higher than the card.
  for (const summary of document.querySelectorAll(".card > .about > summary"))
    if (summary.getBoundingClientRect().bottom > summary.closest(".card").getBoundingClientRect().bottom + 6 && !summary.parentElement.open)
      problems.push(`overlap: “${shown(summary.textContent)}” and the next card`);
  if (matchMedia("print").matches)
    for (const { size, node } of letters)
      if (size < 6.4) problems.push(`letters of ${size.toFixed(1)} points: “${shown(node.data)}”`);
  for (const control of document.querySelectorAll("article :is(select, textarea, input)"))
    if (control.checkVisibility() && control.getBoundingClientRect().right > control.closest("form, p, div").getBoundingClientRect().right + 1)
      problems.push(`beyond its column: “${control.id}”`);
  return [...new Set(problems)];
}
