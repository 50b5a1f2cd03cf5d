/* The button "Run in this page": the cells of a page become editable and run in the browser.

   Nothing is requested before the button is pressed. Then run-worker.js loads Python and runs the code. The element of
   this script has the size of what is loaded (data-megabytes). */

(() => {
  "use strict";

  const { src, dataset } = document.currentScript;
  const READY = "Ready. Edit a cell and press Run or Shift+Enter; earlier cells have to run first.";
  const RESTARTED = "Python was restarted and all variables are gone.";

  let worker = null;
  let cells = [];
  let queue = []; // cells that run next
  let running = null; // the cell that runs
  let latest = null; // the cell that ran last
  let isStopping = false;
  let notice = ""; // precedes READY

  const panel = element("div", "run-panel");
  const button = element("button", "", "Run in this page");
  const status = element("span", "");
  button.type = "button";
  status.setAttribute("role", "status");
  status.textContent =
    `Runs the cells in your browser. Loads ${dataset.megabytes} MB: ` +
    `Python and its packages from cdn.jsdelivr.net, and the library from this site. ${dataset.more}`;
  panel.append(button, status);
  document.querySelector(".bd-article h1").after(panel);

  function element(tag, className, text = "") {
    const made = document.createElement(tag);
    made.className = className;
    made.textContent = text;
    return made;
  }

  /* The text of a cell's outputs, by kind, without blank lines at its ends: HTML drops the first. Pictures are not compared. */
  function textsOf(outputs) {
    const texts = {};
    for (const text of outputs.querySelectorAll(".output > .highlight > pre")) {
      const names = [...text.closest(".output").classList];
      const kind = names.find((name) => ["stream", "stderr", "traceback"].includes(name)) ?? "value";
      texts[kind] = (texts[kind] ?? "") + text.textContent;
    }
    return Object.entries(texts).map(([kind, text]) => kind + text.trim()).sort().join("\n");
  }

  /* Make a cell of the page editable and give it a button. */
  function editable(place, index) {
    const code = place.querySelector(".cell_input pre");
    const outputs = place.querySelector(".cell_output") ?? element("div", "cell_output");
    const caption = outputs.querySelector(":scope > figure");
    const editor = element("textarea", "run-editor");
    const alt = outputs.querySelector("img")?.alt;
    const cell = { place, outputs, caption, alt, editor, stored: textsOf(outputs), number: index + 1 };
    editor.value = code.textContent.replace(/\n$/, "");
    editor.spellcheck = false;
    editor.setAttribute("aria-label", `Code of cell ${cell.number}`);
    const fit = () => (editor.rows = editor.value.split("\n").length);
    editor.addEventListener("input", fit);
    editor.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" || !event.shiftKey) return;
      event.preventDefault();
      if (!running && !cell.button.disabled) run([cell]);
    });
    fit();
    cell.button = element("button", "run-cell");
    cell.button.type = "button";
    cell.button.addEventListener("click", () => (running ? stop() : run([cell])));
    code.closest(".cell_input").replaceChildren(editor);
    place.append(cell.button, outputs);
    return cell;
  }

  /* Show a text beside the main button, and on all buttons what they do now. */
  function show(text) {
    if (text !== undefined) status.textContent = text;
    const ending = isStopping ? "Restart Python" : "Stop";
    button.textContent = running ? ending : worker ? "Run all" : "Run in this page";
    for (const cell of cells) {
      cell.button.textContent = cell === running ? ending : "Run";
      cell.button.setAttribute("aria-label", `${cell.button.textContent}: cell ${cell.number}`);
      cell.button.disabled = !worker || (running !== null && cell !== running);
      cell.place.classList.toggle("run-now", cell === running);
    }
  }

  function run(next) {
    queue = [...next];
    running = queue.shift() ?? null;
    isStopping = false;
    if (running) {
      for (const old of running.caption?.querySelectorAll(":scope > :not(figcaption)") ?? []) old.remove();
      running.outputs.replaceChildren(...[running.caption].filter(Boolean));
      closePages(({ host }) => !host.isConnected);
      latest = running;
      worker.postMessage({ kind: "run", source: running.editor.value });
    }
    show(running ? `Cell ${running.number} of ${cells.length} runs.` : undefined);
  }

  function stop() {
    if (isStopping) {
      end();
      notice = `${RESTARTED} `;
      finish();
      load();
      return;
    }
    isStopping = true;
    queue = [];
    worker.postMessage({ kind: "stop" });
    show("The cell stops as soon as it waits. A loop that never waits ends only when Python is restarted.");
  }

  function finish(text) {
    if (running && textsOf(running.outputs) !== running.stored) {
      running.outputs.append(element("p", "run-differs", "The text differs from the output that the book shows."));
    }
    running = null;
    show(text);
  }

  /* Scripts that come as text do not run by themselves. */
  function fill(output, html) {
    output.innerHTML = html;
    for (const old of output.querySelectorAll("script")) {
      const script = document.createElement("script");
      for (const { name, value } of old.attributes) script.setAttribute(name, value);
      script.textContent = old.textContent;
      old.replaceWith(script);
    }
  }

  function add({ kind, name, text, data }) {
    const { outputs, caption, alt } = running ?? latest;
    const last = outputs.lastElementChild;
    const className = { error: "traceback", stream: name === "stderr" ? "stderr" : "stream", data: "" }[kind];
    if (kind === "stream" && last?.classList.contains(className)) {
      last.querySelector("pre").append(text);
      return;
    }
    const html = data?.["text/html"] ?? data?.["image/svg+xml"];
    const image = html ? undefined : data?.["image/png"];
    const output = image ? new Image() : element("div", `output ${className}`);
    if (html) {
      fill(output, html);
    } else if (image) {
      Object.assign(output, { src: `data:image/png;base64,${image}`, alt: alt ?? data["text/plain"] });
    } else {
      const box = element("div", "highlight");
      box.append(element("pre", "", text ?? data["text/plain"] ?? ""));
      output.append(box);
    }
    if ((html || image) && caption) caption.lastElementChild.before(output);
    else outputs.append(output);
  }

  function ask(prompt) {
    const form = element("form", "run-ask");
    const label = element("label", "", prompt);
    const line = document.createElement("input");
    line.autocomplete = "off";
    label.append(" ", line);
    form.append(label);
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      form.remove();
      add({ kind: "stream", name: "stdout", text: `${prompt}${line.value}\n` });
      worker.postMessage({ kind: "answer", text: line.value });
    });
    running.outputs.append(form);
    line.focus();
  }

  /* The pages of live views: pads and panels. Each talks to an object of Python with the same number, as an anywidget
     does to its model. */
  const pages = new Map();
  const viewOf = ({ base64 }) => new DataView(Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0)).buffer);

  globalThis.rosminiPage = {
    mount(host, { id, driver, data }, { asset }) {
      const heard = new Set();
      const state = { data: Object.fromEntries(Object.entries(data).map(([k, v]) => [k, v?.base64 ? viewOf(v) : v])) };
      const model = {
        get: (name) => state[name],
        on: (name, callback) => name === "msg:custom" && heard.add(callback),
        off: (name, callback) => heard.delete(callback),
        send: (content) => worker?.postMessage({ kind: "hear", id, text: JSON.stringify(content) }),
      };
      globalThis.rosminiAsset ??= asset;
      const page = { host, heard };
      pages.set(id, page);
      page.close = globalThis[driver].render({ model, el: host });
    },
  };

  function tell({ id, content, buffers }) {
    for (const callback of [...(pages.get(id)?.heard ?? [])]) callback(content, buffers.map(viewOf));
  }

  function closePages(which) {
    for (const [id, page] of [...pages].filter(([, each]) => which(each))) {
      pages.delete(id);
      page.close?.();
    }
  }

  const ACTIONS = {
    ready() {
      if (!cells.length) cells = [...document.querySelectorAll(".bd-article div.cell:has(.cell_input)")].map(editable);
      panel.classList.add("run-ready");
      button.disabled = false;
      show(notice + READY);
    },
    output: ({ output }) => (output.kind === "tell" ? tell(output) : add(output)),
    ask: ({ prompt }) => ask(prompt),
    done({ isComplete }) {
      running.outputs.querySelector(".run-ask")?.remove();
      const isExpected = isComplete || running.stored.includes("traceback");
      const rest = isExpected ? queue : [];
      finish(rest.length ? undefined : isExpected ? "Done." : "The cell ended with an error.");
      run(rest);
    },
    failed({ text }) {
      end();
      button.disabled = false;
      finish(`Python ended: ${text}`);
    },
  };

  function end() {
    worker.terminate();
    worker = null;
    const content = { type: "gone", text: "Python has ended: run the cell again." };
    for (const id of pages.keys()) tell({ id, content, buffers: [] });
    closePages(() => true);
  }

  function load() {
    button.disabled = true;
    status.textContent = `${notice}Loading ${dataset.megabytes} MB ...`;
    worker = new Worker(new URL("run-worker.js", src), { type: "module" });
    worker.onmessage = ({ data }) => ACTIONS[data.kind](data);
    worker.onerror = ({ message }) => ACTIONS.failed({ text: message ?? "its script could not be loaded" });
  }

  button.addEventListener("click", () => {
    if (location.protocol === "file:") {
      status.textContent =
        "Browsers run cells only on pages that a server sends. " +
        "Run `uv run python -m http.server -d book/_build/html` and open localhost:8000.";
    } else if (!("Suspending" in WebAssembly)) {
      status.textContent =
        "This browser cannot suspend Python while a node waits (JavaScript Promise Integration). Chrome and Edge can.";
    } else if (!worker) {
      load();
    } else if (running) {
      stop();
    } else {
      run(cells);
    }
  });
})();
