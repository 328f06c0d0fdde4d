// The connection of a page with the emulator in its worker (docs/console/worker.js).
"use strict";

/**
 * @typedef {object} Machine
 * @property {(name: string, ...parameters: any[]) => Promise<any>} ask Call a method of the desk in Python.
 * @property {() => void} stop End the worker, for example in an endless compilation.
 */

/** The functions that the scripts of the emulator share. */
const hull1620 = (() => {
  const here = new URL("../../console/", /** @type {HTMLScriptElement} */ (document.currentScript).src).href;
  /** The bytes that a page loads; 0 if the site was built without the emulator. */
  const bytes = window.hull1620Bytes ?? 0;
  const isLocal = location.protocol === "file:";

  /** @param {string} address */
  function script(address) {
    return new Promise((done, failed) => {
      const element = Object.assign(document.createElement("script"), { src: address, onload: done });
      element.onerror = () => failed(new Error(`${address} cannot be loaded`));
      document.head.append(element);
    });
  }

  /** Let the service worker keep the page and the emulator for the next visit; the page works without it. */
  async function keep() {
    if (!navigator.serviceWorker) return;
    try {
      const { installing, waiting } = await navigator.serviceWorker.register(`${here}../cache.js`);
      const starting = installing ?? waiting;
      if (!starting) return;
      await new Promise((done) => {
        starting.addEventListener("statechange", () => starting.state === "activated" && done(null));
        setTimeout(done, 2000);
      });
      // The page itself was loaded before the worker began.
      const parts = performance.getEntriesByType("resource").map(({ name }) => name);
      for (const part of [location.pathname, ...parts]) fetch(part).catch(() => {});
    } catch {
      // A browser may forbid service workers, for example in a private window.
    }
  }

  /** Return the worker and the file of all files in a page without a server, which may load scripts only. */
  async function fromScript() {
    if (!window.hull1620Local) await script(`${here}machine.js`);
    if (!window.hull1620Local) throw new Error("machine.js holds no emulator");
    const { worker, machine } = window.hull1620Local;
    // The browser decodes an address faster than a script does.
    const file = await fetch(`data:application/gzip;base64,${machine}`);
    return { worker, bytes: await file.arrayBuffer() };
  }

  /**
   * Start the emulator.
   * @param {(bytes: number) => void} progress
   * @param {(slice: any) => void} slice
   * @param {(message: string) => void} [trouble] Receives the message of a slice that fails.
   * @returns {Promise<Machine & {offers: any}>}
   */
  async function connect(progress, slice, trouble) {
    const local = isLocal ? await fromScript() : null;
    if (!local) await keep();
    const address = local ? `data:text/javascript,${encodeURIComponent(local.worker)}` : `${here}worker.js`;
    const worker = new Worker(address, { type: "module" });
    /** @type {Map<number, {done: (answer: any) => void, failed: (error: Error) => void}>} */
    const waiting = new Map();
    let count = 0;
    worker.onmessage = ({ data }) => {
      if (data.progress !== undefined) return progress(data.progress);
      if (data.slice) return slice(data.slice);
      if (data.trouble !== undefined) return trouble?.(data.trouble);
      const call = waiting.get(data.id);
      waiting.delete(data.id);
      if (data.failed === undefined) call?.done(data.answer);
      else call?.failed(new Error(data.failed));
    };
    worker.onerror = (event) => {
      for (const call of waiting.values()) call.failed(new Error(event.message || "the emulator cannot be loaded"));
    };
    /** @type {Machine["ask"]} */
    const ask = (name, ...parameters) =>
      new Promise((done, failed) => {
        waiting.set((count += 1), { done, failed });
        worker.postMessage({ id: count, name, parameters });
      });
    const offers = await ask("begin", local ? { bytes: local.bytes } : { address: `${here}machine.gzip?v=${window.hull1620Version}` });
    return { ask, stop: () => worker.terminate(), offers };
  }

  return { bytes, connect };
})();
