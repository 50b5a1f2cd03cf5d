/* The player of scenes in three dimensions: one clock and one bar of controls for a run, or for several side by side.

   A plain script that needs `rosmini-replay-data.js` and `rosmini-meshcat.js`, which calls it; it sets
   `globalThis.rosminiMeshcatPlayer`:

     bar(panes, duration, options)   {element, begin(pane), seek(time), toggle, home, follow, follows(pane)}. Of a pane it takes `data`, `frame`,
                                     `viewer` (null until there is one) and `home()`. Of `data`: `duration` [s]; `tracks`, paths,
                                     properties and packed numbers (see `Motion` of scene3d.py); `follow` (the path of what the
                                     camera follows, or null); `legend`; `scan` with a recorded laser (or absent); `layered` with
                                     what `rosmini-meshcat-layers.js` lays on the ground (or absent). `begin` is told of a viewer. */

(() => {
  "use strict";

  const { columns, unpack } = globalThis.rosminiReplayData;
  const { find, make, orbit, ROBOT, ZOOM } = globalThis.rosminiMeshcat;
  const SPEEDS = [0.25, 0.5, 1, 2, 4, 8]; // as rosmini-replay.js has them
  const JUMP = 0.2; // seconds
  const CALM = 500; // milliseconds between two pictures, for those who want less motion; as there
  const EARLY = 1; // seconds: a scan that comes so soon after the start is there from the start
  const SAMPLES = 240; // of the way that a robot has come
  const LASER = "var(--rosmini-vermilion, #d55e00)";
  const [TIME, UNIT] = [1e-3, 1e-4]; // seconds; metres and radians
  const ALIKE = 1e-6; // metres: by so little views of several runs may differ

  /* The camera goes where the robot goes, and keeps the side and the distance that the reader chose. */
  function follow(viewer, path) {
    const { x, y } = find(viewer, path).position;
    const root = find(viewer, "/meshcat").position;
    const target = [x + root.x, 0, -(y + root.y)];
    const now = viewer.controls.target;
    const delta = [target[0] - now.x, 0, target[2] - now.z];
    now.set(...target);
    const at = viewer.camera.position;
    at.set(at.x + delta[0], at.y, at.z + delta[2]);
  }

  /* Put the points of the last scan before `time` in their places: each where the laser was when it measured it, while
     the robot, to which the cloud of points belongs, goes on. */
  function showScan(viewer, scan, time) {
    let last = scan.times[0] < EARLY ? 0 : -1;
    while (last + 1 < scan.times.length && scan.times[last + 1] <= time) last += 1;
    const cloud = find(viewer, scan.path);
    if (scan.shown !== last || scan.viewer !== viewer) {
      Object.assign(scan, { shown: last, viewer, points: last < 0 ? [] : measured(viewer, scan, last) });
      viewer.animator.seek(time);
    }
    cloud.updateWorldMatrix(true, false);
    const positions = find(viewer, `${scan.path}/<object>`).geometry.attributes.position;
    for (let i = 0; i < scan.beams; i += 1) {
      const { x, y, z } = scan.points[i] ? cloud.worldToLocal(scan.points[i].clone()) : { x: 0, y: 0, z: -100 };
      positions.setXYZ(i, x, y, z);
    }
    positions.needsUpdate = true;
  }

  /* Where the beams of a scan hit something in the viewer's world, or null; it moves the robot there and leaves it. */
  function measured(viewer, scan, which) {
    const cloud = find(viewer, scan.path);
    scan.metres ??= unpack(scan.ranges, scan.unit);
    viewer.animator.seek(scan.times[which]);
    return Array.from({ length: scan.beams }, (_, i) => {
      const range = scan.metres[which * scan.beams + i];
      if (!range) return null;
      const angle = (scan.start ?? 0) + (scan.step ?? (2 * Math.PI) / scan.beams) * i;
      if (scan.increment) viewer.animator.seek(scan.times[which] + i * scan.increment);
      cloud.updateWorldMatrix(true, false);
      return cloud.localToWorld(cloud.position.clone().set(range * Math.cos(angle), range * Math.sin(angle), 0));
    });
  }

  /* The lines on the ground, with how far whoever drew them had come by when; no line is shown ahead of them. */
  function growing(viewer, data) {
    const lines = data.legend.map(([name]) => {
      const own = name === "truth" || name === "odometry";
      const { geometry } = find(viewer, `/meshcat/trails/${name}/<object>`);
      const points = Float32Array.from(geometry.attributes.position.array);
      const along = [0];
      const middle = (i, axis) => (points[6 * i + axis] + points[6 * i + 3 + axis]) / 2;
      for (let i = 1; i < points.length / 6; i += 1) {
        along.push(along[i - 1] + Math.hypot(middle(i, 0) - middle(i - 1, 0), middle(i, 1) - middle(i - 1, 1)));
      }
      return { mover: find(viewer, own ? ROBOT : `/meshcat/others/${name.replaceAll("/", " ")}`), geometry, points, along, way: [], at: null };
    });
    for (let i = 0; i <= SAMPLES; i += 1) {
      viewer.animator.seek((i / SAMPLES) * data.duration);
      for (const line of lines) {
        const { x, y } = line.mover.position;
        line.way.push(line.at ? line.way.at(-1) + Math.hypot(x - line.at[0], y - line.at[1]) : 0);
        line.at = [x, y];
      }
    }
    return lines;
  }

  /* Show of each line what was driven at a part of the time, 0 to 1: all later points lie where it ends. */
  function grow(lines, part) {
    const i = Math.min(Math.floor(part * SAMPLES), SAMPLES - 1);
    for (const { geometry, points, along, way } of lines) {
      const walked = way[i] + (part * SAMPLES - i) * (way[i + 1] - way[i]);
      const reached = (walked / Math.max(way.at(-1), 1e-9)) * along.at(-1);
      const last = Math.max(0, Math.min(along.findLastIndex((length) => length <= reached), along.length - 2));
      const rest = Math.min(1, (reached - along[last]) / Math.max(along[last + 1] - along[last], 1e-9));
      const { array } = geometry.attributes.position;
      for (let j = 0; j < points.length; j += 1) {
        const from = 6 * last + (j % 6);
        array[j] = j < 6 * (last + 1) ? points[j] : points[from] + rest * (points[from + 6] - points[from]);
      }
      geometry.attributes.position.needsUpdate = true;
    }
  }

  /* What moves in a scene, as the command of meshcat that says so. */
  function animation(tracks) {
    const animations = tracks.map(([path, name, packed]) => {
      const [type, width] = { position: ["vector3", 3], quaternion: ["quaternion", 4] }[name] ?? ["number", 1];
      const keys = columns(packed, [TIME, ...Array(width).fill(UNIT)]).map(([time, ...value]) => ({ time, value: type === "number" ? value[0] : value }));
      return { path, clip: { fps: 1, name: "default", tracks: [{ name: `.${name}`, type, keys }] } };
    });
    return { type: "set_animation", animations, options: { play: false, repetitions: 1 } };
  }

  /* Where the world's origin is in the frame of the camera, which has y up. */
  function middle(viewer) {
    const { x, y, z } = find(viewer, "/meshcat").position;
    return { x, y: z, z: -y };
  }

  function bar(panes, duration, options) {
    const state = { time: 0, playing: false, following: panes.some(({ data }) => data.follow !== null), shown: {} };
    const shown = () => panes.filter(({ viewer }) => viewer);
    const calm = matchMedia("(prefers-reduced-motion: reduce)");
    const ink = { font: "inherit", color: "inherit" };
    const element = make("div", {}, {
      display: "flex", flexWrap: "wrap", gap: "0.4em 0.8em", alignItems: "center", padding: "0.4em",
      color: "var(--rosmini-ink, inherit)", fontSize: "0.9em",
    });
    element.setAttribute("role", "group");
    element.setAttribute("aria-label", `Player: ${options.title}`);
    const button = make("button", { type: "button", textContent: "Play" }, {
      ...ink, minWidth: "4.5em", padding: "0.2em 0.8em", cursor: "pointer", background: "transparent",
      border: "1px solid var(--rosmini-group-line, #9aa5af)", borderRadius: "4px",
    });
    const slider = make("input", { type: "range", min: 0, max: duration, step: 0.05, value: 0 }, {
      flex: "1 1 10em", accentColor: "var(--rosmini-blue, #0072b2)",
    });
    slider.setAttribute("aria-label", "Time");
    const clock = make("output", {}, { fontVariantNumeric: "tabular-nums" });
    const plain = { ...ink, padding: "0.2em 0.5em", cursor: "pointer", background: "transparent", border: 0 };
    const small = (text, label, act) => {
      const one = make("button", { type: "button", textContent: text, title: label }, plain);
      one.setAttribute("aria-label", label);
      one.addEventListener("click", act);
      return one;
    };
    const speed = make("select", {}, { ...ink, background: "transparent", border: "1px solid var(--rosmini-group-line, #9aa5af)", borderRadius: "4px" });
    speed.setAttribute("aria-label", "Speed");
    for (const factor of SPEEDS) speed.append(make("option", { value: factor, textContent: `${factor}\u00d7`, selected: factor === 1 }));
    const faster = (by) => {
      speed.selectedIndex = Math.max(0, Math.min(SPEEDS.length - 1, speed.selectedIndex + by));
    };
    const home = () => {
      for (const pane of panes) pane.home();
    };
    const api = { element, begin, seek, toggle, home, follow: () => box?.click(), follows: (pane) => pane.data.follow !== null && state.following };
    const reset = () => {
      if (box && !box.checked) box.click();
      home();
    };
    const [back, forward] = [-1, 1].map((way) => () => { toggle(false); seek(state.time + way * JUMP); });
    const closer = (factor) => () => shown().slice(0, 1).forEach(({ viewer }) => orbit(viewer, 0, 0, factor)); // the others go with it
    element.append(small("\u25c2\u2758", "Step back", back), button, small("\u2758\u25b8", "Step forward", forward), slider, clock, speed,
      small("\u2212", "Zoom out", closer(ZOOM)), small("+", "Zoom in", closer(1 / ZOOM)), small("reset", "Reset the view", reset));
    let box = null;
    if (state.following) {
      box = make("input", { type: "checkbox", checked: true });
      const label = make("label", {}, { cursor: "pointer" });
      label.append(box, " follow");
      box.addEventListener("change", () => { state.following = box.checked; seek(); });
      element.append(label);
    }

    const switches = new Map();
    for (const pane of panes) {
      const { data } = pane;
      pane.layered = data.layered ? globalThis.rosminiMeshcatLayers.decode(data.layered) : null;
      pane.solid = data.legend.map(([name, colour]) => [`/meshcat/trails/${name}`, name, colour]);
      if (data.scan) pane.solid.push([data.scan.path, "laser", LASER]);
      for (const [key, ...look] of [...pane.solid, ...(pane.layered?.switches ?? [])]) switches.set(key, look);
    }
    for (const [key, [name, colour]] of switches) {
      const line = make("span", { ariaHidden: "true" }, {
        display: "inline-block", width: "1.4em", height: "0.25em", margin: "0 0.4em 0.2em 0.3em",
        background: colour,
      });
      const label = make("label", {}, { cursor: "pointer" });
      const chosen = make("input", { type: "checkbox", checked: true });
      chosen.addEventListener("change", () => { state.shown[key] = chosen.checked; seek(); });
      label.append(chosen, line, name);
      element.append(label);
    }
    const answer = make("small", {}, { flexBasis: "100%" });
    answer.setAttribute("role", "status");
    const asks = panes.some(({ layered }) => layered?.why);
    const notes = [...new Set(panes.flatMap(({ layered }) => layered?.notes ?? []))];
    /* Ask what the place costs around which the view turns, or stop asking. */
    const inquire = () => {
      const viewer = shown()[0]?.viewer;
      const [target, root] = [viewer?.controls.target, viewer && find(viewer, "/meshcat").position];
      state.shown.asked = state.shown.asked || !target ? null : [target.x - root.x, -target.z - root.y];
      seek();
    };
    if (asks) element.append(small("cost?", "What the place in the middle costs", inquire), answer);
    if (notes.length) element.append(make("small", { textContent: notes.join(" ") }, { flexBasis: "100%" }));

    /* A viewer is there: give it what moves, and keep its camera beside those of the others. */
    function begin(pane) {
      pane.viewer.handle_command(animation(pane.data.tracks));
      pane.viewer.animator.play(); // so that the actions count; this script moves their time
      pane.viewer.animator.pause();
      pane.lines = growing(pane.viewer, pane.data);
      seek();
      pane.look = lookOf(pane);
      if (panes.length > 1) pane.viewer.controls.addEventListener("change", () => link(pane));
    }

    /* Where the camera is, seen from what it looks at; and where that is in the world, unless the view follows a robot. */
    const lookOf = (pane) => {
      const { camera: { position }, controls: { target } } = pane.viewer;
      return [position.clone().sub(target), api.follows(pane) ? target.clone().setScalar(0) : target.clone().sub(middle(pane.viewer))];
    };

    /* Whoever turns one view turns all: each looks from the same side and as far at its own robot, or at the same place. */
    function link(pane) {
      const look = lookOf(pane);
      if (pane.look?.every((each, i) => each.distanceTo(look[i]) < ALIKE)) return; // it only followed, or went with another
      pane.look = look;
      for (const other of shown()) {
        if (other === pane) continue;
        const { camera, controls } = other.viewer;
        if (!api.follows(other)) controls.target.copy(look[1]).add(middle(other.viewer));
        camera.position.copy(look[0]).add(controls.target);
        other.look = lookOf(other);
        other.viewer.set_dirty();
      }
    }

    function seek(time = state.time) {
      state.time = Math.min(Math.max(time, 0), duration);
      slider.value = state.time;
      const text = `${state.time.toFixed(1)} s of ${duration.toFixed(1)} s`;
      slider.setAttribute("aria-valuetext", text);
      clock.value = text;
      for (const pane of shown()) show(pane, Math.min(state.time, pane.data.duration));
      const { asked } = state.shown;
      const told = panes.filter(({ layered }) => layered?.why).map(({ layered, data }) => `${data.title ? `${data.title}: ` : ""}${asked && layered.why(Math.min(state.time, data.duration), asked)}`);
      answer.textContent = asked ? `At ${(asked[0] + 0).toFixed(2)}, ${(asked[1] + 0).toFixed(2)} m: ${told.join("; ")}` : "";
    }

    /* One run at a time of its own: when it is over it stays as it ended. */
    function show({ viewer, data, frame, lines, solid, layered }, time) {
      viewer.animator.seek(time);
      grow(lines, data.duration ? time / data.duration : 1);
      if (data.scan) showScan(viewer, data.scan, time);
      for (const [path] of solid) find(viewer, path).visible = state.shown[path] !== false;
      layered?.show(frame, viewer, time, state.shown);
      if (data.follow !== null && state.following) follow(viewer, data.follow);
      viewer.set_dirty();
    }

    function toggle(playing = !state.playing) {
      state.playing = playing;
      button.textContent = playing ? "Pause" : "Play";
      if (!playing) return;
      if (state.time >= duration) seek(0);
      let before = null;
      const next = (now) => {
        if (!state.playing || !element.isConnected) return toggle(false);
        if (before !== null && calm.matches && now - before < CALM) return requestAnimationFrame(next);
        if (before !== null) seek(state.time + (Number(speed.value) * (now - before)) / 1000);
        before = now;
        return state.time >= duration ? toggle(false) : requestAnimationFrame(next);
      };
      requestAnimationFrame(next);
    }

    button.addEventListener("click", () => toggle());
    slider.addEventListener("input", () => { toggle(false); seek(Number(slider.value)); });
    const keys = {
      " ": () => toggle(),
      ArrowLeft: back, ArrowDown: back, ArrowRight: forward, ArrowUp: forward,
      Home: () => { toggle(false); seek(0); }, End: () => { toggle(false); seek(duration); },
      "+": () => faster(1), "=": () => faster(1), "-": () => faster(-1), "_": () => faster(-1),
      PageUp: closer(1 / ZOOM), PageDown: closer(ZOOM), f: () => api.follow(), 0: reset, w: () => asks && inquire(),
    };
    element.addEventListener("keydown", (event) => {
      const { target, key } = event;
      const own = target === speed || (key === " " && target.matches("button, [type=checkbox]"));
      if (own || event.ctrlKey || event.altKey || event.metaKey || !(key in keys)) return;
      event.preventDefault();
      keys[key]();
    });
    seek(0);
    return api;
  }

  globalThis.rosminiMeshcatPlayer = { bar };
})();
