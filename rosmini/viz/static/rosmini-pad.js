/* The teleoperation pad in a page: keys, buttons, touch; what the robot sees; the messages.

   A plain script that sets `globalThis.rosminiPad`; it needs rosmini-canvas.js, rosmini-teleop.js,
   rosmini-pad-style.js and rosmini-pad-keys.js before it.

     mount(host, data)              a pad that drives by itself, in a page without a kernel
     new Page(host, data, driver)   a pad before another driver: rosmini-pad-kernel.js has one


   `data` is what `rosmini.viz.live.page` makes: {maps, keys, hold, topic, title, scene, pose, step, scan_rate}; without a robot
   `scene` and `pose` are null, and only the messages are shown.

   A driver is what stands behind the page: press(key), steer(linear, angular), use(map), choose(name), leave(), reset(), close(), and `state`, which the page draws whenever
   the driver calls `changed()`: {keys, speed, pose, ranges, scanFrom, scene, trail, target, command, messages, sent, mood, note, startable}. */

(() => {
  "use strict";

  const SHOWN = 3; // messages
  const REPEAT_AFTER_MS = 400; // a button that is held repeats, as a key does
  const REPEAT_MS = 100;
  const SPEAK_AFTER_MS = 900; // so long without a key before the status is spoken: a screen reader would fall behind
  const STEER_MS = 100; // between two messages of a gamepad that says the same
  const TRAIL_STEP = 0.02; // metres
  const TRAIL_JUMP = 0.3; // a longer way between two points was not driven
  const TRAIL_POINTS = 3000;

  let pads = 0;

  const { yaml } = globalThis.rosminiTeleop;
  const { element, grid, keyOf, buttonOf, instructions, Gamepads } = globalThis.rosminiPadKeys;
  const degrees = (radians) => {
    const turned = ((((radians * 180) / Math.PI + 180) % 360) + 360) % 360 - 180;
    return (turned === -180 ? 180 : turned).toFixed(0).replace(/^-0$/, "0");
  };
  const fixed = (value, digits) => value.toFixed(digits).replace(/^-(0\.0+)$/, "$1");

  /* The way so far, in points that are worth a line. */
  function extend(trail, [x, y]) {
    const last = trail.at(-1);
    const gone = last ? Math.hypot(x - last[0], y - last[1]) : Infinity;
    if (gone > TRAIL_JUMP) trail.length = 0;
    if (gone < TRAIL_STEP) return;
    trail.push([x, y]);
    if (trail.length > TRAIL_POINTS) trail.splice(0, TRAIL_POINTS / 10);
  }

  /* Have a select offer these names. */
  function offer(select, names, chosen) {
    select.replaceChildren(...names.map((name) => element("option", { value: name }, name)));
    select.value = chosen;
  }

  class Page {
    constructor(host, data, driver) {
      this.data = data;
      this.driver = driver;
      this.map = data.maps.find(({ name }) => name === data.keys);
      this.down = new Map(); // buttons that are held, and their timers
      this.spoken = "";
      this.mood = driver.state.mood; // nothing is said of how it begins
      this.build(host);
      this.listen();
      this.fit();
      this.unwatch = globalThis.rosminiCanvas.watch(data.scene || data.turtle ? this.canvas : this.stage, () => { this.fit(); this.draw(); });
      driver.changed = () => this.request();
      this.draw();
    }

    // -- building ---------------------------------------------------------------------------------------------------

    build(host) {
      const { data } = this;
      const id = `rosmini-pad-${(pads += 1)}`;
      ({ keys: this.keys, buttons: this.buttons } = grid(this.map));
      this.meters = ["linear", "angular"].map((name) => this.meter(name));
      this.resetButton = element("button", { type: "button", class: "rp-plain", "data-act": "reset" }, "Back to the start");
      this.startButton = element("button", { type: "button", class: "rp-plain", "data-act": "start" }, "Start");
      this.startButton.hidden = true;
      this.canvas = element("canvas", { role: "img", "aria-label": data.turtle ? "The window with the turtles and what they drew" : "The world from above, with the robot, its laser and its way" });
      this.hint = element("div", { class: "rp-hint", "aria-hidden": "true" });
      this.hint.append("Click here to drive");
      this.pill = element("div", { class: "rp-pill", "aria-hidden": "true" }, element("i"), element("span"));
      this.pose = element("span", { class: "rp-value" });
      this.seen = element("span", { class: "rp-value" });
      this.readings = element(
        "div", { class: "rp-readings" },
        element("div", {}, element("span", { class: "rp-name" }, "Pose"), this.pose),
        element("div", {}, element("span", { class: "rp-name" }, "Laser"), this.seen),
      );
      const sight = element("div", { class: "rp-sight" }, this.pill, this.hint);
      if (data.scene || data.turtle) sight.prepend(this.canvas);
      const actions = element("div", { class: "rp-actions" }, this.startButton);
      if (data.scene || data.turtle) actions.append(this.resetButton);
      if (data.turtle) {
        this.paper = new globalThis.rosminiTurtle.Paper(this.canvas, data.turtle);
        this.resetButton.textContent = "Reset";
      }
      this.speed = element("span", { class: "rp-name" });
      this.log = element("div", { class: "rp-log" });
      this.count = element("em");
      const command = (topic, ...more) => element("div", { class: "rp-command" }, element("span", {}, "$ "), `rostopic echo ${topic}`, ...more);
      const messages = element( // what is read, not operated: screen readers browse it
        "div", { class: "rp-messages", role: "document", "aria-label": "Messages" }, command(data.topic, this.count), this.log,
      );
      if (data.turtle) {
        this.poses = element("div", { class: "rp-log rp-poses" });
        messages.append(command(data.turtle.pose_topic), this.poses);
      }
      this.stage = element(
        "div",
        {
          class: "rp-stage", tabindex: "0", role: "application", "aria-roledescription": "driving pad",
          "aria-label": data.title, "aria-describedby": `${id}-help`, "data-lm-suppress-shortcuts": "true",
        },
        sight,
        ...(data.scene ? [this.readings] : []),
        element(
          "div", { class: "rp-side" }, this.keys,
          element(
            "div", { class: "rp-gauges" },
            element("div", { class: "rp-meters" }, ...this.meters.map((m) => m.box)), this.speed, actions,
          ),
          ...(data.turtle ? [] : [messages]),
        ),
        ...(data.turtle ? [messages] : []),
      );
      this.help = element("p", { class: "rp-help", id: `${id}-help` }, ...instructions(this.map));
      this.status = element("p", { class: "rp-spoken", role: "status" });
      this.section = element("section", { class: `rosmini-pad${data.scene ? "" : data.turtle ? " rp-turtles" : " rp-blind"}`, "aria-label": "Teleoperation pad" });
      this.section.append(this.stage, this.options(), this.help, this.status);
      if (!document.getElementById("rosmini-pad-style")) {
        const sheet = element("style", { id: "rosmini-pad-style" }, globalThis.rosminiPadStyle);
        document.head.append(sheet);
      }
      host.replaceChildren(this.section);
    }

    meter(name) {
      const [label, unit] = name === "linear" ? ["ahead", "m/s"] : ["turn", "rad/s"];
      const value = element("span", { class: "rp-value" });
      const bar = element("i", { class: "rp-bar" });
      const mark = element("i", { class: "rp-mark" });
      const box = element(
        "div", { class: "rp-meter" },
        element("span", { class: "rp-name" }, label), value,
        element("div", { class: "rp-scale", "aria-hidden": "true" }, bar, mark),
      );
      return { box, value, bar, mark, unit, max: this.map[name].max };
    }

    /* What is driven, with whose keys, and whether they have to be held. */
    options() {
      const { data } = this;
      const choice = (label, names, chosen, act) => {
        const select = element("select", { "aria-label": label });
        offer(select, names, chosen);
        select.addEventListener("change", () => { act(select.value); this.chosen(select); });
        return element("label", {}, element("span", { class: "rp-name" }, label), select);
      };
      this.hold = element("input", { type: "checkbox" });
      this.hold.checked = data.hold;
      this.hold.addEventListener("change", () => this.chosen(this.hold));
      const box = element("div", { class: "rp-options" });
      this.drive = choice("Drive", data.choices ?? [], data.chosen, (name) => this.driver.choose(name));
      this.drive.hidden = (data.choices ?? []).length < 2;
      box.append(this.drive);
      const keys = choice("Keys of", data.maps.map(({ name }) => name), this.map.name, (name) => {
        this.driver.use(data.maps.find((map) => map.name === name));
      });
      this.chooseKeys = keys.lastChild;
      box.append(keys, element("label", { title: "A dead man's switch: the robot stops when no key is held" }, this.hold, "hold to drive"));
      return box;
    }

    /* After a choice with the pointer the keys drive. Someone who chooses with keys may not be done, and stays. */
    chosen(control) {
      if (!control.matches(":focus-visible")) this.stage.focus({ preventScroll: true });
    }

    /* Have the buttons and the words of other keys. */
    use(name) {
      this.liftAll();
      this.map = this.data.maps.find((map) => map.name === name);
      this.chooseKeys.value = name;
      const { keys, buttons } = grid(this.map);
      this.keys.replaceWith(keys);
      [this.keys, this.buttons] = [keys, buttons];
      this.help.replaceChildren(...instructions(this.map));
    }

    // -- keys, buttons, touch -----------------------------------------------------------------------------------------

    listen() {
      const { stage } = this;
      stage.addEventListener("keydown", (event) => this.keydown(event));
      stage.addEventListener("keyup", (event) => this.lift(keyOf(this.map, event)));
      stage.addEventListener("pointerdown", (event) => this.pointerdown(event));
      stage.addEventListener("contextmenu", (event) => { if (event.target.closest(".rp-key")) event.preventDefault(); });
      for (const kind of ["pointerup", "pointercancel"]) stage.addEventListener(kind, () => { this.liftAll(); this.released(); });
      this.pressed = new Set();
      this.gamepads = new Gamepads((sticks) => this.steer(sticks));
      stage.addEventListener("click", (event) => {
        const button = event.target.closest("button");
        if (!button) return;
        // A press of a pointer has been taken already; this one is from the Enter key or from an assistive tool.
        if (button.dataset.key) { if (event.detail === 0) this.press(button.dataset.key); }
        else this.act(button.dataset.act);
      });
      stage.addEventListener("focusin", () => this.section.classList.add("rp-held"));
      stage.addEventListener("focusout", (event) => {
        if (!stage.contains(event.relatedTarget)) { this.section.classList.remove("rp-held"); this.leave(); }
      });
      this.leave = () => { this.liftAll(); this.driver.leave(); };
      this.hide = () => { if (document.hidden) this.leave(); };
      globalThis.addEventListener("blur", this.leave);
      globalThis.addEventListener("pagehide", this.leave);
      document.addEventListener("visibilitychange", this.hide);
      this.seenBy = new IntersectionObserver((entries) => { if (!entries.at(-1).isIntersecting) this.leave(); });
      this.seenBy.observe(this.stage);
    }

    keydown(event) {
      if (event.key === "Escape") { document.activeElement.blur(); return; }
      const key = keyOf(this.map, event);
      if (key === undefined) return;
      event.preventDefault(); // the page does not scroll, and space does not press a button
      event.stopPropagation();
      this.press(key);
      this.pressed.add(key);
      buttonOf(this.map, this.buttons, key)?.classList.add("rp-down");
    }

    lift(key) {
      if (!this.pressed.delete(key)) return;
      buttonOf(this.map, this.buttons, key)?.classList.remove("rp-down");
      this.released();
    }

    /* A dead man's switch: with no key held any more the robot stops. */
    released() {
      if (this.hold.checked && !this.pressed.size && !this.down.size) this.driver.leave();
    }

    /* Drive by the sticks of a gamepad, while the pad has the focus; null: its switch was released. */
    steer(sticks) {
      if (!sticks) { this.driver.leave(); this.speak(); return; }
      if (!this.section.classList.contains("rp-held")) return;
      const now = performance.now();
      if (String(sticks) === this.sticks && now - this.steered < STEER_MS) return;
      [this.sticks, this.steered] = [String(sticks), now];
      const { linear, angular } = this.map;
      this.driver.steer(sticks[0] * linear.max, sticks[1] * angular.max);
      this.speak();
    }

    liftAll() {
      for (const timer of this.down.values()) clearTimeout(timer);
      this.down.clear();
      this.pressed.clear();
      for (const button of this.buttons.values()) button.classList.remove("rp-down");
    }

    pointerdown(event) {
      const button = event.target.closest("button");
      if (button?.dataset.act) return;
      event.preventDefault();
      // The keys take over from the pointer: the focus goes to the pad, not to a button, which space would press again.
      this.stage.focus({ preventScroll: true });
      if (!button || event.button !== 0) return;
      const { key } = button.dataset;
      const again = () => {
        this.press(key);
        this.down.set(key, setTimeout(again, REPEAT_MS));
      };
      this.liftAll();
      this.press(key);
      this.down.set(key, setTimeout(again, REPEAT_AFTER_MS));
      button.classList.add("rp-down");
    }

    press(key) {
      this.driver.press(key);
      this.speak();
    }

    act(what) {
      if (what === "reset") this.driver.reset();
      else this.driver.start();
      this.stage.focus({ preventScroll: true });
      this.speak();
    }

    // -- drawing ------------------------------------------------------------------------------------------------------

    fit() {
      this.paint(); // the canvas reads its colours from the pad
      if (!this.data.scene) return;
      this.view = globalThis.rosminiCanvas.fit(this.canvas, this.data.scene.bounds, { maxHeight: 440 });
    }

    /* The palette of the page around the pad holds in it, whether that page has our style sheet or not. */
    paint() {
      for (const [name, value] of Object.entries(globalThis.rosminiCanvas.theme(this.section.parentElement))) {
        this.section.style.setProperty(`--rosmini-${name}`, value);
      }
    }

    request() {
      if (this.asked) return;
      this.asked = true;
      requestAnimationFrame(() => { this.asked = false; this.draw(); });
    }

    draw() {
      const { state } = this.driver;
      const { scene } = this.data;
      if (scene) {
        const { world, trail, scan, robot, scaleBar } = globalThis.rosminiCanvas;
        world(this.view, state.scene ?? scene);
        trail(this.view, [...state.trail, ...(state.pose ? [state.pose] : [])]);
        if (state.pose) {
          if (state.ranges) scan(this.view, scene.robot, state.scanFrom ?? (() => state.pose), state.ranges);
          robot(this.view, scene.robot, state.pose);
        }
        scaleBar(this.view);
        this.readings.hidden = !state.pose;
        if (state.pose) { this.read(state); }
      }
      if (this.paper && state.window) {
        for (const window of state.windows?.splice(0) ?? []) this.paper.paint(window);
        this.paper.draw(state.window);
        this.poses.replaceChildren(element("pre", {}, this.paper.message(state.window)));
      }
      if (state.keys !== this.map.name) this.use(state.keys);
      if (state.choices) { // robots and turtles come and go
        offer(this.drive.lastChild, state.choices, this.data.chosen);
        this.drive.hidden = state.choices.length < 2;
        state.choices = null;
      }
      this.speed.textContent = !Object.keys(this.map.factors).length ? "" : `currently: speed ${state.speed[0]}, turn ${state.speed[1]}`;
      this.meters.forEach(({ value, bar, mark, unit, max }, i) => {
        const [sent, wanted] = [state.command[i], state.target[i]];
        const digits = i === 0 ? 2 : 1;
        value.textContent = `${fixed(wanted, digits)} ${unit}`;
        const share = (50 * sent) / max;
        bar.style.left = `${50 + Math.min(0, i === 0 ? share : -share)}%`;
        bar.style.width = `${Math.abs(share)}%`;
        mark.style.left = `${50 + ((i === 0 ? 50 : -50) * wanted) / max}%`;
      });
      this.pill.dataset.mood = state.mood;
      this.pill.lastChild.textContent = state.note;
      this.startButton.hidden = !state.startable;
      this.section.classList.toggle("rp-driving", state.mood === "driving");
      this.echo(state);
      if (state.mood !== this.mood) { this.mood = state.mood; this.speak(); }
    }

    read(state) {
      const [x, y, theta] = state.pose;
      this.pose.textContent = `x ${fixed(x, 2)} m, y ${fixed(y, 2)} m, ${degrees(theta)}°`;
      if (!state.ranges) { this.seen.textContent = "no scan yet"; return; }
      const hits = [...state.ranges.keys()].filter((i) => state.ranges[i] > 0 && Number.isFinite(state.ranges[i]));
      const { start = 0, step = (2 * Math.PI) / state.ranges.length } = this.data.scene.robot.lidar;
      const nearest = hits.reduce((best, i) => (state.ranges[i] < state.ranges[best] ? i : best), hits[0]);
      this.seen.textContent = hits.length
        ? `nearest ${state.ranges[nearest].toFixed(2)} m at ${degrees(start + step * nearest)}°, ` +
          `${hits.length} of ${state.ranges.length} beams hit`
        : `no hit within ${this.data.scene.robot.lidar.max} m`;
    }

    echo({ messages, sent }) {
      this.count.textContent = sent ? `${sent} ${sent === 1 ? "message" : "messages"}` : "";
      if (this.sent === sent) return;
      this.sent = sent;
      const texts = messages.slice(-SHOWN).map(yaml);
      if (!texts.length) { this.log.replaceChildren(element("p", {}, "Nothing has been published yet.")); return; }
      this.log.replaceChildren(...texts.map((text) => element("pre", {}, text)));
    }

    /* Tell those who do not see it how things are, once the keys rest. */
    speak() {
      clearTimeout(this.speaking);
      this.speaking = setTimeout(() => {
        const text = this.summary();
        if (text !== this.spoken) this.status.textContent = this.spoken = text;
      }, SPEAK_AFTER_MS);
    }

    summary() {
      const { target: [linear, angular], note, mood } = this.driver.state;
      const parts = [];
      if (linear) parts.push(`${linear > 0 ? "forward" : "backward"} ${Math.abs(linear).toFixed(2)} metres a second`);
      if (angular) parts.push(`turning ${angular > 0 ? "left" : "right"} ${Math.abs(angular).toFixed(1)} radians a second`);
      const driving = parts.length ? parts.join(", ") : "stopped";
      return mood === "driving" || mood === "ready" ? driving : `${note}; ${driving}`;
    }

    close() {
      this.liftAll();
      clearTimeout(this.speaking);
      this.unwatch();
      this.gamepads.close();
      this.seenBy.disconnect();
      globalThis.removeEventListener("blur", this.leave);
      globalThis.removeEventListener("pagehide", this.leave);
      document.removeEventListener("visibilitychange", this.hide);
      this.driver.close();
    }
  }

  // -- without a kernel -------------------------------------------------------------------------------------------------

  /* Drives a robot of its own, as fast as the clock on the wall, and only while there is something to drive. */
  class OwnRobot {
    constructor(data) {
      this.run = data.turtle ? globalThis.rosminiTurtle.run(data) : new globalThis.rosminiTeleop.Run(data);
      this.trail = [];
      this.changed = () => {};
      this.update();
    }

    update() {
      const { run } = this;
      const { pose = null, blocked = false } = run.robot ?? {};
      if (pose) extend(this.trail, pose);
      const still = run.atRest;
      this.state = {
        pose, ranges: run.ranges, scanFrom: () => run.scanPose, trail: this.trail,
        keys: run.map.name, speed: run.teleop.speed, target: run.teleop.target, command: run.teleop.command, messages: run.messages, sent: run.sent,
        mood: blocked ? "blocked" : still ? "ready" : "driving",
        note: blocked ? run.robot.hit ?? "something is in the way" : still ? "ready" : "driving",
        window: run.robot?.window,
      };
      this.changed();
    }

    press(key) {
      this.run.press(key);
      this.go();
    }

    steer(linear, angular) {
      this.run.steer(linear, angular);
      this.go();
    }

    use(map) {
      this.leave();
      this.run.use(map);
      this.update();
    }

    reset() {
      this.run.reset();
      this.trail.length = 0;
      this.update();
    }

    leave() {
      if (!this.run.teleop.atRest) this.press(" ");
    }

    go() {
      this.update();
      if (this.frame !== undefined) return;
      let last = performance.now();
      const turn = (now) => {
        this.run.advance(Math.min(Math.max(now - last, 0), 100) / 1000);
        last = now;
        this.update();
        this.frame = this.run.atRest ? undefined : requestAnimationFrame(turn);
      };
      this.frame = requestAnimationFrame(turn);
    }

    close() {
      if (this.frame !== undefined) cancelAnimationFrame(this.frame);
    }
  }

  function mount(host, data) {
    return new Page(host, data, new OwnRobot(data));
  }

  globalThis.rosminiPad = { Page, OwnRobot, mount, extend };
})();
