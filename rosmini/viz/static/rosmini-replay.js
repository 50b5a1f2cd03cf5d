/* The replay player: a recorded run of a robot, to play, to scrub and to look at closely.

   A plain script that needs `rosmini-canvas.js` and sets `globalThis.rosminiReplay`:

     mount(host, data, options)   puts a player into an empty element; `data` is what `rosmini.viz.replay.encode`
                                  made, `options` has `title` and `alt`.
     decode(data)                 the run in metres, radians and seconds.
     beamPose(run, time, beam)    where the robot of a decoded run was at a beam of the scan that has this time.

   It plays when it is told to. Its root element says how it is: data-state (playing, paused), data-time, data-speed. */

(() => {
  "use strict";

  const SPEEDS = [0.25, 0.5, 1, 2, 4, 8];
  const STEP = 0.2; // seconds: from one scan of TurtleBot3's laser to the next
  const CALM = 500; // milliseconds between two pictures, for those who want less motion
  const ICONS = {
    back: "M4 4h3v16H4zM20 4v16L8 12z",
    play: "M6 3.5v17L20 12z",
    pause: "M5 4h5v16H5zM14 4h5v16h-5z",
    forward: "M17 4h3v16h-3zM4 4v16l12-8z",
  };

  const STYLE = `
.rosmini-replay{background:var(--page);border:1px solid color-mix(in srgb,var(--group-line) 55%,transparent);
border-radius:8px;box-sizing:border-box;color:var(--ink);font:14px/1.4 var(--rosmini-font,system-ui,sans-serif);overflow:hidden}
.rosmini-replay *{box-sizing:border-box}
.rosmini-replay canvas{cursor:pointer;touch-action:manipulation}
.rosmini-replay .rr-row{align-items:center;display:flex;flex-wrap:wrap;gap:.4rem .6rem;padding:.45rem .7rem}
.rosmini-replay .rr-bar{background:var(--group-fill);border-top:1px solid color-mix(in srgb,var(--group-line) 40%,transparent)}
.rosmini-replay .rr-buttons{display:flex;gap:.25rem}
.rosmini-replay button{align-items:center;background:transparent;border:0;border-radius:6px;color:var(--ink);cursor:pointer;
display:inline-flex;height:38px;justify-content:center;margin:0;padding:0;width:38px}
.rosmini-replay button[data-do=play]{background:var(--blue);color:var(--page)}
.rosmini-replay button:hover:not(:disabled){background:color-mix(in srgb,var(--blue) 18%,transparent)}
.rosmini-replay button[data-do=play]:hover:not(:disabled){background:color-mix(in srgb,var(--blue) 85%,var(--ink))}
.rosmini-replay :disabled{cursor:default;opacity:.45}
.rosmini-replay svg{fill:currentColor;height:18px;width:18px}
.rosmini-replay input,.rosmini-replay select{accent-color:var(--blue);font:inherit;margin:0}
.rosmini-replay input[type=range]{flex:1 1 11rem;height:28px;min-width:0}
.rosmini-replay select{background:var(--page);border:1px solid var(--group-line);border-radius:6px;color:var(--ink);
height:32px;margin-left:auto;padding:0 .3rem;width:auto}
.rosmini-replay :focus-visible{border-radius:6px;outline:2px solid var(--blue);outline-offset:2px}
.rosmini-replay output,.rosmini-replay dd{font-variant-numeric:tabular-nums;white-space:nowrap}
.rosmini-replay label{align-items:center;cursor:pointer;display:inline-flex;gap:.35rem;margin:0;min-height:28px}
.rosmini-replay [hidden]{display:none}
.rosmini-replay .rr-layers{gap:.1rem .8rem;padding-bottom:.1rem}
.rosmini-replay i{border-top:2px solid;display:inline-block;width:18px}
.rosmini-replay i.truth{border-color:var(--blue)}
.rosmini-replay i.odom{border-color:var(--orange);border-top-style:dashed}
.rosmini-replay i.scan{border-top:3px dotted var(--vermilion)}
.rosmini-replay .rr-keys{color:var(--muted);flex:1;font-size:12px;text-align:right;white-space:nowrap}
.rosmini-replay kbd{all:unset;border:1px solid var(--group-line);border-radius:3px;padding:0 .3em}
.rosmini-replay dl{display:grid;gap:.1rem 1.2rem;grid-auto-flow:column;grid-template-rows:auto auto;justify-content:start;
margin:0;padding:.2rem .7rem .6rem}
.rosmini-replay dl div{display:flex;gap:.5rem}
.rosmini-replay dt{color:var(--muted);flex:0 0 5.4rem;font-weight:400;margin:0}
.rosmini-replay dd{margin:0;min-width:10.5rem}
.rosmini-replay [role=status]{clip-path:inset(50%);height:1px;margin:0;overflow:hidden;position:absolute;width:1px}
@container (max-width:620px){.rosmini-replay .rr-keys{display:none}.rosmini-replay dl{grid-auto-flow:row;grid-template-rows:none}}`;

  const icon = (name) => `<svg viewBox="0 0 24 24" aria-hidden="true"><path d="${ICONS[name]}"/></svg>`;
  const button = (name, label, key) =>
    `<button type="button" data-do="${name}" aria-label="${label}" title="${label} (${key})">${icon(name)}</button>`;
  const layer = (name, label) =>
    `<label><input type="checkbox" data-layer="${name}" checked><i class="${name}"></i>${label}</label>`;
  const reading = (name, label) => `<div><dt>${label}</dt><dd data-read="${name}"></dd></div>`;
  const CONTENT = `
<canvas role="img"></canvas>
<div class="rr-row rr-bar">
<span class="rr-buttons">${button("back", "Step back", "left arrow")}${button("play", "Play", "space")}${button("forward", "Step forward", "right arrow")}</span>
<input type="range" step="any" aria-label="Time">
<output></output>
<select aria-label="Speed">${SPEEDS.map((speed) => `<option value="${speed}">${speed}\u00d7</option>`).join("")}</select>
</div>
<div class="rr-row rr-layers">${layer("truth", "True path")}${layer("odom", "Odometry")}${layer("scan", "Laser")}
<span class="rr-keys"><kbd>space</kbd> <kbd>\u2190</kbd> <kbd>\u2192</kbd> <kbd>Home</kbd> <kbd>End</kbd> <kbd>+</kbd> <kbd>\u2212</kbd></span></div>
<dl>${reading("truth", "Robot")}${reading("odom", "Odometry")}${reading("error", "Off by")}${reading("command", "Command")}</dl>
<p role="status"></p>`;

  /* What `pack` of rosmini/viz/replay/encode.py wrote, times `unit`. */
  function unpack(text, unit) {
    const bytes = atob(text);
    const values = [];
    let [value, folded, factor] = [0, 0, 1];
    for (let i = 0; i < bytes.length; i += 1) {
      const byte = bytes.charCodeAt(i);
      folded += (byte & 127) * factor;
      factor *= 128;
      if (byte & 128) continue;
      value += folded % 2 ? -(folded + 1) / 2 : folded / 2;
      values.push(value * unit);
      [folded, factor] = [0, 1];
    }
    return values;
  }

  const LENGTH = 1e-3;
  const ANGLE = 1e-4;
  const TIME = 1e-3;
  const NANOSECOND = 1e-9;

  /* Three columns that lie one after another, as rows. */
  function rows(text, ...units) {
    const values = unpack(text, 1);
    const count = values.length / 3;
    return Array.from({ length: count }, (_, i) => units.map((unit, column) => values[i + column * count] * unit));
  }

  function decode(data) {
    const ranges = unpack(data.scans, LENGTH);
    const beams = data.scene.robot.lidar?.beams ?? 1;
    const tracked = (items) => (items ?? []).map((item) => ({ ...item, track: rows(item.track, LENGTH, LENGTH, ANGLE) }));
    return {
      scene: data.scene,
      start: data.start * TIME,
      end: (data.start + data.duration) * TIME,
      truth: rows(data.truth, LENGTH, LENGTH, ANGLE),
      odom: rows(data.odom, LENGTH, LENGTH, ANGLE),
      commands: rows(data.commands, TIME, LENGTH, ANGLE),
      name: data.name ?? "",
      others: tracked(data.others),
      things: tracked(data.things),
      increment: (data.time_increment ?? 0) * NANOSECOND,
      scans: unpack(data.scan_times, TIME).map((time, i) => [time, ranges.slice(i * beams, (i + 1) * beams)]),
    };
  }

  /* The last of `items`, ordered by their first element, that is not after `time`. */
  function latest(items, time) {
    let [low, high] = [0, items.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (items[middle][0] <= time + 1e-9) low = middle + 1;
      else high = middle;
    }
    return items[low - 1];
  }

  /* The part of the world that the run is about: all that its laser may have seen, and where it drove. */
  function bounds(run) {
    const points = run.truth.concat(run.odom, ...run.others.map((other) => other.track));
    const [xs, ys] = [0, 1].map((axis) => points.map((point) => point[axis]));
    const least = (values) => values.reduce((a, b) => Math.min(a, b));
    const most = (values) => values.reduce((a, b) => Math.max(a, b));
    const [left, bottom, right, top] = run.scene.bounds;
    const sight = run.scene.robot.lidar?.max ?? 3.5;
    const [x0, y0, x1, y1] = [least(xs), least(ys), most(xs), most(ys)];
    return [
      Math.max(Math.min(left, x0), x0 - sight), Math.max(Math.min(bottom, y0), y0 - sight),
      Math.min(Math.max(right, x1), x1 + sight), Math.min(Math.max(top, y1), y1 + sight),
    ];
  }

  const reach = (robot) => Math.max(...robot.footprint.map(([x, y]) => Math.hypot(x, y)));
  const number = (value, digits) => {
    const text = Math.abs(value).toFixed(digits);
    return value < 0 && Number(text) !== 0 ? `\u2212${text}` : text;
  };
  const half = (angle) => angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
  const degrees = (angle) => number((half(angle) * 180) / Math.PI, 1);
  const place = ([x, y, theta]) => `${number(x, 2)}, ${number(y, 2)} m, ${degrees(theta)}\u00b0`;

  /* A pose of a track at a time: tracks are sampled at even times, and straight in between. */
  function poseAt(run, track, time) {
    const position = sampleAt(run, time);
    const i = Math.max(0, Math.min(Math.floor(position), track.length - 2));
    const [from, to] = [track[i], track[i + 1] ?? track[i]];
    return from.map((value, axis) => value + (position - i) * (to[axis] - value));
  }

  /* Where the robot was at a beam of the scan of a time: the beams of a sweep are measured one after another. */
  const beamPose = (run, time, beam) =>
    poseAt(run, run.truth, Math.min(run.end, Math.max(run.start, time + beam * run.increment)));

  const sampleAt = (run, time) =>
    run.end > run.start ? ((time - run.start) / (run.end - run.start)) * (run.truth.length - 1) : 0;

  /* What is so at a time, in words: where the robot is, where odometry puts it, and what it was told last. */
  function readings(run, time) {
    const [truth, odom] = [poseAt(run, run.truth, time), poseAt(run, run.odom, time)];
    const command = latest(run.commands, time);
    const off = Math.hypot(odom[0] - truth[0], odom[1] - truth[1]);
    return {
      truth: place(truth),
      odom: place(odom),
      error: `${number(off, 3)} m, ${degrees(odom[2] - truth[2])}\u00b0`,
      command: command ? `${number(command[1], 2)} m/s, ${number(command[2], 2)} rad/s` : "none yet",
    };
  }

  function build(host, options) {
    const root = document.createElement("div");
    root.className = "rosmini-replay";
    root.setAttribute("role", "group");
    root.setAttribute("aria-label", options.title);
    root.innerHTML = CONTENT;
    root.querySelector("canvas").setAttribute("aria-label", options.alt);
    // JupyterLab's shortcuts match what has the focus itself, so each control has to say that its keys are its own.
    for (const element of root.querySelectorAll("button, input, select")) element.dataset.lmSuppressShortcuts = "";
    const style = document.createElement("style");
    style.textContent = STYLE;
    host.style.containerType = "inline-size";
    host.append(style, root);
    return root;
  }

  class Player {
    constructor(host, data, options) {
      this.run = decode(data);
      this.box = bounds(this.run);
      this.root = build(host, options);
      const find = (selector) => this.root.querySelector(selector);
      this.find = find;
      [this.canvas, this.slider, this.clock] = [find("canvas"), find("[type=range]"), find("output")];
      this.layers = { truth: true, odom: true, scan: this.run.scans.length > 0 };
      this.calm = matchMedia("(prefers-reduced-motion: reduce)");
      [this.time, this.playing, this.visible] = [this.run.start, false, true];
      [this.view, this.request, this.ticked, this.drawn] = [null, 0, 0, -Infinity];

      const { start, end } = this.run;
      Object.assign(this.slider, { min: start, max: end });
      for (const element of this.root.querySelectorAll("button, [type=range]")) element.disabled = end <= start;
      find("[data-layer=scan]").closest("label").hidden = !this.layers.scan;
      this.root.dataset.state = "paused";
      this.setSpeed(1);
      this.listen();
      this.paint();
    }

    listen() {
      const { root, canvas, slider } = this;
      const deeds = {
        play: () => this.setPlaying(!this.playing),
        back: () => this.seek(this.time - STEP),
        forward: () => this.seek(this.time + STEP),
      };
      const keys = {
        " ": deeds.play,
        ArrowLeft: deeds.back, ArrowDown: deeds.back, ArrowRight: deeds.forward, ArrowUp: deeds.forward,
        Home: () => this.seek(this.run.start), End: () => this.seek(this.run.end),
        "+": () => this.changeSpeed(1), "=": () => this.changeSpeed(1),
        "-": () => this.changeSpeed(-1), "_": () => this.changeSpeed(-1),
      };
      root.addEventListener("keydown", (event) => {
        const { target, key } = event;
        const own = target.matches("select") || (key === " " && target.matches("button, [type=checkbox]"));
        if (own || event.ctrlKey || event.altKey || event.metaKey || !(key in keys)) return;
        event.preventDefault();
        event.stopPropagation();
        keys[key]();
      });
      root.addEventListener("click", (event) => deeds[event.target.closest("[data-do]")?.dataset.do]?.());
      root.addEventListener("change", ({ target }) => {
        if (target.dataset.layer) this.layers[target.dataset.layer] = target.checked;
        else if (target.matches("select")) this.setSpeed(Number(target.value));
        else this.seek(slider.valueAsNumber);
        this.ask();
      });
      slider.addEventListener("input", () => this.seek(slider.valueAsNumber, false));
      canvas.addEventListener("click", () => {
        slider.focus({ preventScroll: true });
        deeds.play();
      });
      globalThis.rosminiCanvas.watch(canvas, () => {
        this.view = null;
        this.ask();
      });
      new IntersectionObserver((entries) => {
        this.visible = entries.at(-1).isIntersecting;
        this.ticked = performance.now();
        this.ask();
      }, { rootMargin: "100px" }).observe(root);
    }

    setPlaying(value) {
      const { start, end } = this.run;
      if (value && this.time >= end) this.time = start;
      this.playing = value && end > start;
      this.ticked = performance.now();
      this.root.dataset.state = this.playing ? "playing" : "paused";
      const [button, name] = [this.find("[data-do=play]"), this.playing ? "Pause" : "Play"];
      button.innerHTML = icon(name.toLowerCase());
      button.setAttribute("aria-label", name);
      button.title = `${name} (space)`;
      this.say(this.playing ? "Playing" : `${this.time >= end ? "End" : "Paused"}: ${this.where()}`);
      this.ask();
    }

    seek(time, speak = true) {
      this.time = Math.min(this.run.end, Math.max(this.run.start, time));
      if (speak && !this.playing) this.say(this.where());
      this.ask();
    }

    setSpeed(speed) {
      this.speed = speed;
      this.find("select").value = this.root.dataset.speed = speed;
      if (this.playing) this.say(`Speed ${speed}`);
    }

    changeSpeed(by) {
      this.setSpeed(SPEEDS[Math.max(0, Math.min(SPEEDS.length - 1, SPEEDS.indexOf(this.speed) + by))]);
    }

    where() {
      const words = readings(this.run, this.time);
      return `${this.time.toFixed(1)} s. Robot ${words.truth}. Error of odometry ${words.error}. Command ${words.command}.`;
    }

    say(text) {
      this.find("[role=status]").textContent = text;
      this.slider.setAttribute("aria-valuetext", `${this.time.toFixed(1)} of ${this.run.end.toFixed(1)} seconds`);
    }

    ask() {
      if (!this.request && this.visible) this.request = requestAnimationFrame((now) => this.frame(now));
    }

    frame(now) {
      this.request = 0;
      if (this.playing) {
        // A picture that came late moves the run by a tenth of a second and no more.
        const passed = Math.min(0.1, Math.max(0, now - this.ticked) / 1000);
        this.time = Math.min(this.run.end, this.time + this.speed * passed);
        this.ticked = now;
        if (this.time >= this.run.end) this.setPlaying(false);
      }
      if (!this.playing || !this.calm.matches || now - this.drawn >= CALM) {
        this.paint();
        this.drawn = now;
      }
      if (this.playing) this.ask();
    }

    fit() {
      const colours = globalThis.rosminiCanvas.theme(this.canvas);
      for (const [name, colour] of Object.entries(colours)) this.root.style.setProperty(`--${name}`, colour);
      this.view = globalThis.rosminiCanvas.fit(this.canvas, this.box);
    }

    paint() {
      if (!this.view) this.fit();
      const { run, time, view, layers } = this;
      const { robot } = run.scene;
      const draw = globalThis.rosminiCanvas;
      const count = 1 + Math.floor(sampleAt(run, time));
      const dashed = { colour: "orange", dashed: true };
      const scan = layers.scan && latest(run.scans, time);
      draw.world(view, run.scene);
      for (const thing of run.things) draw.thing(view, thing.shapes, poseAt(run, thing.track, time));
      if (scan) draw.scan(view, robot, (beam) => beamPose(run, scan[0], beam), scan[1]);
      view.context.globalAlpha = 0.3; // the whole way, faintly
      if (layers.truth) draw.trail(view, run.truth);
      if (layers.odom) draw.trail(view, run.odom, dashed);
      if (layers.truth) for (const { track, colour } of run.others) draw.trail(view, track, { colour });
      view.context.globalAlpha = 1;
      if (layers.truth) for (const { track, colour } of run.others) draw.trail(view, track, { colour, count });
      if (layers.truth) draw.trail(view, run.truth, { count });
      if (layers.odom) draw.trail(view, run.odom, { ...dashed, count });
      if (layers.odom) draw.robot(view, robot, poseAt(run, run.odom, time), { ghost: true });
      for (const other of run.others) {
        const pose = poseAt(run, other.track, time);
        draw.robot(view, other.robot, pose, other);
        draw.label(view, pose, other.name, { colour: other.colour, below: reach(other.robot) });
      }
      draw.robot(view, robot, poseAt(run, run.truth, time));
      if (run.others.length) draw.label(view, poseAt(run, run.truth, time), run.name, { colour: "blue", below: reach(robot) });
      draw.scaleBar(view);
      const words = readings(run, time);
      for (const [name, text] of Object.entries(words)) this.find(`[data-read=${name}]`).textContent = text;
      this.clock.value = `${time.toFixed(1)} / ${run.end.toFixed(1)} s`;
      this.slider.value = time;
      this.root.dataset.time = time.toFixed(3);
    }
  }

  function mount(host, data, options) {
    new Player(host, data, options);
  }

  globalThis.rosminiReplay = { mount, decode, beamPose };
})();
