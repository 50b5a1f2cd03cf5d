/* The replay player: a recorded run, or several side by side by one clock, to play, to scrub and to look at closely.

   A plain script that needs `rosmini-canvas.js` and `rosmini-replay-data.js`, and `rosmini-replay-layers.js` for what is
   no run of a simulated robot; it sets `globalThis.rosminiReplay`:

     mount(host, data, options)   puts a player into an empty element; `data` is what `rosmini.viz.replay` made: a run,
                                  or {runs: [...]}; `options` has `title` and `alt`.

   It plays when it is told to; in the book, the first one of a page plays once when it comes into view, unless the reader
   prefers less motion. Its root element says how it is: data-state (playing, paused), data-time, data-speed,
   data-zoom, data-follow. The wheel scrolls the page; with Ctrl, or two fingers, it zooms. */

(() => {
  "use strict";

  const { beamPose, bounds, decode, number, poseAt, reach, readings, sampleAt, scanAt, spoken, switches } = globalThis.rosminiReplayData;

  const SPEEDS = [0.25, 0.5, 1, 2, 4, 8];
  const STEP = 0.2; // seconds: from one scan of TurtleBot3's laser to the next
  const CALM = 500; // milliseconds between two pictures, for those who want less motion
  const ZOOM = 1.5; // of one press
  const MOST_ZOOM = 40;
  const FLATTEST = 0.45; // the height of what is shown, in its width
  const CLICK = 5; // pixels: who moves further drags
  const ICONS = {
    back: "M4 4h3v16H4zM20 4v16L8 12z",
    play: "M6 3.5v17L20 12z",
    pause: "M5 4h5v16H5zM14 4h5v16h-5z",
    forward: "M17 4h3v16h-3zM4 4v16l12-8z",
    nearer: "M11 4h2v7h7v2h-7v7h-2v-7H4v-2h7z",
    further: "M4 11h16v2H4z",
    follow: "M11 2h2v3.1a7 7 0 0 1 5.9 5.9H22v2h-3.1a7 7 0 0 1-5.9 5.9V22h-2v-3.1A7 7 0 0 1 5.1 13H2v-2h3.1A7 7 0 0 1 11 5.100zM12 7a5 5 0 1 0 0 10 5 5 0 0 0 0-10zm0 3a2 2 0 1 1 0 4 2 2 0 0 1 0-4z",
    reset: "M4 4h6v2H6v4H4zm10 0h6v6h-2V6h-4zM4 14h2v4h4v2H4zm14 0h2v6h-6v-2h4z",
  };

  const STYLE = `
.rosmini-replay{background:var(--page);border:1px solid color-mix(in srgb,var(--group-line) 55%,transparent);
border-radius:8px;box-sizing:border-box;color:var(--ink);font:14px/1.4 var(--rosmini-font,system-ui,sans-serif);overflow:hidden}
.rosmini-replay *{box-sizing:border-box}
.rosmini-replay canvas{cursor:pointer;touch-action:pan-x pan-y}
.rosmini-replay .rr-panes{display:grid;gap:.3rem;grid-template-columns:repeat(auto-fit,minmax(min(100%,18rem),1fr))}
.rosmini-replay .rr-pane{min-width:0}
.rosmini-replay .rr-title{font-size:14px;font-weight:600;margin:0;padding:.45rem .7rem .2rem}
.rosmini-replay .rr-view{display:flex;gap:.1rem;margin-left:auto}
.rosmini-replay button[aria-pressed=true]{background:color-mix(in srgb,var(--blue) 24%,transparent)}
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
.rosmini-replay label{align-items:center;cursor:pointer;display:inline-flex;gap:.35rem;margin:0;max-width:100%;min-height:28px;overflow-wrap:anywhere}
.rosmini-replay [hidden]{display:none}
.rosmini-replay .rr-layers{gap:.1rem .8rem;padding-bottom:.1rem}
.rosmini-replay i{border-top:2px solid;display:inline-block;width:18px}
.rosmini-replay .rr-pen{filter:drop-shadow(0 0 1px var(--muted))}
.rosmini-replay .rr-notes{color:var(--muted);font-size:12px;margin:0;padding:0 .7rem .5rem}
.rosmini-replay .rr-keys{color:var(--muted);font-size:12px;margin:0;padding:0 .7rem .5rem}
.rosmini-replay kbd{all:unset;border:1px solid var(--group-line);border-radius:3px;padding:0 .3em}
.rosmini-replay dl{display:grid;gap:.1rem 1.2rem;grid-auto-flow:column;grid-template-rows:auto auto;justify-content:start;
margin:0;padding:.2rem .7rem .6rem}
.rosmini-replay .rr-pane dl{grid-auto-flow:row;grid-template-rows:none}
.rosmini-replay dl div{display:flex;gap:.5rem}
.rosmini-replay dt{color:var(--muted);flex:0 0 5.4rem;font-weight:400;margin:0}
.rosmini-replay dd{margin:0;min-width:10.5rem}
.rosmini-replay [role=status]{clip-path:inset(50%);height:1px;margin:0;overflow:hidden;position:absolute;width:1px}
@container (max-width:620px){.rosmini-replay .rr-keys{display:none}.rosmini-replay .rr-view{margin-left:0}.rosmini-replay dl{grid-auto-flow:row;grid-template-rows:none}}`;

  const icon = (name) => `<svg viewBox="0 0 24 24" aria-hidden="true"><path d="${ICONS[name]}"/></svg>`;
  const button = (name, label, key) =>
    `<button type="button" data-do="${name}" aria-label="${label}" title="${label} (${key})">${icon(name)}</button>`;
  const content = (followed, asks) => `
<div class="rr-panes"></div>
<div class="rr-row rr-bar">
<span class="rr-buttons">${button("back", "Step back", "left arrow")}${button("play", "Play", "space")}${button("forward", "Step forward", "right arrow")}</span>
<input type="range" step="any" aria-label="Time">
<output></output>
<select aria-label="Speed">${SPEEDS.map((speed) => `<option value="${speed}">${speed}\u00d7</option>`).join("")}</select>
</div>
<div class="rr-row rr-layers">
<span class="rr-view">${button("further", "Zoom out", "Page down")}${button("nearer", "Zoom in", "Page up")}${followed ? button("follow", "Follow", "f") : ""}${button("reset", "Reset the view", "0")}</span></div>
<p class="rr-notes" hidden></p>
<p class="rr-keys"><kbd>space</kbd> <kbd>\u2190</kbd> <kbd>\u2192</kbd> <kbd>Home</kbd> <kbd>End</kbd> time, <kbd>+</kbd> <kbd>\u2212</kbd> speed,
<kbd>Page up</kbd> <kbd>Page down</kbd> or <kbd>Ctrl</kbd> and wheel zoom, <kbd>Shift</kbd> and arrows or drag move, ${followed ? "<kbd>f</kbd> follow, " : ""}<kbd>0</kbd> reset${
  asks ? `, <kbd>w</kbd> or <kbd>Shift</kbd> and click: ${asks}` : ""}</p>
<p role="status"></p>`;
  const PANE = '<p class="rr-title" hidden></p><canvas role="img"></canvas><dl></dl>';

  /* What the view can follow, in words; nothing if nothing moves. */
  const followed = ([run]) => (run.scene ? "the robot" : run.bodies[0]?.name);

  /* What a click on a place asks, in words; nothing if nothing can answer. */
  function question(runs) {
    const grids = runs.flatMap((run) => run.layers).filter((layer) => layer.tellAt);
    return grids.length ? (grids.every((layer) => layer.isMap) ? "what is at a place" : "what a place costs") : "";
  }

  function build(host, options, runs) {
    const root = document.createElement("div");
    root.className = "rosmini-replay";
    root.setAttribute("role", "group");
    root.setAttribute("aria-label", options.title);
    root.innerHTML = content(followed(runs), question(runs));
    for (const follow of root.querySelectorAll("[data-do=follow]")) {
      follow.title = `Follow ${followed(runs)} (f)`;
      follow.setAttribute("aria-label", `Follow ${followed(runs)}`);
    }
    const view = root.querySelector(".rr-view");
    for (const [key, [label, colour, line]] of switches(runs)) {
      const row = document.createElement("label");
      row.innerHTML = '<input type="checkbox" checked><i></i>';
      row.firstChild.dataset.layer = key;
      row.append(label);
      const own = colour[0] === "#"; // such as the white of a pen, on a white page
      const swatch = row.querySelector("i");
      swatch.style.borderTop = `${line === "dotted" ? 3 : 2}px ${line} ${own ? colour : `var(--${colour},var(--line))`}`;
      if (own) swatch.className = "rr-pen";
      view.before(row);
    }
    const notes = root.querySelector(".rr-notes");
    notes.textContent = [...new Set(runs.flatMap((run) => run.notes))].join(" ");
    notes.hidden = !notes.textContent;
    const panes = root.querySelector(".rr-panes");
    for (const run of runs) {
      const pane = document.createElement("div");
      pane.className = "rr-pane";
      pane.innerHTML = PANE;
      pane.querySelector(".rr-title").textContent = run.title;
      pane.querySelector(".rr-title").hidden = runs.length < 2;
      pane.querySelector("canvas").setAttribute("aria-label", runs.length < 2 ? options.alt : `${run.title}: ${options.alt}`);
      panes.append(pane);
    }
    if (runs.length < 2) root.querySelector(".rr-notes").before(panes.querySelector("dl"));
    // JupyterLab's shortcuts match what has the focus itself, so each control has to say that its keys are its own.
    for (const element of root.querySelectorAll("button, input, select")) element.dataset.lmSuppressShortcuts = "";
    const style = document.createElement("style");
    style.textContent = STYLE;
    host.style.containerType = "inline-size";
    host.append(style, root);
    return root;
  }

  /* One run on its canvas. */
  class Pane {
    constructor(run, canvas, list) {
      Object.assign(this, { run, canvas, list, box: bounds(run), base: null });
      this.window = this.box; // what the run says that it is in
      const [x0, y0, x1, y1] = this.box;
      const lacking = Math.max(0, FLATTEST * (x1 - x0) - (y1 - y0)) / 2;
      this.box = [x0, y0 - lacking, x1, y1 + lacking];
      list.innerHTML = readings(run, run.start).map(([key]) => `<div><dt></dt><dd data-read="${key}"></dd></div>`).join("");
      readings(run, run.start).forEach(([, label], i) => { list.querySelectorAll("dt")[i].textContent = label; });
      this.asked = null;
      this.asks = question([run]);
    }

    /* Where the view is: as fitted, or zoomed around `camera.centre`, or around what it follows. */
    view(camera, time) {
      this.base ??= globalThis.rosminiCanvas.fit(this.canvas, this.box);
      const { base, run } = this;
      this.middle ??= [(this.box[0] + this.box[2]) / 2, (this.box[1] + this.box[3]) / 2];
      if (camera.zoom === 1 && !camera.follow && !camera.moved) return base;
      const [x, y] = camera.follow ? this.pose(time) : this.middle.map((m, axis) => m + camera.moved[axis]);
      const scale = base.scale * camera.zoom;
      const [left, top] = [base.x(this.middle[0]), base.y(this.middle[1])];
      return {
        ...base, scale, fleeting: true, world: undefined,
        x: (metres) => left + (metres - x) * scale,
        y: (metres) => top - (metres - y) * scale,
        metres: (px, py) => [x + (px - left) / scale, y - (py - top) / scale],
      };
    }

    why(time, place) {
      return globalThis.rosminiReplayLayers.why(this.run.layers, time, place);
    }

    /* A cross where somebody has asked, and the answer below. */
    answer(view, time) {
      let row = this.list.querySelector("[data-read=why]")?.parentElement;
      if (!this.asked) {
        row?.remove();
        return;
      }
      if (!row) {
        this.list.insertAdjacentHTML("beforeend", `<div><dt></dt><dd data-read="why"></dd></div>`);
        row = this.list.lastElementChild;
      }
      const { context } = view;
      const [x, y] = [view.x(this.asked[0]), view.y(this.asked[1])];
      context.beginPath();
      for (const [dx, dy] of [[7, 0], [0, 7]]) {
        context.moveTo(x - dx, y - dy);
        context.lineTo(x + dx, y + dy);
      }
      context.lineWidth = 2;
      context.strokeStyle = view.theme.ink;
      context.stroke();
      row.firstElementChild.textContent = `At ${number(this.asked[0], 2)}, ${number(this.asked[1], 2)} m`;
      row.lastElementChild.textContent = this.why(time, this.asked);
    }

    /* What the view follows: the robot, or the first body. */
    pose(time) {
      const { run } = this;
      if (run.scene) return poseAt(run, run.truth, time);
      return run.bodies[0]?.at(time) ?? this.middle;
    }

    paint(camera, time, shown) {
      const { run } = this;
      const view = this.view(camera, time);
      const draw = globalThis.rosminiCanvas;
      if (run.scene && shown.world !== false) draw.world(view, run.scene);
      else draw.clear(view, { grid: !run.isWindow });
      if (run.background) {
        const [x0, y0, x1, y1] = this.window;
        view.context.fillStyle = run.background;
        view.context.fillRect(view.x(x0), view.y(y1), (x1 - x0) * view.scale, (y1 - y0) * view.scale);
      }
      let slot = 0;
      const wanted = (layer) => shown[`layer ${layer.name}`];
      for (const layer of run.layers) if (!layer.above && wanted(layer)) layer.draw(view, time, run.start);
      if (run.scene) this.robots(view, time, shown);
      for (const body of run.bodies) if (shown[`body ${body.name}`]) body.draw(view, time, body.trail);
      for (const layer of run.layers) if (layer.above && wanted(layer)) slot += layer.draw(view, time, run.start, slot) ? 1 : 0;
      if (run.steps) draw.scaleBar(view, { unit: "steps", metre: run.steps.metre });
      else if (!run.isWindow) draw.scaleBar(view);
      this.answer(view, time);
      for (const [key, , text] of readings(run, time)) this.list.querySelector(`[data-read=${key}]`).textContent = text;
    }

    /* What a simulator knows of its robots: where they are, where odometry puts the first one, what its laser sees. */
    robots(view, time, shown) {
      const { run } = this;
      const { robot } = run.scene;
      const draw = globalThis.rosminiCanvas;
      const count = 1 + Math.floor(sampleAt(run, time));
      const scan = shown.scan && scanAt(run, time);
      for (const thing of run.things) draw.thing(view, thing.shapes, poseAt(run, thing.track, time));
      if (scan) draw.scan(view, robot, (beam) => beamPose(run, scan[0], beam), scan[1]);
      const passed = (track) => [...track.slice(0, count), poseAt(run, track, time)];
      if (shown.truth) for (const { track, colour } of run.others) draw.trail(view, passed(track), { colour });
      if (shown.truth) draw.trail(view, passed(run.truth));
      if (shown.odom) {
        draw.trail(view, passed(run.odom), { colour: "orange", dashed: true });
        draw.robot(view, robot, poseAt(run, run.odom, time), { ghost: true });
      }
      for (const other of run.others) {
        const pose = poseAt(run, other.track, time);
        draw.robot(view, other.robot, pose, other);
        draw.label(view, pose, other.name, { colour: other.colour, below: reach(other.robot) });
      }
      const pose = poseAt(run, run.truth, time);
      draw.robot(view, robot, pose);
      if (run.others.length) draw.label(view, pose, run.name, { colour: "blue", below: reach(robot) });
    }
  }

  class Player {
    constructor(host, data, options) {
      const runs = (data.runs ?? [data]).map(decode);
      this.followed = followed(runs);
      this.root = build(host, options, runs);
      const find = (selector) => this.root.querySelector(selector);
      this.find = find;
      [this.slider, this.clock] = [find("[type=range]"), find("output")];
      const lists = this.root.querySelectorAll("dl");
      this.panes = [...this.root.querySelectorAll("canvas")].map((canvas, i) => new Pane(runs[i], canvas, lists[i]));
      this.start = Math.min(...runs.map((run) => run.start - run.origin));
      this.end = Math.max(...runs.map((run) => run.end - run.origin));
      this.shown = Object.fromEntries([...switches(runs).keys()].map((key) => [key, true]));
      this.camera = { zoom: 1, follow: false, moved: null };
      this.calm = matchMedia("(prefers-reduced-motion: reduce)");
      [this.time, this.playing, this.visible] = [data.opens === "end" ? this.end : this.start, false, true];
      [this.request, this.ticked, this.drawn] = [0, 0, -Infinity];

      const { start, end } = this;
      Object.assign(this.slider, { min: start, max: end });
      for (const element of this.root.querySelectorAll(".rr-bar button, [type=range]")) element.disabled = end <= start;
      this.root.dataset.state = "paused";
      this.setSpeed(1);
      this.look({});
      this.listen();
      this.paint();
      if (options.book) this.playInView();
    }

    listen() {
      const { root, slider } = this;
      const deeds = {
        play: () => this.setPlaying(!this.playing),
        back: () => this.seek(this.time - STEP),
        forward: () => this.seek(this.time + STEP),
        nearer: () => this.zoom(ZOOM),
        further: () => this.zoom(1 / ZOOM),
        follow: () => this.look({ follow: !this.camera.follow, moved: null }, "follow"),
        reset: () => this.look({ zoom: 1, follow: false, moved: null }, "reset"),
      };
      const keys = {
        " ": deeds.play,
        ArrowLeft: deeds.back, ArrowDown: deeds.back, ArrowRight: deeds.forward, ArrowUp: deeds.forward,
        Home: () => this.seek(this.start), End: () => this.seek(this.end),
        "+": () => this.changeSpeed(1), "=": () => this.changeSpeed(1),
        "-": () => this.changeSpeed(-1), "_": () => this.changeSpeed(-1),
        PageUp: deeds.nearer, PageDown: deeds.further, 0: deeds.reset,
        ...(this.followed ? { f: deeds.follow } : {}),
        ...(this.panes.some((pane) => pane.asks) ? { w: () => this.inquire() } : {}),
      };
      const moves = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
      root.addEventListener("keydown", (event) => {
        const { target, key } = event;
        const own = target.matches("select") || (key === " " && target.matches("button, [type=checkbox]"));
        if (own || event.ctrlKey || event.altKey || event.metaKey || !(key in keys)) return;
        event.preventDefault();
        event.stopPropagation();
        if (event.shiftKey && moves[key]) this.move(...moves[key].map((way) => 60 * way));
        else keys[key]();
      });
      root.addEventListener("click", (event) => deeds[event.target.closest("[data-do]")?.dataset.do]?.());
      root.addEventListener("change", ({ target }) => {
        if (target.dataset.layer) this.shown[target.dataset.layer] = target.checked;
        else if (target.matches("select")) this.setSpeed(Number(target.value));
        else this.seek(slider.valueAsNumber);
        this.ask();
      });
      slider.addEventListener("input", () => this.seek(slider.valueAsNumber, false));
      for (const pane of this.panes) {
        this.hands(pane, () => {
          slider.focus({ preventScroll: true });
          deeds.play();
        });
        globalThis.rosminiCanvas.watch(pane.canvas, () => {
          pane.base = null;
          this.ask();
        });
      }
      new IntersectionObserver((entries) => {
        this.visible = entries.at(-1).isIntersecting;
        this.ticked = performance.now();
        this.ask();
      }, { rootMargin: "100px" }).observe(root);
    }

    /* The mouse and fingers on a canvas. One finger and the wheel scroll the page, as they do everywhere. */
    hands(pane, click) {
      const { canvas } = pane;
      const down = new Map();
      let moved = 0;
      canvas.addEventListener("wheel", (event) => {
        if (!event.ctrlKey) return;
        event.preventDefault();
        this.zoom(Math.exp(-event.deltaY / 200), pane, [event.offsetX, event.offsetY]);
      }, { passive: false });
      canvas.addEventListener("pointerdown", (event) => {
        if (!down.size) moved = 0;
        down.set(event.pointerId, [event.offsetX, event.offsetY]);
        if (event.pointerType !== "touch") canvas.setPointerCapture(event.pointerId);
      });
      canvas.addEventListener("pointermove", (event) => {
        const before = down.get(event.pointerId);
        if (!before) return;
        const now = [event.offsetX, event.offsetY];
        const by = [before[0] - now[0], now[1] - before[1]];
        moved += Math.hypot(...by);
        if (down.size === 2) {
          const other = [...down].find(([id]) => id !== event.pointerId)[1];
          const apart = (point) => Math.max(20, Math.hypot(point[0] - other[0], point[1] - other[1]));
          this.zoom(apart(now) / apart(before), pane, other);
        } else if (event.pointerType !== "touch" && moved > CLICK) {
          this.move(...by);
        }
        down.set(event.pointerId, now);
      });
      for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, (event) => down.delete(event.pointerId));
      canvas.addEventListener("click", (event) => {
        if (moved > CLICK) return;
        if (event.shiftKey && pane.asks) this.inquire(pane, pane.view(this.camera, this.at(pane)).metres(event.offsetX, event.offsetY));
        else click();
      });
    }

    /* Ask what a place costs; without a place, that in the middle of the view, or stop asking. */
    inquire(pane = this.panes.find((each) => each.asks), place = null) {
      const middle = pane.middle.map((m, axis) => m + (this.camera.moved ?? this.offset(pane))[axis]);
      pane.asked = place ?? (pane.asked ? null : middle);
      this.ask();
      return this.say(pane.asked ? pane.why(this.at(pane), pane.asked) : "No question");
    }

    /* Move the view by pixels, to the right and up. */
    move(right, up) {
      const { camera } = this;
      const scale = this.panes[0].base.scale * camera.zoom;
      const from = camera.moved ?? this.offset(this.panes[0]);
      this.look({ follow: false, moved: [from[0] + right / scale, from[1] + up / scale] });
    }

    /* How far the view's centre is from the middle of everything [m]. */
    offset(pane) {
      if (!this.camera.follow) return [0, 0];
      const pose = pane.pose(this.at(pane));
      return [0, 1].map((axis) => pose[axis] - pane.middle[axis]);
    }

    /* Zoom by a factor; what is at a point [px] of a pane stays there. */
    zoom(factor, pane = this.panes[0], point = null) {
      const { camera } = this;
      const zoom = Math.min(MOST_ZOOM, Math.max(1, camera.zoom * factor));
      if (camera.follow || zoom === 1) return this.look({ zoom, moved: zoom === 1 ? null : camera.moved }, "zoom");
      const from = camera.moved ?? [0, 0];
      const before = pane.view(camera, this.at(pane));
      const target = point ? before.metres(...point) : pane.middle.map((m, axis) => m + from[axis]);
      const part = 1 - camera.zoom / zoom;
      const moved = from.map((each, axis) => each + part * (target[axis] - pane.middle[axis] - each));
      return this.look({ zoom, moved }, "zoom");
    }

    look(change, why = "") {
      const { camera } = this;
      Object.assign(camera, change);
      this.root.dataset.zoom = camera.zoom.toFixed(2);
      this.root.dataset.follow = camera.follow;
      this.find("[data-do=follow]")?.setAttribute("aria-pressed", camera.follow);
      this.find("[data-do=further]").disabled = camera.zoom <= 1;
      this.find("[data-do=reset]").disabled = camera.zoom === 1 && !camera.follow && !camera.moved;
      if (why === "follow") this.say(camera.follow ? `The view follows ${this.followed}` : "The view stands still");
      if (why === "reset") this.say("The view shows everything");
      if (why === "zoom") this.say(`Zoom ${camera.zoom.toFixed(1)}`);
      this.ask();
    }

    /* Play once when half of it is in view, if it is the first player of the page and the reader has not used it yet. */
    playInView() {
      const { start, time } = this;
      const isFirst = () => document.querySelector(".rosmini-replay") === this.root;
      const observer = new IntersectionObserver(async (entries) => {
        if (!entries.at(-1).isIntersecting) return;
        observer.disconnect();
        if (document.readyState !== "complete") await new Promise((done) => addEventListener("load", done, { once: true }));
        if (!isFirst() || this.calm.matches || this.time !== time || this.end <= start) return;
        this.setPlaying(true, false);
      }, { threshold: 0.5 });
      observer.observe(this.panes[0].canvas);
    }

    setPlaying(value, speak = true) {
      const { start, end } = this;
      this.isQuiet = !speak;
      if (value && this.time >= end) this.time = start;
      this.playing = value && end > start;
      this.ticked = performance.now();
      this.root.dataset.state = this.playing ? "playing" : "paused";
      const [button, name] = [this.find("[data-do=play]"), this.playing ? "Pause" : "Play"];
      button.innerHTML = icon(name.toLowerCase());
      button.setAttribute("aria-label", name);
      button.title = `${name} (space)`;
      if (speak) this.say(this.playing ? "Playing" : `${this.time >= end ? "End" : "Paused"}: ${this.where()}`);
      this.ask();
    }

    seek(time, speak = true) {
      this.time = Math.min(this.end, Math.max(this.start, time));
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

    /* The time of a pane's run: a run that is over stays as it ended. */
    at({ run }) {
      return Math.min(run.end, Math.max(run.start, this.time + run.origin));
    }

    where() {
      const words = this.panes.map((pane) => {
        const title = this.panes.length > 1 ? `${pane.run.title}: ` : "";
        return title + spoken(pane.run, this.at(pane));
      });
      return `${this.time.toFixed(1)} s. ${words.join(" ")}`;
    }

    say(text) {
      this.find("[role=status]").textContent = text;
      this.slider.setAttribute("aria-valuetext", `${this.time.toFixed(1)} of ${this.end.toFixed(1)} seconds`);
    }

    ask() {
      if (!this.request && this.visible) this.request = requestAnimationFrame((now) => this.frame(now));
    }

    frame(now) {
      this.request = 0;
      if (this.playing) {
        // A picture that came late moves the run by a tenth of a second and no more.
        const passed = Math.min(0.1, Math.max(0, now - this.ticked) / 1000);
        this.time = Math.min(this.end, this.time + this.speed * passed);
        this.ticked = now;
        if (this.time >= this.end) this.setPlaying(false, !this.isQuiet);
      }
      if (!this.playing || !this.calm.matches || now - this.drawn >= CALM) {
        this.paint();
        this.drawn = now;
      }
      if (this.playing) this.ask();
    }

    paint() {
      if (this.panes.some((pane) => !pane.base)) {
        const colours = globalThis.rosminiCanvas.theme(this.panes[0].canvas);
        for (const [name, colour] of Object.entries(colours)) this.root.style.setProperty(`--${name}`, colour);
      }
      for (const pane of this.panes) pane.paint(this.camera, this.at(pane), this.shown);
      this.clock.value = `${this.time.toFixed(1)} / ${this.end.toFixed(1)} s`;
      this.slider.value = this.time;
      this.root.dataset.time = this.time.toFixed(3);
    }
  }

  function mount(host, data, options) {
    new Player(host, data, options);
  }

  globalThis.rosminiReplay = { mount };
})();
