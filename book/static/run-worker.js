/* The Python in which run.js runs the cells of a page: Pyodide, and the packages of the book.

   It gets {kind: "run", source}, {kind: "stop"}, {kind: "answer", text} and {kind: "hear", id, text}, and posts
   {kind: "ready"}, {kind: "output", output}, {kind: "ask", prompt}, {kind: "done", isComplete} and
   {kind: "failed", text}. */

const CORE = "https://cdn.jsdelivr.net/npm/pyodide@0.29.5/";
const PACKAGES = "https://cdn.jsdelivr.net/pyodide/v0.29.5/full/"; // their hashes are in pyodide-lock.json
const HASHES = {
  "pyodide.mjs": "sha256-UQyhQwUjABj1DED7gb5nOv1oCA5wzncz/M5mAN1qFxQ=",
  "pyodide.asm.js": "sha256-NWxC9p4WlTl+nYZwvTwuZ4JIzeduGL2uFzHoSFN7R9c=",
  "pyodide.asm.wasm": "sha256-VDCaWiz9dXsfD9vJCTySUD97NBUAEQMp2TJIcYORJxg=",
  "python_stdlib.zip": "sha256-gx/R5TUIS5cvh8ajUnXePSNu/VFm9ed86JSXcQY15zw=",
  "pyodide-lock.json": "sha256-FNLC26EBJ3mZ4XE15lPY8VOJrRQ39T6uITvww83/cj0=",
};

let python; // the module rosmini.notebook.page
let answer; // settles the promise for which input() waits

async function bytesOf(address, integrity = "") {
  const response = await fetch(address, { integrity }).catch((error) => {
    throw new Error(`${address} could not be loaded, or its content has changed (${error.message})`);
  });
  if (!response.ok) throw new Error(`${address}: ${response.status} ${response.statusText}`);
  return response.arrayBuffer();
}

/* Import a module from its text. */
async function load(bytes) {
  const address = URL.createObjectURL(new Blob([bytes], { type: "text/javascript" }));
  const module = await import(address);
  URL.revokeObjectURL(address);
  return module;
}

async function start() {
  const core = {}; // Pyodide's files by their addresses, all with the right hashes
  const read = async ([name, hash]) => (core[CORE + name] = await bytesOf(CORE + name, hash));
  const [packages] = await Promise.all([
    bytesOf(new URL("packages.zip", self.location.href)),
    ...Object.entries(HASHES).map(read),
  ]);
  // Pyodide runs Python in callbacks of postTask, and Chromium's tab crashes if a worker is terminated in one of them.
  const { scheduler } = self;
  const postTask = (task, options) => scheduler.postTask(() => void setTimeout(task), options);
  if (scheduler) Object.defineProperty(self, "scheduler", { value: { postTask } });
  const { loadPyodide } = await load(core[`${CORE}pyodide.mjs`]);
  await load(core[`${CORE}pyodide.asm.js`]);
  const fetchAny = self.fetch;
  self.fetch = async (address) => new Response(core[address], { headers: { "Content-Type": "application/wasm" } });
  const pyodide = await loadPyodide({ indexURL: CORE, packageBaseUrl: PACKAGES });
  self.fetch = fetchAny;
  pyodide.unpackArchive(packages, "zip", { extractDir: "/packages" });
  pyodide.runPython("import sys; sys.path.append('/packages')");
  python = pyodide.pyimport("rosmini.notebook.page");
  python.start(
    (text) => self.postMessage({ kind: "output", output: JSON.parse(text) }),
    (prompt) => {
      answer = Promise.withResolvers();
      self.postMessage({ kind: "ask", prompt });
      return answer.promise;
    },
    async (name) => {
      const errors = [];
      await pyodide.loadPackage(name, { messageCallback() {}, errorCallback: (text) => errors.push(text) });
      if (errors.length) throw new Error(errors.join(" "));
    },
  );
  self.postMessage({ kind: "ready" });
}

async function act({ kind, id, source, text }) {
  if (kind === "run") {
    self.postMessage({ kind: "done", isComplete: await python.run.callPromising(source) });
    return;
  }
  if (kind === "hear") {
    python.hear(id, text);
    return;
  }
  if (kind === "answer") answer.resolve(text);
  else if (answer) answer.reject(new Error("stopped"));
  else python.stop();
  answer = undefined;
}

function fail(error) {
  self.postMessage({ kind: "failed", text: String(error.message ?? error) });
}

self.onmessage = ({ data }) => act(data).catch(fail);
start().catch(fail);
