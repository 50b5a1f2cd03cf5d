/* A running simulation in a page: robots and boxes that are dragged with a mouse, a finger or keys.

   A plain script that sets `globalThis.rosminiView`; it needs rosmini-canvas.js and rosmini-view-style.js before it.

     new Page(host, data, driver)   a view before a driver: rosmini-view-kernel.js has one

   `data` is what `rosmini.viz.live.view_link` makes: {title, scene, bodies, poses, time, paused, step}. A driver is what stands behind the page:
   drag(name, [x, y, theta]), act("pause" | "unpause" | "step" | "reset" | "start"), close(), and `state`, which the page draws whenever the driver
   calls `changed()`: {scene, bodies, poses, scans, time, paused, mood, note, said}. It calls `put(name, accepted, text)` when a drag has been
   answered. What is dragged is a ghost until then: where a robot is, the simulation says.

   Each body is a button over the canvas, so that Tab reaches it and a screen reader says where it is. */

(() => {
  "use strict";

  const MOVE = 0.1; // metres that an arrow key moves
  const FINE = 0.01; // with Alt
  const TURN = Math.PI / 12; // what a key or a notch of the wheel turns
  const LEAST = 30; // pixels: a finger has to hit it
  const HANDLE = 20; // pixels from a body's edge to the handle that turns it
  const SLACK = 3; // pixels: what moves less was a click

  const degrees = (radians) => {
    const turned = ((((radians * 180) / Math.PI + 180) % 360) + 360) % 360 - 180;
    return turned.toFixed(0).replace(/^-0$/, "0").replace(/^-180$/, "180");
  };
  const fixed = (value, digits = 2) => value.toFixed(digits).replace(/^-(0\.0+)$/, "$1");
  const where = ([x, y, theta]) => `x ${fixed(x)} m, y ${fixed(y)} m, ${degrees(theta)}°`;
  const rounded = ([x, y, theta]) => [Math.round(x * 1000) / 1000, Math.round(y * 1000) / 1000, theta];

  function compose([x, y, theta], [ax, ay, atheta]) {
    const [c, s] = [Math.cos(theta), Math.sin(theta)];
    return [x + c * ax - s * ay, y + s * ax + c * ay, theta + atheta];
  }

  function element(tag, attributes = {}, ...children) {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
    made.append(...children);
    return made;
  }

  class Page {
    constructor(host, data, driver) {
      this.driver = driver;
      this.ghosts = new Map(); // name: {pose, held, refused}
      this.buttons = new Map();
      this.chosen = ""; // the body that has the handle
      this.build(host, data);
      this.listen();
      this.fit();
      this.unwatch = globalThis.rosminiCanvas.watch(this.canvas, () => { this.fit(); this.draw(); });
      driver.changed = () => this.request();
      driver.put = (name, accepted, text) => this.answered(name, accepted, text);
      this.draw();
    }

    // -- building ---------------------------------------------------------------------------------------------------

    build(host, data) {
      const button = (act, label) => element("button", { type: "button", class: "rv-plain", "data-act": act }, label);
      this.runButton = button("pause", "Pause");
      this.stepButton = button("step", `Step ${data.step} s`);
      this.resetButton = button("reset", "Back to the start");
      this.clock = element("span", { class: "rv-clock" });
      this.pill = element("span", { class: "rv-pill" }, element("i"), element("span"));
      this.canvas = element("canvas", { role: "img", "aria-label": `${data.title}, from above` });
      this.handle = element("span", { class: "rv-handle", "aria-hidden": "true", title: "Drag to turn" });
      this.handle.hidden = true;
      this.things = element("div", { class: "rv-things", role: "group", "aria-label": "Robots and boxes" });
      this.stage = element("div", { class: "rv-stage" }, this.canvas, this.things, this.handle);
      this.message = element("p", { class: "rv-message", role: "status" }, "Drag a robot or a box.");
      const kbd = (...keys) => keys.map((key) => element("kbd", {}, key));
      this.help = element("p", { class: "rv-help" });
      for (const parts of [
        [...kbd("Tab"), " to a robot or a box;"],
        [...kbd("←", "↑", "↓", "→"), " move it 10 cm, with ", ...kbd("Alt"), " 1 cm;"],
        [...kbd("Shift"), " and ", ...kbd("←", "→"), ", a drag with ", ...kbd("Shift"), ", its handle or the wheel turn it;"],
        [...kbd("Esc"), " lets it go where it was."],
      ]) this.help.append(element("span", {}, ...parts), " ");
      this.section = element(
        "section", { class: "rosmini-view", "aria-label": data.title, "data-lm-suppress-shortcuts": "true" },
        element("div", { class: "rv-bar" }, this.pill, this.clock, this.runButton, this.stepButton, this.resetButton),
        this.stage, this.message, this.help,
      );
      if (!document.getElementById("rosmini-view-style")) {
        document.head.append(element("style", { id: "rosmini-view-style" }, globalThis.rosminiViewStyle));
      }
      host.replaceChildren(this.section);
    }

    /* One button for each body that can be taken. */
    populate() {
      const { bodies } = this.driver.state;
      if (this.populated === bodies) return;
      this.populated = bodies;
      const before = this.buttons;
      this.buttons = new Map();
      for (const body of bodies) {
        if (body.kind === "mover") continue;
        this.buttons.set(body.name, before.get(body.name) ?? element("button", { type: "button", class: "rv-thing", "data-name": body.name }));
      }
      for (const [name, button] of before) if (!this.buttons.has(name)) button.remove();
      [...this.buttons.values()].forEach((button, i) => {
        if (this.things.children[i] !== button) this.things.insertBefore(button, this.things.children[i] ?? null);
      });
      for (const name of this.ghosts.keys()) if (!this.buttons.has(name)) this.ghosts.delete(name);
      if (!this.buttons.has(this.chosen)) this.chosen = "";
    }

    // -- mouse, finger, keys ------------------------------------------------------------------------------------------

    listen() {
      const { stage } = this;
      stage.addEventListener("pointerdown", (event) => this.take(event));
      stage.addEventListener("pointermove", (event) => this.move(event));
      stage.addEventListener("pointerup", (event) => this.drop(event));
      stage.addEventListener("pointercancel", () => this.letGo());
      stage.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
      stage.addEventListener("keydown", (event) => this.key(event));
      stage.addEventListener("focusin", (event) => this.choose(event.target.dataset.name));
      stage.addEventListener("contextmenu", (event) => { if (this.held) event.preventDefault(); });
      this.section.addEventListener("click", (event) => {
        const act = event.target.closest("[data-act]")?.dataset.act;
        if (act) this.driver.act(act);
      });
    }

    choose(name) {
      if (name === undefined || name === this.chosen) return;
      this.chosen = name;
      this.request();
    }

    body(name) { return this.driver.state.bodies.find((body) => body.name === name); }

    pose(name) {
      const { bodies, poses } = this.driver.state;
      return poses[bodies.findIndex((body) => body.name === name)];
    }

    at(event) {
      const { left, top } = this.canvas.getBoundingClientRect();
      return this.view.metres(event.clientX - left, event.clientY - top);
    }

    take(event) {
      if (event.button !== 0 || this.held || this.driver.state.mood === "gone") return;
      const turning = event.target === this.handle;
      const name = turning ? this.chosen : event.target.closest(".rv-thing")?.dataset.name;
      if (!name) return;
      event.preventDefault();
      this.buttons.get(name).focus({ preventScroll: true });
      const pose = this.ghosts.get(name)?.pose ?? this.pose(name);
      this.held = { name, pose, from: this.at(event), x: event.clientX, y: event.clientY, pointer: event.pointerId, handle: turning };
      this.stage.setPointerCapture(event.pointerId);
      this.section.classList.add("rv-holding");
    }

    move(event) {
      const { held } = this;
      if (!held || event.pointerId !== held.pointer) return;
      if (!held.moved && Math.hypot(event.clientX - held.x, event.clientY - held.y) < SLACK) return;
      held.moved = true;
      const [x, y, theta] = held.pose;
      const [px, py] = this.at(event);
      if (held.handle || event.shiftKey) {
        const turned = Math.atan2(py - y, px - x) - Math.atan2(held.from[1] - y, held.from[0] - x);
        held.to = [x, y, theta + turned];
      } else {
        held.to = rounded([x + px - held.from[0], y + py - held.from[1], theta]);
      }
      this.ghosts.set(held.name, { pose: held.to, held: true });
      this.request();
    }

    drop(event) {
      const { held } = this;
      if (!held || event.pointerId !== held.pointer) return;
      this.held = undefined;
      this.section.classList.remove("rv-holding");
      if (held.to) this.send(held.name, held.to);
    }

    letGo() {
      if (!this.held) return;
      this.ghosts.delete(this.held.name);
      this.held = undefined;
      this.section.classList.remove("rv-holding");
      this.request();
    }

    wheel(event) {
      const name = event.target.closest(".rv-thing")?.dataset.name;
      // Only what has been chosen: else a page that is scrolled would turn robots.
      if (!name || name !== this.chosen || this.buttons.get(name) !== document.activeElement || this.held || !event.deltaY) return;
      event.preventDefault();
      this.nudge(name, ([x, y, theta]) => [x, y, theta - Math.sign(event.deltaY) * TURN]);
    }

    key(event) {
      const name = event.target.dataset.name;
      if (event.key === "Escape") {
        if (this.held) this.letGo();
        else document.activeElement.blur();
        return;
      }
      const along = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      if (!name || !along || event.ctrlKey || event.metaKey) return;
      event.preventDefault();
      event.stopPropagation();
      const [dx, dy] = along;
      if (event.shiftKey) {
        if (dx) this.nudge(name, ([x, y, theta]) => [x, y, theta - dx * TURN]);
      } else {
        const step = event.altKey ? FINE : MOVE;
        this.nudge(name, ([x, y, theta]) => rounded([x + dx * step, y + dy * step, theta]));
      }
    }

    /* From where it will be, if it is on its way already. */
    nudge(name, change) {
      if (this.driver.state.mood !== "gone") this.send(name, change(this.ghosts.get(name)?.pose ?? this.pose(name)));
    }

    send(name, pose) {
      const ghost = this.ghosts.get(name);
      this.ghosts.set(name, { pose, asked: (ghost?.asked ?? 0) + 1 });
      this.request();
      this.driver.drag(name, pose);
    }

    answered(name, accepted, text) {
      const ghost = this.ghosts.get(name);
      if (ghost?.asked > 1 && accepted) ghost.asked -= 1;
      else if (ghost && !ghost.held) this.ghosts.delete(name); // it is where the simulation says: it snaps back if it was refused
      this.say(text, accepted);
      const button = this.buttons.get(name);
      if (!accepted && button) {
        button.classList.remove("rv-refused");
        void button.offsetWidth; // so that it begins anew
        button.classList.add("rv-refused");
      }
      this.request();
    }

    say(text, good = true) {
      this.message.textContent = text;
      this.message.classList.toggle("rv-bad", !good);
    }

    // -- drawing ------------------------------------------------------------------------------------------------------

    fit() {
      for (const [name, value] of Object.entries(globalThis.rosminiCanvas.theme(this.section.parentElement))) {
        this.section.style.setProperty(`--rosmini-${name}`, value);
      }
      this.view = globalThis.rosminiCanvas.fit(this.canvas, this.driver.state.scene.bounds, { maxHeight: 560 });
      this.fitted = this.driver.state.scene;
    }

    request() {
      if (this.asked) return;
      this.asked = true;
      requestAnimationFrame(() => { this.asked = false; this.draw(); });
    }

    draw() {
      const { state } = this.driver;
      const { world, scan, label, scaleBar } = globalThis.rosminiCanvas;
      if (this.fitted !== state.scene) this.fit();
      this.populate();
      const { view } = this;
      world(view, state.scene);
      const gone = state.mood === "gone";
      for (const { name, pose, ranges } of gone ? [] : state.scans) {
        const body = this.body(name);
        if (body?.laser) scan(view, { lidar: body.laser }, () => pose, ranges);
      }
      const several = state.bodies.filter((body) => body.robot).length > 1;
      state.bodies.forEach((body, i) => { if (!body.robot) this.drawBody(body, state.poses[i]); });
      state.bodies.forEach((body, i) => { if (body.robot) this.drawBody(body, state.poses[i]); });
      state.bodies.forEach((body, i) => {
        if (body.robot && several) label(view, state.poses[i], body.name, { colour: body.colour, below: body.reach });
      });
      for (const [name, ghost] of this.ghosts) {
        const body = this.body(name);
        if (!body) continue;
        this.line(this.pose(name), ghost.pose);
        this.drawBody(body, ghost.pose, true);
      }
      scaleBar(view);
      this.place(state);
      this.pill.dataset.mood = state.mood;
      this.pill.lastChild.textContent = state.note;
      this.clock.textContent = `${fixed(state.time, 1)} s${state.paused ? ", paused" : ""}`;
      this.runButton.dataset.act = state.startable ? "start" : state.paused ? "unpause" : "pause";
      this.runButton.textContent = state.startable ? "Start" : state.paused ? "Run" : "Pause";
      for (const button of [this.runButton, this.stepButton, this.resetButton]) button.disabled = gone;
      if (state.said && state.said !== this.said) { this.said = state.said; this.say(state.said.text, state.said.good); }
    }

    drawBody(body, pose, ghost = false) {
      const at = compose(pose, body.axle);
      if (body.robot) globalThis.rosminiCanvas.robot(this.view, body.robot, at, { ghost, colour: body.colour });
      else globalThis.rosminiCanvas.thing(this.view, body.shapes, at, { ghost });
    }

    line([x1, y1], [x2, y2]) {
      const { context, theme } = this.view;
      context.beginPath();
      context.moveTo(this.view.x(x1), this.view.y(y1));
      context.lineTo(this.view.x(x2), this.view.y(y2));
      context.lineWidth = 1.2;
      context.setLineDash([3, 3]);
      context.strokeStyle = theme.orange;
      context.stroke();
      context.setLineDash([]);
    }

    /* The buttons go where their bodies are; the one that is held goes with its ghost. */
    place(state) {
      const { view } = this;
      state.bodies.forEach((body, i) => {
        const button = this.buttons.get(body.name);
        if (!button) return;
        const pose = this.ghosts.get(body.name)?.pose ?? state.poses[i];
        const size = Math.max(LEAST, 2 * body.reach * view.scale + 6);
        button.style.width = button.style.height = `${size}px`;
        button.style.transform = `translate(${view.x(pose[0]) - size / 2}px, ${view.y(pose[1]) - size / 2}px)`;
        const text = `${body.name}, ${body.what}, ${where(pose)}`;
        if (button.getAttribute("aria-label") !== text) { button.setAttribute("aria-label", text); button.title = text; }
        button.disabled = state.mood === "gone";
        if (body.name !== this.chosen) return;
        const away = size / 2 + HANDLE;
        const [x, y] = [view.x(pose[0]) + away * Math.cos(pose[2]), view.y(pose[1]) - away * Math.sin(pose[2])];
        this.handle.style.transform = `translate(${x - 11}px, ${y - 11}px)`;
      });
      this.handle.hidden = !this.chosen || state.mood === "gone";
    }

    close() {
      this.unwatch();
      this.driver.close();
    }
  }

  globalThis.rosminiView = { Page };
})();
