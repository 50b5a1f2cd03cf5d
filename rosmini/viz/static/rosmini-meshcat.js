/* A three-dimensional scene in meshcat's viewer, with no server: replays the commands that a recorded window was sent.

   `rosminiMeshcat.mount(host, data, options)` as `rosmini/viz/embed.py` calls it. `data` is what `rosmini/viz/meshcat` makes:
   `commands` (base64 of packed commands), `themes` (colours of paths on light and dark pages), `duration` [s] of the
   animation or 0, `follow` (the path of what the camera follows, or null), `legend` (names and colours of lines), and
   `scan` with a recorded laser (or absent), `copies` with pairs of paths: at the second is once more what is at the first (or absent),
   `background` with the scene's own colour (or absent: that of the page), `labels` with words at points (or absent),
   `layered` with what `rosmini-meshcat-layers.js` lays on the ground (or absent).
   With `options.driven` the robot is under somebody's keys: that function is called with `put(pose)`, which moves it and
   the camera behind it, and neither mouse nor keys turn the scene. `options.ready(viewer, frame)` is called for each viewer
   that is made. `label(window, viewer, each)` and `find(viewer, path)` are for those who change a scene that is shown.

   The viewer runs in a frame, so its styles and its globals stay there. It is made when the reader comes near it, and
   again if the page takes the frame out and puts it back. Outside a click it leaves the wheel to the page. */

(() => {
  "use strict";

  // rosmini/viz/style.py has this; a test keeps them equal.
  const DARK_PAGES = 'html[data-theme="dark"], body[data-jp-theme-light="false"], body.vscode-dark';
  const THEMED_PAGES = "html[data-theme], body[data-jp-theme-light], body.vscode-dark, body.vscode-light";
  const GROUND = {
    light: ["#ffffff", "#dfe7ee", "#1b2733", "#c3cad1"], dark: ["#14181e", "#232b34", "#e8edf2", "#46515c"],
  };
  const STEP = Math.PI / 24;
  const SPEEDS = [0.25, 0.5, 1, 2, 4, 8]; // as rosmini-replay.js has them
  const ZOOM = 1.5; // of one press, as there
  const JUMP = 0.2; // seconds
  const EARLY = 1; // seconds: a scan that comes so soon after the start is there from the start
  const SAMPLES = 240; // of the way that a robot has come
  const [BEHIND, ABOVE, AHEAD] = [0.75, 0.55, 0.2]; // metres: where the camera is from a robot that is driven, and where it looks
  const LASER = "var(--rosmini-vermilion, #d55e00)";
  const ROBOT = "/meshcat/robots/robot";

  const bytes = (text) => Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
  const parts = (path) => path.split("/").filter(Boolean);
  const make = (tag, properties = {}, style = {}) => {
    const made = Object.assign(document.createElement(tag), properties);
    Object.assign(made.style, style);
    return made;
  };

  let webgl;
  function hasWebGL() {
    if (webgl === undefined) {
      const context = document.createElement("canvas").getContext("webgl2");
      webgl = context !== null;
      context?.getExtension("WEBGL_lose_context")?.loseContext();
    }
    return webgl;
  }

  function theme() {
    if (document.querySelector(DARK_PAGES)) return "dark";
    if (document.querySelector(THEMED_PAGES)) return "light";
    return matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
  }

  function onTheme(change) {
    const observer = new MutationObserver(change);
    const watched = { attributes: true, attributeFilter: ["data-theme", "data-jp-theme-light", "class"] };
    observer.observe(document.documentElement, watched);
    observer.observe(document.body, watched);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", change);
  }

  function nearby(element) {
    return new Promise((resolve) => {
      const observer = new IntersectionObserver((entries) => {
        if (!entries.some((entry) => entry.isIntersecting)) return;
        observer.disconnect();
        resolve();
      }, { rootMargin: "300px" });
      observer.observe(element);
    });
  }

  async function mount(host, data, options) {
    if (!hasWebGL()) return false; // the drawing stays
    options.show(false);
    await nearby(options.still);
    const address = await options.asset("meshcat.min.js");
    const frame = make("iframe", { title: options.title }, {
      display: "block", width: "100%", height: `${options.height}px`, border: "0", borderRadius: "4px",
    });
    const state = { time: 0, playing: false, following: data.follow !== null, viewer: null, frame, shown: {} };
    const bar = data.duration > 0 ? playerBar(state, data, options) : null;
    host.append(frame, ...(bar ? [bar.element] : []));
    onTheme(() => {
      if (state.viewer) paint(state.viewer, data);
      bar?.seek(state.time);
    });
    if (options.driven) frame.style.pointerEvents = "none"; // a click is for the keys around it
    frame.addEventListener("load", () => {
      if (frame.contentDocument.getElementById("pane")) start(frame, address, data, options, state, bar);
    });
    frame.srcdoc = '<!DOCTYPE html><html lang="en"><title>3D</title><style>html,body{margin:0;height:100%;overflow:hidden}'
      + "#pane{width:100vw;height:100vh}canvas{display:block;outline-offset:-3px}</style>"
      + '<body><div id="pane"></div></body></html>';
    options.show(true);
    return true;
  }

  function start(frame, address, data, options, state, bar) {
    const page = frame.contentDocument;
    const script = page.createElement("script");
    script.onload = () => {
      const viewer = new frame.contentWindow.MeshCat.Viewer(page.getElementById("pane"));
      viewer.gui.domElement.style.display = "none";
      for (const command of data.commands) viewer.handle_command_bytearray(bytes(command));
      for (const [from, to] of data.copies ?? []) { // what is there several times has one geometry
        const known = viewer.scene_tree.find([...parts(from), "<object>"]).object;
        viewer.set_object(parts(to), known.clone());
      }
      for (const each of data.labels ?? []) label(frame.contentWindow, viewer, each);
      state.viewer = frame.contentWindow.viewer = viewer; // where meshcat's own page has it
      state.target = null;
      viewer.controls.minDistance = 0.15;
      viewer.controls.maxDistance = 60;
      viewer.controls.maxPolarAngle = Math.PI / 2 - 0.02; // not below the ground
      if (options.driven) options.driven((pose) => put(viewer, pose));
      else hands(frame, viewer, options, bar);
      paint(viewer, data);
      if (bar) {
        viewer.animator.play(); // so that the actions count; this script moves their time
        viewer.animator.pause();
        bar.seek(state.time);
      }
      frame.dataset.ready = "";
      options.ready?.(viewer, frame);
    };
    script.onerror = () => { options.show(false); console.error(`${address} was not loaded`); };
    script.src = address;
    page.body.append(script);
  }

  function paint(viewer, data) {
    const name = theme();
    const [top, bottom, ink] = data.background ?? GROUND[name];
    const page = viewer.dom_element.ownerDocument;
    page.body.style.background = `linear-gradient(${top}, ${bottom})`;
    viewer.renderer.domElement.style.outlineColor = ink;
    for (const [path, colour] of Object.entries(data.themes[name])) {
      viewer.set_property(parts(path), "color", colour);
    }
    viewer.set_dirty();
  }

  /* Words that face the reader and that nothing hides: `text`, `at` [m], `height` of its letters [m], `colour`. */
  function label(page, viewer, { text, at, height, colour }) {
    const canvas = page.document.createElement("canvas");
    const pen = canvas.getContext("2d");
    const font = "40px sans-serif";
    pen.font = font;
    canvas.width = Math.min(pen.measureText(text).width + 16, 2048);
    canvas.height = 56;
    Object.assign(pen, { font, textBaseline: "middle", textAlign: "center", lineWidth: 8, lineJoin: "round" });
    pen.strokeStyle = "rgba(0, 0, 0, 0.7)";
    pen.strokeText(text, canvas.width / 2, 28);
    pen.fillStyle = colour;
    pen.fillText(text, canvas.width / 2, 28);
    const { THREE } = page.MeshCat;
    const map = new THREE.CanvasTexture(canvas);
    const sprite = new THREE.Sprite(new THREE.SpriteMaterial({ map, depthTest: false, transparent: true }));
    const scale = (1.4 * height) / 40;
    sprite.scale.set(canvas.width * scale, canvas.height * scale, 1);
    sprite.center.set(0.5, 1);
    sprite.position.set(...at);
    find(viewer, "/meshcat").add(sprite);
    return sprite;
  }

  /* Keys, wheel and touch. The wheel zooms and a finger turns it in all directions only after a click or a tap; before,
     they scroll the page. */
  function hands(frame, viewer, options, bar) {
    const canvas = viewer.renderer.domElement;
    const { controls, camera } = viewer;
    const begin = camera.position.clone();
    const middle = controls.target.clone();
    const home = () => {
      if (!bar?.follows()) controls.target.copy(middle);
      camera.position.copy(begin).add(controls.target);
      viewer.set_dirty();
    };
    if (bar) bar.home = home;
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "application");
    canvas.setAttribute("aria-label", `${options.alt} Arrow keys turn it, plus and minus zoom, Home goes back.`);
    const hold = (held) => {
      controls.enableZoom = held;
      viewer.dom_element.style.touchAction = canvas.style.touchAction = held ? "none" : "pan-y";
    };
    hold(false);
    canvas.addEventListener("focus", () => hold(true));
    canvas.addEventListener("blur", () => hold(false));
    canvas.addEventListener("pointerdown", () => canvas.focus({ preventScroll: true }));
    viewer.dom_element.addEventListener("wheel", (event) => {
      if (!controls.enableZoom) event.stopImmediatePropagation(); // meshcat would keep the page from scrolling
    }, { capture: true });
    canvas.addEventListener("keydown", (event) => {
      const turn = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
      const zoom = { "+": 1 / 1.15, "=": 1 / 1.15, "-": 1.15, PageUp: 1 / ZOOM, PageDown: ZOOM }[event.key];
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      if (turn) orbit(viewer, turn[0] * STEP, turn[1] * STEP, 1);
      else if (zoom) orbit(viewer, 0, 0, zoom);
      else if (event.key === "Home" || event.key === "0") home();
      else if (event.key === " " && bar) bar.toggle();
      else if (event.key === "f" && bar) bar.follow();
      else return;
      event.preventDefault();
      viewer.set_dirty();
    });
  }

  /* meshcat's camera frame has y up. */
  function orbit(viewer, azimuth, polar, zoom) {
    const { camera, controls } = viewer;
    const [x, y, z] = ["x", "y", "z"].map((axis) => camera.position[axis] - controls.target[axis]);
    const distance = Math.hypot(x, y, z);
    const theta = Math.atan2(x, z) + azimuth;
    const phi = Math.min(Math.max(Math.acos(y / distance) + polar, 0.02), controls.maxPolarAngle);
    const reach = Math.min(Math.max(distance * zoom, controls.minDistance), controls.maxDistance);
    camera.position.set(
      controls.target.x + reach * Math.sin(phi) * Math.sin(theta),
      controls.target.y + reach * Math.cos(phi),
      controls.target.z + reach * Math.sin(phi) * Math.cos(theta),
    );
    viewer.set_dirty();
  }

  /* The camera goes where the robot goes, and keeps the side and the distance that the reader chose. */
  function follow(state, data) {
    const { viewer } = state;
    const { x, y } = find(viewer, data.follow).position;
    const root = find(viewer, "/meshcat").position;
    const target = [x + root.x, 0, -(y + root.y)];
    const now = viewer.controls.target;
    const delta = [target[0] - now.x, 0, target[2] - now.z];
    now.set(...target);
    const at = viewer.camera.position;
    at.set(at.x + delta[0], at.y, at.z + delta[2]);
  }

  /* The robot at a pose (x, y [m], heading [rad]), and the camera behind and above it. */
  function put(viewer, [x, y, heading]) {
    const robot = find(viewer, ROBOT);
    robot.position.set(x, y, robot.position.z);
    robot.rotation.set(0, 0, heading);
    const root = find(viewer, "/meshcat").position; // z is up in it, y in the camera's frame
    const [ahead, aside] = [Math.cos(heading), Math.sin(heading)];
    viewer.controls.target.set(x + root.x + AHEAD * ahead, 0.1, -(y + root.y + AHEAD * aside));
    viewer.camera.position.set(x + root.x - BEHIND * ahead, ABOVE, -(y + root.y - BEHIND * aside));
    viewer.set_dirty();
  }

  function find(viewer, path) {
    return viewer.scene_tree.find(path.split("/").filter(Boolean)).object;
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
    const ranges = new DataView((scan.bytes ??= bytes(scan.ranges)).buffer);
    viewer.animator.seek(scan.times[which]);
    return Array.from({ length: scan.beams }, (_, i) => {
      const range = ranges.getUint16(2 * (which * scan.beams + i), true) / 1000;
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

  function playerBar(state, data, options) {
    const made = new WeakMap(); // the lines of each viewer: there is a new one when the page took the frame out
    const trails = () => {
      if (!made.has(state.viewer)) made.set(state.viewer, growing(state.viewer, data));
      state.viewer.animator.seek(state.time);
      return made.get(state.viewer);
    };
    const ink = { font: "inherit", color: "inherit" };
    const element = make("div", {}, {
      display: "flex", flexWrap: "wrap", gap: "0.4em 0.8em", alignItems: "center", padding: "0.4em 0.1em",
      color: "var(--rosmini-ink, inherit)", fontSize: "0.9em",
    });
    element.setAttribute("role", "group");
    element.setAttribute("aria-label", `Player: ${options.title}`);
    const button = make("button", { type: "button", textContent: "Play" }, {
      ...ink, minWidth: "4.5em", padding: "0.2em 0.8em", cursor: "pointer", background: "transparent",
      border: "1px solid var(--rosmini-group-line, #9aa5af)", borderRadius: "4px",
    });
    const slider = make("input", { type: "range", min: 0, max: data.duration, step: 0.05, value: 0 }, {
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
    const api = { element, seek, toggle, follow: () => box?.click(), follows: () => data.follow !== null && state.following, home: () => {} };
    const reset = () => {
      if (box && !box.checked) box.click();
      api.home();
    };
    const [back, forward] = [-1, 1].map((way) => () => { toggle(false); seek(state.time + way * JUMP); });
    const closer = (factor) => () => state.viewer && orbit(state.viewer, 0, 0, factor);
    element.append(small("\u25c2\u2758", "Step back", back), button, small("\u2758\u25b8", "Step forward", forward), slider, clock, speed,
      small("\u2212", "Zoom out", closer(ZOOM)), small("+", "Zoom in", closer(1 / ZOOM)), small("reset", "Reset the view", reset));
    let box = null;
    if (data.follow !== null) {
      box = make("input", { type: "checkbox", checked: true });
      const label = make("label", {}, { cursor: "pointer" });
      label.append(box, " follow");
      box.addEventListener("change", () => { state.following = box.checked; seek(state.time); });
      element.append(label);
    }

    const layered = data.layered ? globalThis.rosminiMeshcatLayers.decode(data.layered) : null;
    const solid = data.legend.map(([name, colour]) => [`/meshcat/trails/${name}`, name, colour]);
    if (data.scan) solid.push([data.scan.path, "laser", LASER]);
    for (const [key, name, colour] of [...solid, ...(layered?.switches ?? [])]) {
      const line = make("span", { ariaHidden: "true" }, {
        display: "inline-block", width: "1.4em", height: "0.25em", margin: "0 0.4em 0.2em 0.3em",
        background: colour,
      });
      const label = make("label", {}, { cursor: "pointer" });
      const chosen = make("input", { type: "checkbox", checked: true });
      chosen.addEventListener("change", () => { state.shown[key] = chosen.checked; seek(state.time); });
      label.append(chosen, line, name);
      element.append(label);
    }
    const answer = make("small", {}, { flexBasis: "100%" });
    answer.setAttribute("role", "status");
    /* Ask what the place costs around which the view turns, or stop asking. */
    const inquire = () => {
      const [target, root] = [state.viewer?.controls.target, state.viewer && find(state.viewer, "/meshcat").position];
      state.shown.asked = state.shown.asked || !target ? null : [target.x - root.x, -target.z - root.y];
      seek(state.time);
    };
    if (layered?.why) element.append(small("cost?", "What the place in the middle costs", inquire), answer);
    if (layered?.notes.length) element.append(make("small", { textContent: layered.notes.join(" ") }, { flexBasis: "100%" }));

    function seek(time) {
      state.time = Math.min(Math.max(time, 0), data.duration);
      slider.value = state.time;
      const text = `${state.time.toFixed(1)} s of ${data.duration.toFixed(1)} s`;
      slider.setAttribute("aria-valuetext", text);
      clock.value = text;
      const { viewer } = state;
      if (!viewer) return;
      viewer.animator.seek(state.time);
      grow(trails(), state.time / data.duration);
      if (data.scan) showScan(viewer, data.scan, state.time);
      for (const [path] of solid) find(viewer, path).visible = state.shown[path] !== false;
      layered?.show(state.frame, viewer, state.time, state.shown);
      const { asked } = state.shown;
      answer.textContent = asked ? `At ${(asked[0] + 0).toFixed(2)}, ${(asked[1] + 0).toFixed(2)} m: ${layered.why(state.time, asked)}` : "";
      if (data.follow !== null && state.following) follow(state, data);
      viewer.set_dirty();
    }

    function toggle(playing = !state.playing) {
      state.playing = playing;
      button.textContent = playing ? "Pause" : "Play";
      if (!playing) return;
      if (state.time >= data.duration) seek(0);
      let before = null;
      const next = (now) => {
        if (!state.playing || !element.isConnected) return toggle(false);
        if (before !== null) seek(state.time + (Number(speed.value) * (now - before)) / 1000);
        before = now;
        return state.time >= data.duration ? toggle(false) : requestAnimationFrame(next);
      };
      requestAnimationFrame(next);
    }

    button.addEventListener("click", () => toggle());
    slider.addEventListener("input", () => { toggle(false); seek(Number(slider.value)); });
    const keys = {
      " ": () => toggle(),
      ArrowLeft: back, ArrowDown: back, ArrowRight: forward, ArrowUp: forward,
      Home: () => { toggle(false); seek(0); }, End: () => { toggle(false); seek(data.duration); },
      "+": () => faster(1), "=": () => faster(1), "-": () => faster(-1), "_": () => faster(-1),
      PageUp: closer(1 / ZOOM), PageDown: closer(ZOOM), f: () => api.follow(), 0: reset, w: () => layered?.why && inquire(),
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

  globalThis.rosminiMeshcat = { mount, label, find };
})();
