// The machine: Python with this project's package, run in slices between the page's messages.
// In: {id, do, ...}. Out: {id, answer} to each, {slice} after each slice of a run, {progress} while loading.
import { loadPyodide } from "./pyodide/pyodide.mjs";

const SLICE = 40; // milliseconds between two looks at the messages
let desk = null;
let pace = 0; // times the speed of the 1620; 0: as fast as can be
let turn = 0; // counts loads, so that a slice planned for a former machine does nothing
let planned = false;

// What is fetched is counted as it comes, whoever fetches it. The largest file lies here compressed, by a name that no
// server takes for an encoding.
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
    self.fetch(new URL("./packages.zip", import.meta.url)).then((found) => found.arrayBuffer()),
  ]);
  python.unpackArchive(packages, "zip", { extractDir: "/packages" });
  python.runPython(`
import sys, json
sys.path.insert(0, "/packages")
from modern.publication.desk import Desk
desk = Desk()
def ask(name, words):
    if name == "part":
        from modern.publication.parting import parted as does
    else:
        does = getattr(desk, name)
    return json.dumps(does(*json.loads(words)))
`);
  const ask = python.globals.get("ask");
  desk = (name, ...words) => JSON.parse(ask(name, JSON.stringify(words)));
  return desk("offers");
}

function plan(delay = 0) {
  if (planned) return;
  planned = true;
  const mine = turn;
  setTimeout(() => {
    planned = false;
    if (mine === turn) slice();
  }, delay);
}

let before = 0; // seconds of the 1620 at the end of the slice before
function slice() {
  const began = performance.now();
  const answer = desk("run", SLICE, pace);
  postMessage({ slice: answer });
  if (answer.ended || answer.waits) return;
  const owed = pace ? ((answer.seconds - before) / pace) * 1000 - (performance.now() - began) : 0;
  before = answer.seconds;
  plan(Math.min(Math.max(owed, 0), 500));
}

const does = {
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
    postMessage({ id: data.id, answer: await does[data.do](data) });
  } catch (error) {
    postMessage({ id: data.id, failed: String(error.message ?? error).trim().split("\n").at(-1) });
  }
};
