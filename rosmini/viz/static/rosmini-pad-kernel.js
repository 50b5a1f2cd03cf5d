/* A teleoperation pad whose keys go to a kernel, and whose picture comes from there: the driver behind `rosminiPad.Page` in a
   live notebook. A plain script that sets `globalThis.rosminiPadKernel`; `render({ model, el })` is what anywidget calls.

   To the kernel:  {type: "hello"} a page has opened, {type: "beat"} it is still there, {type: "key", key}, {type: "steer", linear, angular}, {type: "stop"} it is left, or its
                   keys are released, {type: "keys", name} other keys, {type: "choose", name} another robot,
                   {type: "reset"}, {type: "start"}.
   From the kernel: {type: "pad", data} another robot is driven; {type: "frame", messages, sent, at_rest, blocked, scan, keys, speed, others, choices?, pushed?, window?} with a buffer of seven float64 (target and command, each linear and
                   angular, and x, y, theta), and one of float32 (ranges, then x, y, theta of the robot at each beam) if `scan` is true;
                   {type: "trail"} with one of float32 (x, y, ...); {type: "still"} nobody drives the graph; {type: "gone", text} and
                   {type: "refused", text}. */

(() => {
  "use strict";

  const BEAT_MS = 250;
  const PATIENCE_MS = 1000;
  const { extend, Page } = globalThis.rosminiPad;

  class Kernel {
    constructor(model, data) {
      this.model = model;
      this.data = data;
      this.changed = () => {};
      this.begun = false; // whether frames are to be expected
      this.refused = ""; // why nothing was done, until the next thing that a hand does
      this.heard = performance.now();
      this.frames = 0;
      this.rates = [];
      this.state = {
        keys: data.keys, speed: [data.maps[0].linear.step, data.maps[0].angular.step], window: data.turtle?.state, windows: [], pose: data.pose, ranges: data.ranges ? floats(Float32Array, data.ranges) : null, scanFrom: null, trail: [], target: [0, 0], command: [0, 0], messages: [], sent: 0,
        mood: "ready", note: "press a key to start", startable: true,
      };
      this.receive = (content, buffers) => this.hear(content, buffers ?? []);
      model.on("msg:custom", this.receive);
      this.timer = setInterval(() => this.beat(), BEAT_MS);
      this.tell({ type: "hello" });
    }

    tell(content) {
      try {
        this.model.send(content);
      } catch (error) {
        this.show("gone", "no kernel: run the cell of this pad again");
      }
    }

    show(mood, note) {
      Object.assign(this.state, { mood, note });
      this.changed();
    }

    get waiting() {
      return this.begun && performance.now() - this.heard > PATIENCE_MS;
    }

    beat() {
      if (document.hidden) this.heard = performance.now(); // nobody looks, and no frames come
      if (this.over || !this.begun || document.hidden) return;
      this.tell({ type: "beat" });
      if (!this.waiting) return;
      const long = performance.now() - this.heard > 8 * PATIENCE_MS;
      this.show("waiting", long ? "waiting for the kernel; if it was restarted, run the cell of this pad again" : "waiting for the kernel");
    }

    hear(content, buffers) {
      const { state } = this;
      this.heard = performance.now();
      switch (content.type) {
        case "frame":
          this.frame(content, buffers);
          break;
        case "pad":
          // Not in the midst of those who are told of this message: the new page is one of them.
          queueMicrotask(() => this.opened(buffers[0] ? { ...content.data, ranges: buffers[0] } : content.data));
          break;
        case "trail":
          state.trail = pairs(floats(Float32Array, buffers[0]));
          this.changed();
          break;
        case "still":
          this.begun = false;
          state.startable = true;
          this.show("ready", "the graph stands still: press a key to start it");
          break;
        case "gone":
          this.over = true;
          Object.assign(state, { pose: null, ranges: null, startable: false, command: [0, 0], target: [0, 0] });
          this.show("gone", content.text);
          break;
        default:
          state.startable = true;
          this.refused = content.text;
          this.show("gone", content.text);
      }
    }

    frame(content, buffers) {
      const { state } = this;
      const [wantedLinear, wantedAngular, linear, angular, x, y, theta] = floats(Float64Array, buffers[0]);
      this.begun = true;
      this.frames += 1;
      this.rates.push(this.heard);
      while (this.heard - this.rates[0] > 1000) this.rates.shift();
      state.target = [wantedLinear, wantedAngular];
      state.command = [linear, angular];
      for (const [v, w, y = 0, z = 0] of content.messages) state.messages.push({ linear: v, angular: w, aside: [y, z] });
      [state.keys, state.speed] = [content.keys, content.speed];
      if (content.choices) state.choices = content.choices;
      state.messages.splice(0, state.messages.length - 8);
      state.sent = content.sent;
      state.startable = false;
      if (content.window) state.windows.push(state.window = content.window); // each has strokes that the others have not
      if (Number.isFinite(x)) {
        state.pose = [x, y, theta];
        extend(state.trail, state.pose);
      }
      if (content.pushed) {
        const { scene } = this.data; // what can be pushed is last among its shapes
        state.scene = { ...scene, shapes: [...scene.shapes.slice(0, scene.shapes.length - content.pushed.length), ...content.pushed] };
      }
      if (content.scan) {
        const all = floats(Float32Array, buffers[1]);
        const beams = all.length / 4;
        state.ranges = all.subarray(0, beams);
        state.scanFrom = (beam) => all.subarray(beams + 3 * beam, beams + 3 * beam + 3);
      }
      const mood = content.blocked ? "blocked" : content.at_rest ? "ready" : "driving";
      const driving = state.pose ? `driving, ${this.rates.length} frames/s` : "driving";
      const note = content.blocked ? state.window ? "Oh no! I hit the wall!" : "something is in the way" : content.at_rest ? "live" : driving;
      if (this.refused) this.show("gone", this.refused);
      else this.show(mood, content.others.length ? `${note}; ${content.others.join(", ")} drives too` : note);
    }

    press(key) {
      const stop = this.data.maps.some(({ stops }) => stops.includes(key));
      if (this.over || (this.waiting && !stop)) return; // it would move the robot when nobody expects it any more
      this.begin();
      this.tell({ type: "key", key });
    }

    steer(linear, angular) {
      if (this.over || this.waiting) return;
      this.begin();
      this.tell({ type: "steer", linear, angular });
    }

    use({ name }) {
      this.begin();
      this.tell({ type: "keys", name });
    }

    choose(name) {
      this.begin();
      this.tell({ type: "choose", name });
    }

    begin() {
      if (!this.begun) this.heard = performance.now();
      this.begun = true;
      this.refused = "";
    }

    start() {
      this.begin();
      this.tell({ type: "start" });
    }

    reset() {
      this.begin();
      this.state.trail.length = 0;
      this.tell({ type: "reset" });
    }

    leave() {
      if (this.begun && !this.over) this.tell({ type: "stop" });
    }

    close() {
      this.leave();
      clearInterval(this.timer);
      this.model.off("msg:custom", this.receive);
    }
  }

  function floats(Kind, buffer) {
    const { buffer: bytes, byteOffset: begin, byteLength: length } = buffer;
    return new Kind(bytes.slice(begin, begin + length)); // a view into a message need not lie on a multiple of 8
  }

  const pairs = (flat) => Array.from({ length: flat.length / 2 }, (_, i) => [flat[2 * i], flat[2 * i + 1]]);

  function render({ model, el }) {
    let page;
    const open = (data) => {
      page?.close();
      const kernel = new Kernel(model, data);
      kernel.opened = open;
      page = new Page(el, data, kernel);
      page.section.kernel = kernel; // for those who measure
      if (data !== model.get("data")) page.stage.focus({ preventScroll: true });
    };
    open(model.get("data"));
    return () => page.close();
  }

  globalThis.rosminiPadKernel = { Kernel, render };
})();
