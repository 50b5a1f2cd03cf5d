/* A panel of rqt in a live notebook: the kernel sends it as HTML with form controls, and hears what is done with them.
   A plain script that sets `globalThis.rosminiRqt`; `render({ model, el })` is what anywidget calls.

   To the kernel:   {type: "hello"} a page has opened, {type: "beat"} it is still there, {type: "start"} let the graph go on,
                    {type: "seen"} what was sent is on the page, {type: "set", key, value, number} a control was operated; a pointer on a drawing is told in words, "press 10 20".
   From the kernel: {type: "sheet", html, number} what the panel shows after that "set", {type: "alive"} the same as before, {type: "refused", text},
                    {type: "still"} nobody drives the graph; {type: "gone", text};
                    {type: "solid", ...} with buffers, for the script rosmini-rviz.js.

   What is new is put into the page without touching the rest, so that neither the focus nor what is being typed is lost. */

(() => {
  "use strict";

  const BEAT_MS = 500;
  const PATIENCE_MS = 3000;
  const MOVE_MS = 50; // no two moves of a pointer follow one another faster
  const typed = new WeakSet(); // fields that somebody is writing into
  const operated = new WeakMap(); // controls, with the number of the last "set"

  /* Make an element like another one, with as few changes as that takes. */
  function morph(old, made, number) {
    for (const { name } of [...old.attributes]) if (!made.hasAttribute(name)) old.removeAttribute(name);
    for (const { name, value } of made.attributes) if (old.getAttribute(name) !== value) old.setAttribute(name, value);
    if (old.querySelector(":scope > .rq-solid") && made.querySelector(":scope > .rq-solid")) return; // a viewer is in it
    if (old.matches("style, .rq-drawing")) {
      if (old.innerHTML !== made.innerHTML) old.innerHTML = made.innerHTML;
      return;
    }
    const [before, after] = [[...old.childNodes], [...made.childNodes]];
    after.forEach((node, i) => {
      const present = before[i];
      if (!present) old.append(node);
      else if (present.nodeName !== node.nodeName || present.dataset?.key !== node.dataset?.key) present.replaceWith(node);
      else if (node.nodeType === Node.ELEMENT_NODE) morph(present, node, number);
      else if (present.data !== node.data) present.data = node.data;
    });
    before.slice(after.length).forEach((node) => node.remove());
    settle(old, made, number);
  }

  /* What a control shows is no attribute of it any more once it was operated. A key that is held down is ahead of the kernel. */
  function settle(old, made, number) {
    if (!old.dataset.key || (old.matches(":focus") && (typed.has(old) || operated.get(old) > number))) return;
    if (old.type === "checkbox") old.checked = made.hasAttribute("checked");
    else if (old.nodeName === "SELECT") old.value = (made.querySelector("[selected]") ?? made.options[0])?.value ?? "";
    else if (old.nodeName === "INPUT" && old.value !== made.getAttribute("value")) old.value = made.getAttribute("value");
  }

  class Panel {
    constructor(model, el) {
      this.model = model;
      this.heard = performance.now();
      this.sheets = this.number = 0;
      this.host = document.createElement("div");
      this.host.innerHTML = model.get("data").html;
      this.pill = document.createElement("p");
      this.pill.className = "rq-pill";
      this.pill.style.cssText = "margin:4px 12px;font:12px sans-serif;opacity:0.75";
      this.pill.setAttribute("role", "status");
      this.refusal = document.createElement("p");
      this.refusal.style.cssText = "margin:4px 12px;padding-left:8px;border-left:4px solid #d33;font:bold 14px sans-serif";
      this.refusal.setAttribute("role", "alert");
      this.startButton = document.createElement("button");
      Object.assign(this.startButton, { type: "button", textContent: "Start the graph", hidden: true });
      this.startButton.addEventListener("click", () => this.tell({ type: "start" }));
      const style = document.createElement("style"); // inside, since the panel cuts off what is outside
      style.textContent = ".rosmini-rqt .rosmini-rqt-table:focus-visible { outline-offset: -2px }";
      el.replaceChildren(this.host, style, this.refusal, this.pill, this.startButton);
      this.note("ready");
      this.refuse("");
      this.receive = (content, buffers) => this.hear(content, buffers);
      model.on("msg:custom", this.receive);
      for (const kind of ["change", "click", "input", "keydown"]) this.host.addEventListener(kind, (event) => this[kind](event));
      for (const kind of ["pointerdown", "pointermove", "pointerup", "pointercancel"]) this.host.addEventListener(kind, (event) => this.point(event));
      this.host.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
      this.timer = setInterval(() => this.beat(), BEAT_MS);
      this.tell({ type: "hello" });
    }

    // -- from the hand ------------------------------------------------------------------------------------------------

    change({ target }) {
      if (!target.dataset?.key || target.nodeName === "BUTTON") return;
      typed.delete(target);
      this.set(target.dataset.key, target.type === "checkbox" ? target.checked : target.value);
      operated.set(target, this.number);
    }

    click({ target }) {
      const button = target.closest("button[data-key]");
      if (button) this.set(button.dataset.key, true);
      const picked = target.closest("[data-picks] .rm-node, [data-picks] .rm-topic");
      const name = picked?.querySelector("title")?.textContent.replace(/^(node|topic) /, "").split(/[ :]/)[0];
      if (name) this.set(picked.closest("[data-picks]").dataset.picks, name);
    }

    input({ target }) {
      typed.add(target);
    }

    keydown(event) {
      event.stopPropagation(); // a notebook has commands on single keys
      const { target, key, ctrlKey, altKey, metaKey } = event;
      if (!target.dataset?.points || key === "Tab" || ctrlKey || altKey || metaKey) return;
      event.preventDefault();
      this.set(target.dataset.points, `key ${key}`);
    }

    /* Where a pointer is on a drawing, in its own pixels. */
    at(drawing, event) {
      const svg = drawing.querySelector("svg");
      const box = svg.getBoundingClientRect();
      const { width, height } = svg.viewBox.baseVal;
      const x = ((event.clientX - box.left) / box.width) * width;
      const y = ((event.clientY - box.top) / box.height) * height;
      return `${x.toFixed(1)} ${y.toFixed(1)}`;
    }

    point(event) {
      if (event.type === "pointerdown") this.held = event.button === 0 ? event.target.closest?.("[data-points]") : null;
      if (!this.held) return;
      const key = this.held.dataset.points;
      if (event.type === "pointerdown") {
        this.held.focus({ preventScroll: true });
        this.held.setPointerCapture(event.pointerId);
        event.preventDefault(); // no text is marked
        this.set(key, `press ${this.at(this.held, event)}`);
      } else if (event.type === "pointermove") {
        if (performance.now() - (this.moved ?? 0) < MOVE_MS) return;
        this.moved = performance.now();
        this.set(key, `move ${this.at(this.held, event)}`);
      } else {
        this.set(key, `release ${this.at(this.held, event)}`);
        this.held = null;
      }
    }

    /* With Ctrl, as on maps: the wheel alone scrolls the page. */
    wheel(event) {
      const drawing = event.ctrlKey && event.target.closest?.("[data-points]");
      if (!drawing) return;
      event.preventDefault();
      this.set(drawing.dataset.points, `wheel ${Math.sign(event.deltaY)} ${this.at(drawing, event)}`);
    }

    set(key, value) {
      this.refuse("");
      this.number += 1;
      this.tell({ type: "set", key, value, number: this.number });
    }

    // -- to and from the kernel ---------------------------------------------------------------------------------------

    tell(content) {
      try {
        this.model.send(content);
      } catch (error) {
        this.note("no kernel: run the cell of this panel again");
      }
    }

    hear(content, buffers) {
      this.heard = performance.now();
      this.startButton.hidden = content.type !== "still";
      switch (content.type) {
        case "sheet": {
          const made = document.createElement("div");
          made.innerHTML = content.html;
          const at = this.controls().indexOf(document.activeElement);
          morph(this.host, made, content.number);
          if (at >= 0 && document.activeElement === document.body) (this.controls()[at] ?? this.controls().at(-1))?.focus();
          this.sheets += 1;
          this.note("live");
          this.seen();
          break;
        }
        case "alive": this.note("live"); break;
        case "solid": globalThis.rosminiRviz.show(this, content, buffers); this.seen(); break;
        case "still": this.note("the graph stands still"); break;
        case "refused": this.refuse(content.text); break;
        default: this.end(content.text);
      }
    }

    /* The kernel sends the next sheet after this only, so that none queue up in a slow browser. */
    seen() {
      setTimeout(() => this.tell({ type: "seen" }), 0);
    }

    end(text) {
      this.over = true;
      this.host.querySelector("fieldset")?.setAttribute("disabled", "");
      this.note(text);
    }

    /* Say why nothing was done, until the next thing that a hand does. */
    refuse(text) {
      this.refusal.textContent = text;
      this.refusal.hidden = !text;
    }

    controls() {
      return [...this.host.querySelectorAll("[data-key], [data-points]")];
    }

    note(text) {
      if (this.pill.textContent !== text) this.pill.textContent = text;
    }

    beat() {
      if (document.hidden) this.heard = performance.now(); // nobody looks, and nothing comes
      if (this.over || document.hidden) return;
      this.tell({ type: "beat" });
      if (performance.now() - this.heard > PATIENCE_MS) this.note("waiting for the kernel; if it was restarted, run the cell of this panel again");
    }

    close() {
      clearInterval(this.timer);
      this.model.off("msg:custom", this.receive);
    }
  }

  function render({ model, el }) {
    const panel = new Panel(model, el);
    el.rosminiPanel = panel; // for those who measure
    return () => panel.close();
  }

  globalThis.rosminiRqt = { render };
})();
