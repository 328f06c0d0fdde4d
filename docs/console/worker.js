// The emulator in a worker: Python with this project's package, run in slices between the messages of the page.
// In: {id, name, parameters}, a method of the Desk or a handler below. Out: {id, answer} for each, {slice} after each
// slice of a run, {trouble} if a slice fails, {progress} while loading.
"use strict";

const SLICE = 40; // milliseconds between two checks for messages
/** @type {(name: string, ...parameters: any[]) => any} */
let desk;
let pace = 10; // speed relative to the 1620; 0 means at once
let turn = 0; // counts loads and jumps, so that a slice planned before does nothing
let planned = false;
let live = false; // a program is loaded and has not ended
let isDue = false; // the first slice follows the answer at once, so that no action can come before it
let before = 0; // seconds on the 1620 at the end of the previous slice

/** Where the file of all files is: its bytes if the page has no server, or its address with the version. @typedef {{bytes?: ArrayBuffer, address?: string}} Place */

/** Read the file of all files. @param {Place} place */
async function unpack({ bytes, address = "" }) {
  let loaded = 0;
  const source = bytes ? new Blob([bytes]).stream() : await answered(address);
  const counted = new TransformStream({
    transform(chunk, out) {
      loaded += chunk.byteLength;
      postMessage({ progress: loaded });
      out.enqueue(chunk);
    },
  });
  const data = await new Response(source.pipeThrough(counted).pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
  const length = new DataView(data).getUint32(0, true);
  const index = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length)));
  /** @type {Record<string, Uint8Array<ArrayBuffer>>} */
  const files = {};
  let at = 4 + length;
  for (const [name, size] of Object.entries(/** @type {Record<string, number>} */ (index))) {
    files[name] = new Uint8Array(data, at, size);
    at += size;
  }
  return files;
}

/** @param {string} address */
async function answered(address) {
  const response = await fetch(address);
  if (!response.ok || !response.body) throw new Error(`${address}: ${response.status} ${response.statusText}`);
  return response.body;
}

/** Start Python with the project. @param {Place} where */
async function begin(where) {
  const files = await unpack(where);
  const script = (/** @type {string} */ name) => import(URL.createObjectURL(new Blob([files[name]], { type: "text/javascript" })));
  // Pyodide fetches its other files by name.
  /** @type {Record<string, string>} */
  const types = { wasm: "application/wasm", zip: "application/zip" };
  self.fetch = async (request) => {
    const name = String(request instanceof Request ? request.url : request).replace(/.*\//, "");
    return new Response(files[name], { headers: { "content-type": types[name.replace(/.*\./, "")] } });
  };
  const { loadPyodide } = await script("pyodide.mjs");
  const python = await loadPyodide({
    indexURL: "https://files/",
    lockFileContents: new TextDecoder().decode(files["lock.json"]),
    packageBaseUrl: "https://files/",
    createPyodideModule: (await script("pyodide.asm.mjs")).default,
  });
  for (const [name, content] of Object.entries(files)) {
    if (!name.startsWith("packages/")) continue;
    python.FS.mkdirTree(`/${name.slice(0, name.lastIndexOf("/"))}`);
    python.FS.writeFile(`/${name}`, content);
  }
  python.runPython(`
import sys, json
sys.path.insert(0, "/packages")
from modern.publication.desk import Desk
desk = Desk()
def ask(name, arguments):
    if name == "part":
        from modern.publication.parting import parted as function
    else:
        function = getattr(desk, name)
    return json.dumps(function(*json.loads(arguments)))
`);
  const ask = python.globals.get("ask");
  desk = (name, ...parameters) => JSON.parse(ask(name, JSON.stringify(parameters)));
  // The first compilation builds the tables of the parser: do it while the visitor reads, unless a request comes first.
  setTimeout(() => turn || desk("check", "      END\n"), 200);
  return desk("offers");
}

function plan(delay = 0) {
  if (planned) return;
  planned = true;
  const current = turn;
  setTimeout(() => {
    if (current !== turn) return;
    planned = false;
    slice();
  }, delay);
}

/** Return the last line of an error, which names it. @param {unknown} error */
const message = (error) => (error instanceof Error ? error.message : String(error)).trim().split("\n").at(-1);

function slice() {
  const began = performance.now();
  /** @type {{seconds: number, ended: boolean, waits: string}} */
  let answer;
  try {
    answer = desk("run", SLICE, pace);
  } catch (error) {
    live = false;
    return postMessage({ trouble: message(error) });
  }
  if (answer.ended) live = false;
  postMessage({ slice: answer });
  if (answer.ended || answer.waits) return;
  const delay = pace ? ((answer.seconds - before) / pace) * 1000 - (performance.now() - began) : 0;
  before = answer.seconds;
  plan(Math.min(Math.max(delay, 0), 500));
}

/** Call a method that puts the machine into another state. @param {string} name @param {any[]} parameters */
function restart(name, ...parameters) {
  turn += 1;
  planned = false;
  before = 0;
  return desk(name, ...parameters);
}

/** Call a method that loads a program, which then runs. @param {string} name @param {any[]} parameters */
function load(name, ...parameters) {
  live = false;
  const answer = restart(name, ...parameters);
  live = isDue = !answer.refused;
  return answer;
}

/** What the page asks for besides the methods of the desk. @type {Record<string, (parameter?: any) => any>} */
const handlers = {
  begin,
  load: (request) => load("load", request),
  replay: (text) => load("replay", text),
  next_load: () => load("next_load"),
  jump(statement) {
    const answer = restart("jump", statement);
    live ||= Boolean(answer.undone);
    if (live && !answer.undone) plan();
    return answer;
  },
  act(line) {
    const answer = desk("act", line);
    if (live) plan();
    return answer;
  },
  pace(value) {
    pace = value;
  },
};

self.onmessage = async ({ data: { id, name, parameters } }) => {
  try {
    const answer = await (name in handlers ? handlers[name](...parameters) : desk(name, ...parameters));
    postMessage({ id, answer: answer ?? null });
    if (isDue) slice();
    isDue = false;
  } catch (error) {
    postMessage({ id, failed: message(error) });
  }
};
