/* What a reader has read and solved, kept in this browser and nowhere else.

   Each page of the book notes that its end was seen. The page "Your progress" shows these notes as ticks, which the
   reader can change, and exports, imports and clears them. The notes are {pages: {name: date}, exercises: {name: date}}.
   In JupyterLab, `check` writes solved exercises into a file of the same form (`rosmini/book/checks.py`). */

(() => {
  "use strict";

  const KEY = "rosmini-progress";
  const KINDS = ["pages", "exercises"];
  const LARGEST = 1e6; // bytes: a file above this is none of ours
  let isKept = true; // whether the browser stores anything for this page
  let notes = { pages: {}, exercises: {} };

  /* The notes in the text of a file. Throws an error if it has another form. */
  function parse(text) {
    const read = JSON.parse(text);
    const found = { pages: {}, exercises: {} };
    for (const kind of KINDS) {
      for (const [name, date] of Object.entries(read[kind])) {
        if (!/^\d{4}-\d\d-\d\d$/.test(date)) throw new Error(`${name} has no date`);
        found[kind][name] = date;
      }
    }
    return found;
  }

  function load() {
    try {
      const text = localStorage.getItem(KEY);
      if (text) notes = parse(text);
    } catch (error) {
      isKept = !(error instanceof DOMException); // a damaged entry is replaced
    }
  }

  function keep() {
    try {
      localStorage.setItem(KEY, JSON.stringify(notes));
    } catch {
      isKept = false;
    }
  }

  function note(kind, name, isDone) {
    load(); // another tab may have written
    if (isDone) notes[kind][name] ??= new Date().toISOString().slice(0, 10);
    else delete notes[kind][name];
    keep();
  }

  load();
  const tools = document.querySelector("#progress-tools");
  const article = document.querySelector(".bd-article");
  const page = DOCUMENTATION_OPTIONS.pagename; // declared by Sphinx
  if (!tools && article && page) {
    const end = document.createElement("div");
    article.append(end);
    const above = { rootMargin: "1000000px 0px 0px" }; // a jump to the end of the page may pass by the article's
    const seen = new IntersectionObserver((entries) => {
      if (!entries.some((entry) => entry.isIntersecting)) return;
      seen.disconnect();
      note("pages", page, true);
    }, above);
    seen.observe(end);
  }
  if (!tools) return;

  const boxes = [...document.querySelectorAll(".progress-list input")];
  const kindOf = (box) => KINDS.find((kind) => kind in box.dataset);

  tools.innerHTML = `<p role="status"></p>
    <div><button type="button">Export</button> <button type="button">Import</button>
    <button type="button">Clear</button></div>
    <input type="file" accept=".json" aria-label="File with progress" hidden>`;
  const [exporter, importer, clearer] = tools.querySelectorAll("button");
  const status = tools.querySelector("[role=status]");
  const file = tools.querySelector("[type=file]");

  function show(more = "") {
    for (const box of boxes) box.checked = box.dataset[kindOf(box)] in notes[kindOf(box)];
    const [read, solved] = KINDS.map((kind) => {
      const all = boxes.filter((box) => kindOf(box) === kind);
      return `${all.filter((box) => box.checked).length} of ${all.length} ${kind}`;
    });
    const lost = isKept ? "" : " This browser keeps nothing for this page: export your progress before you leave it.";
    status.textContent = `${read} read, ${solved} solved.${lost}${more && ` ${more}`}`;
  }

  for (const box of boxes) {
    box.addEventListener("change", () => {
      note(kindOf(box), box.dataset[kindOf(box)], box.checked);
      show();
    });
  }

  exporter.addEventListener("click", () => {
    load();
    const known = { pages: {}, exercises: {} };
    for (const box of boxes) {
      const [kind, name] = [kindOf(box), box.dataset[kindOf(box)]];
      if (name in notes[kind]) known[kind][name] = notes[kind][name];
    }
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([JSON.stringify(known, null, 2)], { type: "application/json" }));
    link.download = "rosmini-progress.json";
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  });

  importer.addEventListener("click", () => file.click());
  file.addEventListener("change", async () => {
    const [chosen] = file.files;
    if (!chosen) return;
    try {
      if (chosen.size > LARGEST) throw new Error("it is too large");
      const read = parse(await chosen.text());
      load();
      for (const kind of KINDS) notes[kind] = { ...read[kind], ...notes[kind] };
      keep();
      show(`${chosen.name} was added.`);
    } catch {
      show(`${chosen.name} is not a file with progress. Nothing was changed.`);
    }
    file.value = ""; // the same file can be chosen again
  });

  clearer.addEventListener("click", () => {
    if (!confirm("Remove all ticks? Export them first if you may want them again.")) return;
    notes = { pages: {}, exercises: {} };
    keep();
    show("All ticks were removed.");
  });

  addEventListener("pageshow", () => {
    if (isKept) load();
    show();
  });
  show();
})();
