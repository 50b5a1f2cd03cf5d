/* What a replay in three dimensions shows beside robots: maps, costmaps, plans, particles on the ground, pictures above.

   A plain script that needs `rosmini-canvas.js`, `rosmini-replay-data.js` and `rosmini-replay-layers.js`, whose layers it has
   draw as on their canvas: that canvas lies on the ground as a texture. It sets `globalThis.rosminiMeshcatLayers`:

     decode(data)    {switches, notes, show(frame, viewer, time, shown), why(time, place)} from `layered` of
                     `rosmini/viz/meshcat/runs.py`. switches are [key, name, colour]; time is seconds after the start;
                     `shown[key]` says what is on, and `shown.asked` at which place, [x, y] [m], there is a cross. `why` is
                     absent where there is no map. */

(() => {
  "use strict";

  const FINEST = 100; // pixels a metre
  const MOST = 2048; // pixels a side
  const REFRESH = 0.1; // seconds: what moves is drawn so often on the ground, since a texture is dear
  const HEIGHT = 0.003; // metres: above the grid on the ground, under the lines that robots leave

  /* The texture on the ground of one viewer, and the canvas for pictures above it. */
  function stage(frame, viewer, [x0, y0, x1, y1]) {
    const { THREE } = frame.contentWindow.MeshCat;
    const scale = Math.min(FINEST, MOST / (x1 - x0), MOST / (y1 - y0));
    const canvas = Object.assign(document.createElement("canvas"), {
      width: Math.ceil(scale * (x1 - x0)), height: Math.ceil(scale * (y1 - y0)),
    });
    const map = new THREE.CanvasTexture(canvas);
    map.colorSpace = "srgb";
    map.anisotropy = 8;
    const plane = new THREE.Mesh(
      new THREE.PlaneGeometry(x1 - x0, y1 - y0),
      new THREE.MeshBasicMaterial({ map, transparent: true, depthWrite: false, toneMapped: false }),
    );
    plane.name = "layers";
    plane.position.set((x0 + x1) / 2, (y0 + y1) / 2, HEIGHT);
    viewer.scene_tree.find(["meshcat"]).object.add(plane);
    const above = frame.contentDocument.createElement("canvas");
    Object.assign(above.style, { position: "absolute", inset: "0", width: "100%", height: "100%", pointerEvents: "none" });
    frame.contentDocument.body.append(above);
    const view = {
      context: canvas.getContext("2d"), width: canvas.width, height: canvas.height, ratio: 1, scale, fleeting: true,
      x: (metres) => (metres - x0) * scale, y: (metres) => (y1 - metres) * scale,
    };
    return { viewer, view, map, above, drawn: null };
  }

  function cross({ context, theme, x, y }, [px, py]) {
    context.beginPath();
    for (const [dx, dy] of [[12, 0], [0, 12]]) {
      context.moveTo(x(px) - dx, y(py) - dy);
      context.lineTo(x(px) + dx, y(py) + dy);
    }
    context.lineWidth = 3;
    context.strokeStyle = theme.ink;
    context.stroke();
  }

  function decode(data) {
    const more = globalThis.rosminiReplayLayers;
    const layers = data.layers.map((each) => more.decode(each));
    const bodies = data.bodies.map((each) => more.body(each));
    const flat = layers.filter((layer) => !layer.above);
    const pictures = layers.filter((layer) => layer.above);
    const palette = globalThis.rosminiCanvas.theme(document.body);
    const variable = (colour) => (palette[colour] ? `var(--rosmini-${colour}, ${palette[colour]})` : colour);
    const switches = [
      ...bodies.map(({ name, colour }) => [`body ${name}`, name, variable(colour)]),
      ...layers.map(({ name, colour }) => [`layer ${name}`, name, variable(colour)]),
    ];
    const isOn = (shown, kind) => ({ name }) => shown[`${kind} ${name}`] !== false;
    let made = null; // there is a new viewer when the page took the frame out and put it back

    function show(frame, viewer, time, shown) {
      if (made?.viewer !== viewer) made = stage(frame, viewer, data.bounds);
      const theme = globalThis.rosminiCanvas.theme(frame);
      const now = data.start + time;
      const moving = bodies.filter(isOn(shown, "body"));
      const still = flat.filter(isOn(shown, "layer"));
      const key = JSON.stringify([theme.ink, still.map((layer) => [layer.name, layer.moment(now, data.start)]), moving.map((each) => [each.name, each.at(Math.floor(now / REFRESH) * REFRESH)]), shown.asked]);
      if (key !== made.drawn) {
        const { view, map } = made;
        view.theme = theme;
        view.context.clearRect(0, 0, view.width, view.height);
        for (const layer of still) layer.draw(view, now, data.start);
        for (const body of moving) body.draw(view, now, body.trail);
        if (shown.asked) cross(view, shown.asked);
        map.needsUpdate = true;
        made.drawn = key;
      }
      hang(made.above, theme, pictures.filter(isOn(shown, "layer")), now);
    }

    /* Pictures of cameras in the corner, one below the other. */
    function hang(canvas, theme, seen, now) {
      if (!pictures.length) return;
      Object.assign(canvas, { width: canvas.clientWidth, height: canvas.clientHeight });
      const view = { context: canvas.getContext("2d"), width: canvas.width, height: canvas.height, theme };
      let slot = 0;
      for (const layer of seen) slot += layer.draw(view, now, data.start, slot) ? 1 : 0;
    }

    const why = layers.some((layer) => layer.tellAt) && ((time, place) => more.why(layers, data.start + time, place));
    return { switches, notes: data.notes, show, why };
  }

  globalThis.rosminiMeshcatLayers = { decode };
})();
