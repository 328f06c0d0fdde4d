// The emulator in a worker: Python with this project's package, run in slices between the messages of the page.
// In: {id, do, ...}. Out: {id, answer} for each, {slice} after each slice of a run, {progress} while loading.
import { loadPyodide } from "./pyodide/pyodide.mjs";

const SLICE = 40; // milliseconds between two checks for messages
let desk = null;
let pace = 0; // speed relative to the 1620; 0 means full speed
let turn = 0; // counts loads, so that a slice planned before the last load does nothing
let planned = false;

// Count the bytes of every file that is fetched, including those that Pyodide fetches. The largest file is stored
// compressed, under a name that no server interprets as an encoding.
let loaded = 0;
const plain = self.fetch.bind(self);
self.fetch = async (what, ...options) => {
  const address = String(what.url ?? what);
  const packed = address.endsWith(".wasm");
  const response = packed ? await plain(`${address}.gzip`, ...options) : await plain(what, ...options);
  if (!response.ok || !response.body) return response;
  let body = response.body.pipeThrough(
    new TransformStream({
      transform(chunk, out) {
        loaded += chunk.byteLength;
        postMessage({ progress: loaded });
        out.enqueue(chunk);
      },
    }),
  );
  let headers = response.headers;
  if (packed) {
    body = body.pipeThrough(new DecompressionStream("gzip"));
    headers = { "content-type": "application/wasm" };
  }
  return new Response(body, { status: response.status, headers });
};

async function begin() {
  const [python, packages] = await Promise.all([
    loadPyodide({ indexURL: new URL("./pyodide/", import.meta.url).href }),
    self.fetch(new URL("./packages.zip", import.meta.url)).then((response) => response.arrayBuffer()),
  ]);
  python.unpackArchive(packages, "zip", { extractDir: "/packages" });
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
  return desk("offers");
}

function plan(delay = 0) {
  if (planned) return;
  planned = true;
  const planned_for = turn;
  setTimeout(() => {
    planned = false;
    if (planned_for === turn) slice();
  }, delay);
}

let before = 0; // seconds on the 1620 at the end of the previous slice
function slice() {
  const began = performance.now();
  const answer = desk("run", SLICE, pace);
  postMessage({ slice: answer });
  if (answer.ended || answer.waits) return;
  const delay = pace ? ((answer.seconds - before) / pace) * 1000 - (performance.now() - began) : 0;
  before = answer.seconds;
  plan(Math.min(Math.max(delay, 0), 500));
}

const handlers = {
  begin,
  load({ request }) {
    turn += 1;
    planned = false;
    before = 0;
    const answer = desk("load", request);
    if (!answer.refused) plan();
    return answer;
  },
  act({ words }) {
    const answer = desk("act", words);
    plan();
    return answer;
  },
  show: ({ words }) => desk("show", words),
  log: () => desk("log"),
  part: ({ text }) => desk("part", text),
  pace({ value }) {
    pace = value;
  },
};

self.onmessage = async ({ data }) => {
  try {
    postMessage({ id: data.id, answer: await handlers[data.do](data) });
  } catch (error) {
    postMessage({ id: data.id, failed: String(error.message ?? error).trim().split("\n").at(-1) });
  }
};
