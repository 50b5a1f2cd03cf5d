/* A view whose simulation runs in a kernel: the driver behind `rosminiView.Page` in a live notebook.
   A plain script that sets `globalThis.rosminiViewKernel`; `render({ model, el })` is what anywidget calls.

   To the kernel:   {type: "hello"} a page has opened, {type: "beat"} it is still there, {type: "drag", name, to: [x, y, theta]},
                    {type: "pause"}, {type: "unpause"}, {type: "step"}, {type: "reset"}, {type: "start"}.
   From the kernel: {type: "frame", time, paused, scans} with a buffer of float64 (x, y, theta of each body), and, if `scans` is true, one of float32
                    (for each body with a laser: x, y, theta of the robot, then its ranges); {type: "scene", data} with a buffer of such scans when something has come or gone;
                    {type: "put", name, text} and {type: "refused", name, text} answer a drag; {type: "said", text} answers a button;
                    {type: "still"} nobody drives the graph; {type: "gone", text}. */

(() => {
  "use strict";

  const BEAT_MS = 250;
  const PATIENCE_MS = 1000;
  const { Page } = globalThis.rosminiView;

  class Kernel {
    constructor(model, data) {
      this.model = model;
      this.changed = () => {};
      this.put = () => {};
      this.begun = false; // whether frames are to be expected
      this.heard = performance.now();
      this.frames = 0;
      this.state = { mood: "ready", note: "ready", startable: false };
      this.know(data);
      this.receive = (content, buffers) => this.hear(content, buffers ?? []);
      model.on("msg:custom", this.receive);
      this.timer = setInterval(() => this.beat(), BEAT_MS);
      this.tell({ type: "hello" });
    }

    know({ scene, bodies, poses, scans, time, paused }) {
      Object.assign(this.state, { scene, bodies, poses, time, paused });
      this.look(scans);
    }

    look(buffer) {
      const all = floats(Float32Array, buffer);
      let at = 0;
      this.state.scans = this.state.bodies.filter((body) => body.laser && at < all.length).map(({ name, laser }) => {
        const pose = [...all.subarray(at, at + 3)];
        const ranges = all.subarray(at + 3, at + 3 + laser.beams);
        at += 3 + laser.beams;
        return { name, pose, ranges };
      });
    }

    tell(content) {
      try {
        this.model.send(content);
      } catch (error) {
        this.show("gone", "no kernel: run the cell of this view again");
      }
    }

    show(mood, note) {
      Object.assign(this.state, { mood, note });
      this.changed();
    }

    beat() {
      if (document.hidden) this.heard = performance.now(); // nobody looks, and no frames come
      if (this.over || document.hidden) return;
      this.tell({ type: "beat" });
      const silent = performance.now() - this.heard;
      if (silent < PATIENCE_MS) return;
      this.show("waiting", silent > 8 * PATIENCE_MS ? "waiting for the kernel; if it was restarted, run the cell of this view again" : "waiting for the kernel");
    }

    hear(content, buffers) {
      const { state } = this;
      this.heard = performance.now();
      switch (content.type) {
        case "frame":
          this.frames += 1;
          state.poses = triples(floats(Float64Array, buffers[0]));
          if (content.scans) this.look(buffers[1]);
          Object.assign(state, { time: content.time, paused: content.paused, startable: false });
          this.show(content.paused ? "ready" : "running", content.paused ? "time stands" : "running");
          break;
        case "scene":
          this.know({ ...content.data, scans: buffers[0] });
          this.changed();
          break;
        case "put":
        case "refused":
          if (content.name) this.put(content.name, content.type === "put", content.text);
          else this.say(content.text, false);
          break;
        case "said":
          this.say(content.text, true);
          break;
        case "still":
          state.startable = true;
          this.show("ready", "the graph stands still");
          break;
        default:
          this.over = true;
          state.startable = false;
          this.say(content.text, false);
          this.show("gone", "ended");
      }
    }

    say(text, good) {
      this.state.said = { text, good };
      this.changed();
    }

    drag(name, to) {
      this.tell({ type: "drag", name, to });
    }

    act(type) {
      this.tell({ type });
    }

    close() {
      clearInterval(this.timer);
      this.model.off("msg:custom", this.receive);
    }
  }

  function floats(Kind, buffer) {
    const { buffer: bytes, byteOffset: begin, byteLength: length } = buffer;
    return new Kind(bytes.slice(begin, begin + length)); // a view into a message need not lie on a multiple of 8
  }

  const triples = (flat) => Array.from({ length: flat.length / 3 }, (_, i) => [flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]]);

  function render({ model, el }) {
    const data = model.get("data");
    const kernel = new Kernel(model, data);
    const page = new Page(el, data, kernel);
    page.section.kernel = kernel; // for those who measure
    return () => page.close();
  }

  globalThis.rosminiViewKernel = { Kernel, render };
})();
