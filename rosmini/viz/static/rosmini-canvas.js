/* Drawing a robot's world on a canvas: what the replay player and the teleoperation pad share.

   A plain script that sets `globalThis.rosminiCanvas`; no framework, nothing fetched. Metres and radians, x to the
   right, y up, angles counter-clockwise; a pose is [x, y, theta]. `scene` is what `rosmini.viz.replay.scene_data` makes.

     fit(canvas, bounds, {maxHeight, margin})  a view: sizes the canvas (crisp on HiDPI), reads the theme, and maps
                                               metres to pixels. Make a new one when `watch` says so.
     watch(canvas, redraw) -> stop()           calls redraw() when the size, the theme or the medium (print) changes.
     theme(element) -> {ink, blue, ...}        the palette that holds for an element.

     clear(view, {grid})                       empties it and paints the ground with a line each metre, or without a grid.
     world(view, scene)                        walls and obstacles, with the ground: clear() is not needed. Kept as a
                                               bitmap in the view, so that each further call is one copy,
                                               unless the view says that it is `fleeting`.
     scan(view, robot, poseOf, ranges)         laser hits and what the laser sees; poseOf(i) is where the robot was at
                                               beam i, which in a sweep differs from beam to beam. A beam that hit nothing
                                               is Infinity, null or 0; one that hit what is too near to be measured is
                                               negative: -Infinity (REP 117). `robot.lidar` has where it
                                               sits, x and y, its range max, and the first beam's angle, start, and the
                                               step between beams, where that is not a full turn from 0 on.
     trail(view, points, {colour, dashed, count})   a line through [x, y, ...] points, the first `count` of them.
     robot(view, robot, pose, {ghost, colour}) the robot from above; a ghost is an outline: where odometry puts it.
     thing(view, shapes, pose, {ghost})        something that moves: shapes in its own frame, at `pose`; a ghost is an outline.
     label(view, pose, text, {colour, below})  a word under a place, `below` metres under it.
     scaleBar(view, {unit, metre})             the length of some metres, or of another unit of which `metre` make a metre.

   A view has: context, width, height (CSS pixels), scale (pixels a metre), theme, x(metres), y(metres) to pixels, and
   metres(px, py) -> [x, y] back. */

(() => {
  "use strict";

  // rosmini/viz/style.py has these; a test keeps them equal. Pages with rosmini.css override them.
  const LIGHT = {
    "page": "#ffffff", "ink": "#1b2733", "muted": "#56636f", "line": "#5b6875", "group-fill": "#f4f6f8",
    "group-line": "#9aa5af", "blue": "#0072b2", "orange": "#d97f00", "green": "#00865f", "vermilion": "#d55e00",
    "purple": "#b85c93", "sky": "#3a9bd9",
  };
  const DARK = {
    "page": "#14181e", "ink": "#e8edf2", "muted": "#a3afba", "line": "#93a1ae", "group-fill": "#1c222a",
    "group-line": "#5c6a77", "blue": "#56b4e9", "orange": "#e69f00", "green": "#2fc79a", "vermilion": "#ff8f5c",
    "purple": "#dd9dc0", "sky": "#8fd0f5",
  };
  const DARK_PAGES = 'html[data-theme="dark"], body[data-jp-theme-light="false"], body.vscode-dark';
  const FONT = '"Helvetica Neue", Helvetica, Arial, "Liberation Sans", "DejaVu Sans", sans-serif';
  const TURN = 2 * Math.PI;
  const LEAST_ROBOT = 16; // pixels
  const WHEEL_WIDTH = 0.55; // how wide a wheel is, in its radius
  const LASER_BY = 0.2; // metres: a laser is drawn by its robot's length, but no larger than one of so long a robot
  const FOOT = 26; // pixels under the world, for the scale bar

  let printing = false; // what a page looks like in print cannot be asked before it is printed
  globalThis.addEventListener?.("beforeprint", () => { printing = true; });
  globalThis.addEventListener?.("afterprint", () => { printing = false; });

  function theme(element) {
    if (printing || matchMedia("print").matches) return LIGHT;
    const style = getComputedStyle(element);
    const fallback = document.querySelector(DARK_PAGES) ? DARK : LIGHT;
    return Object.fromEntries(
      Object.keys(LIGHT).map((name) => [name, style.getPropertyValue(`--rosmini-${name}`).trim() || fallback[name]]),
    );
  }

  function fit(canvas, bounds, { maxHeight = 520, margin = 0.15 } = {}) {
    const [left, bottom, right, top] = [bounds[0] - margin, bounds[1] - margin, bounds[2] + margin, bounds[3] + margin];
    canvas.style.display = "block";
    canvas.style.width = "100%";
    const width = canvas.clientWidth || 600;
    const room = Math.min(maxHeight - FOOT, (width * (top - bottom)) / (right - left));
    const height = Math.round(room + FOOT);
    const ratio = globalThis.devicePixelRatio || 1;
    canvas.style.height = `${height}px`;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    const context = canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    const scale = Math.min(width / (right - left), room / (top - bottom));
    const [middleX, middleY] = [(left + right) / 2, (bottom + top) / 2];
    return {
      context, width, height, ratio, scale,
      theme: theme(canvas),
      x: (metres) => width / 2 + (metres - middleX) * scale,
      y: (metres) => room / 2 - (metres - middleY) * scale,
      metres: (px, py) => [middleX + (px - width / 2) / scale, middleY - (py - room / 2) / scale],
    };
  }

  function watch(canvas, redraw) {
    const print = matchMedia("print");
    const density = matchMedia(`(resolution: ${globalThis.devicePixelRatio || 1}dppx)`);
    const themes = new MutationObserver(redraw);
    const filter = { attributes: true, attributeFilter: ["data-theme", "data-jp-theme-light", "class"] };
    themes.observe(document.documentElement, filter);
    themes.observe(document.body, filter);
    let width = canvas.clientWidth;
    const sizes = new ResizeObserver(() => {
      // fit() sets the height itself: only a new width is news.
      if (canvas.clientWidth === width) return;
      width = canvas.clientWidth;
      redraw();
    });
    sizes.observe(canvas);
    for (const media of [print, density]) media.addEventListener("change", redraw);
    for (const event of ["beforeprint", "afterprint"]) globalThis.addEventListener(event, redraw);
    return () => {
      themes.disconnect();
      sizes.disconnect();
      for (const media of [print, density]) media.removeEventListener("change", redraw);
      for (const event of ["beforeprint", "afterprint"]) globalThis.removeEventListener(event, redraw);
    };
  }

  function path(view, points, count = points.length) {
    const { context } = view;
    context.beginPath();
    for (let i = 0; i < count; i += 1) context.lineTo(view.x(points[i][0]), view.y(points[i][1]));
  }

  function clear(view, { grid = true } = {}) {
    const { context, theme: colours, width, height, scale } = view;
    context.fillStyle = colours.page;
    context.fillRect(0, 0, width, height);
    if (!grid) return;
    const step = scale >= 12 ? 1 : scale >= 3 ? 5 : 20;
    const [left, top] = view.metres(0, 0);
    const [right, bottom] = view.metres(width, height);
    context.beginPath();
    for (let x = Math.ceil(left / step) * step; x <= right; x += step) {
      context.moveTo(view.x(x), 0);
      context.lineTo(view.x(x), height);
    }
    for (let y = Math.ceil(bottom / step) * step; y <= top; y += step) {
      context.moveTo(0, view.y(y));
      context.lineTo(width, view.y(y));
    }
    context.globalAlpha = 0.25;
    context.lineWidth = 1;
    context.strokeStyle = colours["group-line"];
    context.stroke();
    context.globalAlpha = 1;
  }

  function drawShape(view, shape, ghost = false) {
    const { context, theme: colours } = view;
    const solid = shape.colour === "wall";
    const own = shape.dark && isDark(colours.page) ? shape.dark : shape.colour;
    const colour = solid ? colours.muted : own[0] === "#" ? own : (colours[own] ?? colours.line);
    if (shape.kind === "disc") {
      context.beginPath();
      context.arc(view.x(shape.x), view.y(shape.y), shape.r * view.scale, 0, TURN);
    } else {
      path(view, shape.points);
      context.closePath();
    }
    context.fillStyle = context.strokeStyle = colour;
    context.globalAlpha = solid ? 1 : ghost ? 0.12 : shape.bottom ? 0.16 : 0.32; // what one passes under is fainter
    context.fill();
    context.globalAlpha = 1;
    context.lineWidth = shape.bottom ? 0.7 : 1.4;
    context.setLineDash(ghost ? [4, 3] : []);
    context.stroke();
    context.setLineDash([]);
  }

  const isDark = (page) => /^#[0-7]/.test(page);

  function thing(view, shapes, [x, y, theta], { ghost = false } = {}) {
    const [c, s] = [Math.cos(theta), Math.sin(theta)];
    const put = ([px, py]) => [x + c * px - s * py, y + s * px + c * py];
    for (const shape of shapes) {
      const [cx, cy] = shape.kind === "disc" ? put([shape.x, shape.y]) : [0, 0];
      drawShape(view, shape.kind === "disc" ? { ...shape, x: cx, y: cy } : { ...shape, points: shape.points.map(put) }, ghost);
    }
  }

  function label(view, [x, y], text, { colour = "ink", below = 0 } = {}) {
    const { context, theme: colours } = view;
    const [px, py] = [view.x(x), view.y(y) + Math.max(below * view.scale, LEAST_ROBOT) + 2];
    context.font = `12px ${FONT}`;
    context.textAlign = "center";
    context.textBaseline = "top";
    context.lineWidth = 3;
    context.lineJoin = "round";
    context.strokeStyle = colours.page;
    context.fillStyle = colours[colour] ?? colours.ink;
    context.strokeText(text, px, py);
    context.fillText(text, px, py);
    context.textAlign = "start";
  }

  function world(view, scene) {
    const { context, ratio, width, height } = view;
    if (view.world?.scene !== scene) {
      clear(view);
      context.lineJoin = context.lineCap = "round";
      for (const shape of scene.shapes) drawShape(view, shape);
      context.beginPath();
      for (const [x1, y1, x2, y2] of scene.segments) {
        context.moveTo(view.x(x1), view.y(y1));
        context.lineTo(view.x(x2), view.y(y2));
      }
      context.lineWidth = 2.5;
      context.strokeStyle = view.theme.muted;
      context.stroke();
      if (view.fleeting) return;
      const bitmap = document.createElement("canvas");
      [bitmap.width, bitmap.height] = [Math.round(width * ratio), Math.round(height * ratio)];
      bitmap.getContext("2d").drawImage(context.canvas, 0, 0);
      view.world = { scene, bitmap };
    } else {
      context.drawImage(view.world.bitmap, 0, 0, width, height);
    }
  }

  function scan(view, robot, poseOf, ranges) {
    const { context, theme: colours, scale } = view;
    const { x: ahead, y: aside = 0, max, start = 0, step = TURN / ranges.length } = robot.lidar;
    const laserAt = ([x, y, theta]) => {
      const [c, s] = [Math.cos(theta), Math.sin(theta)];
      return [x + c * ahead - s * aside, y + s * ahead + c * aside, theta];
    };
    const hits = [];
    context.beginPath();
    if (ranges.length === 1 || ranges.length * step < TURN - 1.5 * step) { // a fan
      const [x, y] = laserAt(poseOf(0));
      context.lineTo(view.x(x), view.y(y));
    }
    for (let i = 0; i < ranges.length; i += 1) {
      const hit = ranges[i] > 0 && Number.isFinite(ranges[i]);
      const range = hit ? ranges[i] : ranges[i] < 0 ? 0 : max;
      const [x, y, theta] = laserAt(poseOf(i));
      const angle = theta + start + step * i;
      const [px, py] = [view.x(x + range * Math.cos(angle)), view.y(y + range * Math.sin(angle))];
      context.lineTo(px, py);
      if (hit) hits.push(px, py);
    }
    context.fillStyle = colours.vermilion;
    if (ranges.length === 1) { // one beam passes no area, but a line
      context.strokeStyle = colours.vermilion;
      context.lineWidth = 1.2;
      context.globalAlpha = 0.5;
      context.stroke();
    } else {
      context.closePath();
      context.globalAlpha = 0.11;
      context.fill();
    }
    context.globalAlpha = 1;
    const size = Math.max(1, Math.min(1.8, 0.014 * scale));
    context.beginPath();
    for (let i = 0; i < hits.length; i += 2) {
      context.moveTo(hits[i] + size, hits[i + 1]);
      context.arc(hits[i], hits[i + 1], size, 0, TURN);
    }
    context.fill();
  }

  function trail(view, points, { colour = "blue", dashed = false, count = points.length } = {}) {
    const { context } = view;
    path(view, points, Math.min(count, points.length));
    context.setLineDash(dashed ? [6, 4] : []);
    context.lineJoin = "round";
    context.lineCap = "butt";
    context.lineWidth = 2;
    context.strokeStyle = view.theme[colour];
    context.stroke();
    context.setLineDash([]);
  }

  /* The largest radius of a rounded corner that leaves half of each side to the next one. */
  function roundest([ax, ay], [x, y], [bx, by]) {
    const side = Math.min(Math.hypot(ax - x, ay - y), Math.hypot(bx - x, by - y));
    const angle = Math.abs(Math.atan2((ax - x) * (by - y) - (ay - y) * (bx - x), (ax - x) * (bx - x) + (ay - y) * (by - y)));
    return (side / 2) * Math.tan(angle / 2);
  }

  /* Plate, wheels, laser and a nose, to scale but never under 16 pixels long, where none of them could be seen. */
  function robot(view, model, pose, { ghost = false, colour = "blue" } = {}) {
    const { context, theme: colours } = view;
    const xs = model.footprint.map((corner) => corner[0]);
    const [back, front] = [Math.min(...xs), Math.max(...xs)];
    const length = front - back;
    const scale = Math.max(view.scale, LEAST_ROBOT / length);
    const pixel = 1 / scale;
    context.save();
    context.translate(view.x(pose[0]), view.y(pose[1]));
    context.rotate(-pose[2]);
    context.scale(scale, -scale); // from here on: metres, seen from base_footprint
    context.lineJoin = "round";

    const plate = new Path2D();
    const corners = model.footprint;
    const [last, first] = [corners.at(-1), corners[0]];
    plate.moveTo((last[0] + first[0]) / 2, (last[1] + first[1]) / 2);
    corners.forEach(([x, y], i) => {
      const [next, before] = [corners[(i + 1) % corners.length], corners.at(i - 1)];
      plate.arcTo(x, y, (x + next[0]) / 2, (y + next[1]) / 2, Math.min(0.2 * length, roundest(before, [x, y], next)));
    });
    plate.closePath();
    const nose = new Path2D();
    const reach = Math.max(0.5 * length, 9 * pixel);
    nose.moveTo(front + 1.5 * pixel, -0.6 * reach);
    nose.lineTo(front + 1.5 * pixel + reach, 0);
    nose.lineTo(front + 1.5 * pixel, 0.6 * reach);
    nose.closePath();

    for (const part of [plate, nose]) {
      context.lineWidth = (ghost ? 1.6 : 1.2) * pixel;
      context.setLineDash(ghost ? [3 * pixel, 2 * pixel] : []);
      context.fillStyle = colours[colour] ?? colours.blue;
      context.strokeStyle = ghost ? colours.orange : colours.page;
      if (!ghost) context.fill(part);
      context.stroke(part);
    }
    if (!ghost) {
      const { wheel_radius: radius, wheel_separation: separation, lidar } = model;
      context.fillStyle = colours.ink;
      for (const side of [-separation / 2, separation / 2]) {
        context.fillRect(-radius, side - WHEEL_WIDTH * radius / 2, 2 * radius, WHEEL_WIDTH * radius);
      }
      for (const [fill, size] of lidar ? [[colours.page, 0.26], [colours.vermilion, 0.11]] : []) {
        context.beginPath();
        context.arc(lidar.x, 0, size * Math.min(length, LASER_BY), 0, TURN);
        context.fillStyle = fill;
        context.fill();
      }
    }
    context.restore();
  }

  function scaleBar(view, { unit = "m", metre = 1 } = {}) {
    const { context, theme: colours, width, height } = view;
    const scale = view.scale / metre;
    const length = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100].find((units) => units * scale >= Math.max(56, width / 9)) ?? 200;
    const [x, y, size] = [8, height - 6, length * scale];
    const label = unit === "m" && length < 1 ? `${Math.round(100 * length)} cm` : `${length} ${unit}`;
    context.font = `12px ${FONT}`;
    context.textBaseline = "bottom";
    context.beginPath();
    context.moveTo(x, y - 5);
    context.lineTo(x, y);
    context.lineTo(x + size, y);
    context.lineTo(x + size, y - 5);
    context.lineCap = "butt";
    context.lineJoin = "round";
    for (const [ink, wider] of [[colours.page, 4], [colours.ink, 0]]) { // a rim keeps it readable on a map
      context.strokeStyle = context.fillStyle = ink;
      context.lineWidth = 1.5 + wider;
      context.stroke();
      context.lineWidth = wider;
      if (wider) context.strokeText(label, x + 5, y - 2);
      context.fillText(label, x + 5, y - 2);
    }
  }

  globalThis.rosminiCanvas = { fit, watch, theme, clear, world, scan, trail, robot, thing, label, scaleBar };
})();
