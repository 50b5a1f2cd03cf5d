/* A three-dimensional scene in meshcat's viewer, with no server: replays the commands that a recorded window was sent.

   `rosminiMeshcat.mount(host, data, options)` as `rosmini/viz/embed.py` calls it. `data` is what `rosmini/viz/meshcat` makes:
   `commands` (what `squeezed.py` wrote), `themes` (colours of paths on light and dark pages), `legend` (names and colours of
   lines), `copies` with pairs of paths: at the second is once more what is at the first (or absent), `background` with the
   scene's own colour (or absent: that of the page), `labels` with words at points (or absent), and what only
   `rosmini-meshcat-player.js` reads, for scenes that move. Several runs side by side are {commands, duration, runs: [...]}: each has
   all the others, its `title`, and the `count` of its commands among those of all.
   `options.ready(viewer, frame)` is called for each viewer that is made. `label(window, viewer, each)` and `find(viewer, path)` are for those who change a scene that is shown.

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
  const ZOOM = 1.5; // of one press, as there
  const NARROW = 1.5; // width divided by height below which a picture would lose its sides
  const ROBOT = "/meshcat/robots/robot";

  const bytes = (text) => Uint8Array.from(atob(text), (character) => character.charCodeAt(0));

  /* The commands that `squeezed` of rosmini/viz/meshcat/compression.py wrote: of bytes that were there before is said how many and
     how far back. */
  function commandsOf(text) {
    const from = bytes(text);
    let at = 0;
    const number = (read) => {
      let [value, factor, byte] = [0, 1, 128];
      for (; byte > 127; factor *= 128) {
        byte = read();
        value += (byte & 127) * factor;
      }
      return value;
    };
    const next = () => from[at++];
    const all = [];
    while (at < from.length) {
      for (let count = number(next); count > 0; count -= 1) all.push(next());
      const back = number(next);
      for (let count = back && number(next); count > 0; count -= 1) all.push(all[all.length - back]);
    }
    const found = [];
    for (at = 0; at < all.length;) {
      const length = number(() => all[at++]);
      found.push(Uint8Array.from(all.slice(at, at + length)));
      at += length;
    }
    return found;
  }
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
    const commands = commandsOf(data.commands);
    let first = 0;
    const panes = (data.runs ?? [data]).map((run) => {
      const count = run.count ?? commands.length;
      first += count;
      return { data: run, commands: commands.slice(first - count, first), viewer: null, home: () => {} };
    });
    const bar = data.duration > 0 ? globalThis.rosminiMeshcatPlayer.bar(panes, data.duration, options) : null;
    const row = make("div", {}, { display: "grid", gap: "0.3rem", gridTemplateColumns: "repeat(auto-fit, minmax(min(100%, 18rem), 1fr))" });
    for (const pane of panes) {
      const part = make("div", {}, { minWidth: 0 });
      const { title } = pane.data;
      pane.title = title ? `${title}: ${options.title}` : options.title;
      if (title) part.append(make("p", { className: "rr-title", textContent: title }, { fontSize: "14px", fontWeight: 600, margin: 0, padding: "0.45rem 0.2rem 0.2rem" }));
      pane.frame = make("iframe", { title: pane.title }, {
        display: "block", width: "100%", height: `${options.height}px`, border: "0", borderRadius: "4px",
      });
      part.append(pane.frame);
      row.append(part);
    }
    host.append(...(data.runs ? [row] : panes.map((pane) => pane.frame)), ...(bar ? [bar.element] : []));
    onTheme(() => {
      for (const { viewer, data: run } of panes) if (viewer) paint(viewer, run);
      bar?.seek();
    });
    for (const pane of panes) {
      const { frame } = pane;
      frame.addEventListener("load", () => {
        if (frame.contentDocument.getElementById("pane")) start(pane, address, options, bar);
      });
      frame.srcdoc = '<!DOCTYPE html><html lang="en"><title>3D</title><style>html,body{margin:0;height:100%;overflow:hidden}'
        + "#pane{width:100vw;height:100vh}canvas{display:block;outline-offset:-3px}canvas:focus-visible{outline-style:solid;outline-width:3px}"
        + "p{bottom:6px;font:13px system-ui,sans-serif;left:10px;margin:0;pointer-events:none;position:fixed;visibility:hidden}"
        + "#pane:has(canvas:focus-visible)+p{visibility:visible}</style>"
        + '<body><div id="pane"></div><p aria-hidden="true"></p></body></html>';
    }
    options.show(true);
    return true;
  }

  function start(pane, address, options, bar) {
    const { data, frame } = pane;
    const page = frame.contentDocument;
    const script = page.createElement("script");
    script.onload = () => {
      const viewer = new frame.contentWindow.MeshCat.Viewer(page.getElementById("pane"));
      viewer.gui.domElement.style.display = "none";
      for (const command of pane.commands) viewer.handle_command_bytearray(command);
      for (const [from, to] of data.copies ?? []) { // what is there several times has one geometry
        const known = viewer.scene_tree.find([...parts(from), "<object>"]).object;
        viewer.set_object(parts(to), known.clone());
      }
      for (const each of data.labels ?? []) label(frame.contentWindow, viewer, each);
      pane.viewer = frame.contentWindow.viewer = viewer; // where meshcat's own page has it
      fit(viewer, frame.contentWindow);
      viewer.controls.minDistance = 0.15;
      viewer.controls.maxDistance = 60;
      viewer.controls.maxPolarAngle = Math.PI / 2 - 0.02; // not below the ground
      hands(pane, options, bar);
      paint(viewer, data);
      bar?.begin(pane);
      frame.dataset.ready = "";
      options.ready?.(viewer, frame);
    };
    script.onerror = () => { options.show(false); console.error(`${address} was not loaded`); };
    script.src = address;
    page.body.append(script);
  }

  /* A narrow picture shows as much to both sides as a wide one, and more above and below. */
  function fit(viewer, page) {
    const zoom = () => {
      viewer.camera.zoom = Math.min(viewer.camera.aspect / NARROW, 1);
      viewer.camera.updateProjectionMatrix();
      viewer.set_dirty();
    };
    page.addEventListener("resize", zoom); // after meshcat's own listener, which sets the aspect ratio
    zoom();
  }

  function paint(viewer, data) {
    const name = theme();
    const [top, bottom, ink] = data.background ?? GROUND[name];
    const page = viewer.dom_element.ownerDocument;
    page.body.style.background = `linear-gradient(${top}, ${bottom})`;
    viewer.renderer.domElement.style.outlineColor = page.querySelector("p").style.color = ink;
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
  function hands(pane, options, bar) {
    const { viewer } = pane;
    const canvas = viewer.renderer.domElement;
    const { controls, camera } = viewer;
    const begin = camera.position.clone();
    const middle = controls.target.clone();
    const home = () => {
      if (!bar?.follows(pane)) controls.target.copy(middle);
      camera.position.copy(begin).add(controls.target);
      viewer.set_dirty();
    };
    pane.home = home;
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "application");
    canvas.setAttribute("aria-label", `${pane.data.title ? `${pane.data.title}: ` : ""}${options.alt} Arrow keys turn it, plus and minus zoom, Home goes back.`);
    // Shown while the picture has the focus of the keyboard.
    canvas.ownerDocument.querySelector("p").textContent = `\u2190 \u2192 \u2191 \u2193 turn, + \u2212 zoom, Home resets${bar ? ", space plays" : ""}`;
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
      else if (event.key === "Home" || event.key === "0") (bar?.home ?? home)();
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

  function find(viewer, path) {
    return viewer.scene_tree.find(path.split("/").filter(Boolean)).object;
  }

  globalThis.rosminiMeshcat = { mount, label, find, make, orbit, ROBOT, ZOOM };
})();
