/* What the replay player shows beside robots: maps, plans, particles, scans, markers, pictures, strokes.

   A plain script that needs `rosmini-canvas.js` and `rosmini-replay-data.js` and sets `globalThis.rosminiReplayLayers`:

     decode(data)             a layer from what `rosmini.viz.replay.layers` (grids, images) made:
                              {name, colour, moment(time, start), draw(view, time, start, slot)}; times are seconds.
     why(layers, time, [x, y])   what a place costs, layer by layer, in words.
     body(data, turtle)       something that moves: {name, colour, at(time), isThere(time), draw(view, time)}; a turtle of this length
                              [m], if it is one.

   A layer shows what came last, and nothing before its first moment. */

(() => {
  "use strict";

  const { unpack, naturals, columns, lastAt } = globalThis.rosminiReplayData;
  const LENGTH = 1e-3;
  const ANGLE = 1e-4;
  const TIME = 1e-3;
  const COARSE = 0.01;
  const COARSE_ANGLE = 0.02;
  const MAP_ALPHA = 0.7; // as RViz draws maps
  const INSET = 0.24; // the width of a camera's picture, in that of the canvas
  const TURN = 2 * Math.PI;
  const MODES = ["points", "line", "closed", "arrows"];

  const paint = (view, colour) => (colour[0] === "#" ? colour : (view.theme[colour] ?? view.theme.line));

  /* Where each of `counts` things begins in a row of all of them. */
  function starts(counts) {
    const found = [0];
    for (const count of counts) found.push(found.at(-1) + count);
    return found;
  }

  /* Cells or pixels in runs: the ones before, laid at (dx, dy), then runs of what differs. */
  class Runs {
    constructor(data, size) {
      [this.tokens, this.size] = [naturals(data.runs), size];
      this.starts = starts(unpack(data.counts, 1));
      this.reset();
    }

    reset() {
      [this.index, this.cells, this.width, this.height] = [-1, new Uint8Array(0), 0, 0];
    }

    /* The cells of a moment; whoever goes back begins anew. */
    seek(index) {
      if (index < this.index) this.reset();
      while (this.index < index) this.step();
      return this.cells;
    }

    step() {
      this.index += 1;
      const { width, height, dx, dy } = this.size(this.index);
      const next = new Uint8Array(width * height);
      for (let row = Math.max(0, dy); row < Math.min(height, dy + this.height); row += 1) {
        const [from, to] = [Math.max(0, dx), Math.min(width, dx + this.width)];
        const source = (row - dy) * this.width - dx;
        if (from < to) next.set(this.cells.subarray(source + from, source + to), row * width + from);
      }
      let at = 0;
      for (let i = 3 * this.starts[this.index]; i < 3 * this.starts[this.index + 1]; i += 3) {
        at += this.tokens[i];
        next.fill(this.tokens[i + 2], at, at + this.tokens[i + 1]);
        at += this.tokens[i + 1];
      }
      Object.assign(this, { cells: next, width, height });
    }
  }

  /* A bitmap of cells by a table of colours [r, g, b, a]. */
  function bitmap(cells, width, height, table) {
    const canvas = Object.assign(document.createElement("canvas"), { width, height });
    const context = canvas.getContext("2d");
    const image = context.createImageData(width, height);
    cells.forEach((cell, i) => image.data.set(table[cell] ?? [0, 0, 0, 0], 4 * i));
    context.putImageData(image, 0, 0);
    return canvas;
  }

  /* What a colour of RViz's schemes stands for: -1 unknown, 0 free, to 99 inscribed and 100 occupied; by its number. */
  function valueOf([red, green, blue, alpha], number) {
    if (number === 0) return -1;
    if (alpha === 0) return 0;
    if (red === green && green === blue) return Math.round((255 - red) / 2.55);
    return [[green, 99], [red === 255 && blue, 100], [green === 0, Math.round(red / 2.55)]].find(([is]) => is)?.[1];
  }

  const REACH = 1.5; // how far from a cell an obstacle is looked for [m]

  /* Which occupied cell is nearest to (mx, my), and how far from it [cells]. */
  function nearest(isFull, mx, my, reach) {
    let found = null;
    for (let dy = -reach; dy <= reach; dy += 1) {
      for (let dx = -reach; dx <= reach; dx += 1) {
        const apart = Math.hypot(dx, dy);
        if (apart < (found?.apart ?? reach) && isFull(mx + dx, my + dy)) found = { mx: mx + dx, my: my + dy, apart };
      }
    }
    return found;
  }

  function grid(data) {
    const isCostmap = data.name.includes("costmap");
    const table = data.colours.map((c) => [1, 3, 5, 7].map((i) => parseInt(c.slice(i, i + 2), 16)));
    const places = columns(data.places, [1, 1, 1e-6, LENGTH, LENGTH, ANGLE, 1, 1]);
    const runs = new Runs(data, (i) => {
      const [width, height, , , , , dx, dy] = places[i];
      return { width, height, dx, dy };
    });
    const values = table.map(valueOf);
    let [shown, picture] = [-1, null];
    return {
      colour: "muted",
      isMap: !isCostmap,
      /* What a place costs in one moment, and the obstacle that it comes from, if it comes from one: {text, from?}. */
      tell(index, x, y) {
        const [width, height, resolution, x0, y0, heading] = places[index];
        const [c, s] = [Math.cos(heading) / resolution, Math.sin(heading) / resolution];
        const [mx, my] = [c * (x - x0) + s * (y - y0), c * (y - y0) - s * (x - x0)].map(Math.floor);
        const isThere = (i, j) => i >= 0 && j >= 0 && i < width && j < height;
        if (!isThere(mx, my)) return { text: "outside" };
        const cells = runs.seek(index);
        shown = -1;
        const value = values[cells[my * width + mx]];
        if (value === undefined || value < 0) return { text: "unknown" };
        if (!isCostmap) return { text: value >= 65 ? "occupied" : value ? `${value}%` : "free", value };
        const isFull = (i, j) => isThere(i, j) && values[cells[j * width + i]] === 100;
        const full = value ? nearest(isFull, mx, my, Math.round(REACH / resolution)) : null;
        const [i, j] = full ? [(full.mx + 0.5) * resolution, (full.my + 0.5) * resolution] : [];
        const turn = resolution * c;
        const from = full && { x: x0 + turn * i - resolution * s * j, y: y0 + resolution * s * i + turn * j };
        const why = full ? `inflated, ${(full.apart * resolution).toFixed(2)} m from an obstacle` : "inflated";
        const words = { 0: "free", 99: `99, too near: ${why}`, 100: "100, an obstacle" };
        return { text: words[value] ?? `about ${value}, ${why}`, value, from };
      },
      draw(view, index) {
        const [width, height, resolution, x, y, heading] = places[index];
        if (shown !== index) [shown, picture] = [index, bitmap(runs.seek(index), width, height, table)];
        const { context } = view;
        const scale = resolution * view.scale;
        context.save();
        context.globalAlpha = MAP_ALPHA;
        context.imageSmoothingEnabled = scale < 1;
        context.translate(view.x(x), view.y(y));
        context.rotate(-heading);
        context.scale(scale, -scale);
        context.drawImage(picture, 0, 0);
        context.restore();
      },
    };
  }

  function images(data) {
    const { width, height } = data;
    const runs = new Runs(data, (i) => ({ width, height, dx: 0, dy: 0, i }));
    const table = Array.from({ length: 64 }, (_, i) => [85 * (i >> 4), 85 * ((i >> 2) & 3), 85 * (i & 3), 255]);
    let [shown, picture] = [-1, null];
    return {
      colour: "line",
      above: true,
      draw(view, index, slot) {
        if (shown !== index) [shown, picture] = [index, bitmap(runs.seek(index), width, height, table)];
        const { context, theme } = view;
        const wide = Math.max(110, INSET * view.width);
        const high = (wide * height) / width;
        const [x, y] = [view.width - wide - 8, 8 + slot * (high + 8)];
        context.drawImage(picture, x, y, wide, high);
        context.lineWidth = 1;
        context.strokeStyle = theme.ink;
        context.strokeRect(x, y, wide, high);
      },
    };
  }

  function scans(data) {
    const poses = columns(data.poses, [LENGTH, LENGTH, ANGLE]);
    const ranges = unpack(data.ranges, data.unit);
    const robot = { lidar: { x: 0, y: 0, max: data.max, start: data.start, step: data.step } };
    return {
      colour: "vermilion",
      dotted: true,
      early: true,
      draw(view, index) {
        const seen = ranges.slice(index * data.beams, (index + 1) * data.beams);
        globalThis.rosminiCanvas.scan(view, robot, () => poses[index], seen);
      },
    };
  }

  /* A short line with a head, `length` pixels long, at a pose. */
  function arrow(context, x, y, heading, length) {
    const [dx, dy] = [length * Math.cos(heading), -length * Math.sin(heading)];
    context.moveTo(x, y);
    context.lineTo(x + dx, y + dy);
    for (const side of [0.5, -0.5]) {
      context.moveTo(x + dx, y + dy);
      const back = heading + Math.PI + side;
      context.lineTo(x + dx + 0.4 * length * Math.cos(back), y + dy - 0.4 * length * Math.sin(back));
    }
  }

  function shapes(data) {
    const groups = unpack(data.groups, 1);
    const first = starts(unpack(data.counts, 1));
    const [points, headings] = [columns(data.points, [COARSE, COARSE]), unpack(data.headings, COARSE_ANGLE)];
    const all = [];
    let [point, heading] = [0, 0];
    for (let i = 0; i < groups.length; i += 3) {
      const [mode, colour, count] = [MODES[groups[i]], data.colours[groups[i + 1]], groups[i + 2]];
      all.push({ mode, colour, count, point, heading });
      point += count;
      if (mode === "arrows") heading += count;
    }
    return {
      colour: data.colours[0] ?? "line",
      draw(view, index) {
        const { context } = view;
        for (const { mode, colour, count, point: from, heading: turned } of all.slice(first[index], first[index + 1])) {
          context.beginPath();
          context.fillStyle = context.strokeStyle = paint(view, colour);
          context.lineWidth = mode === "arrows" && count > 1 ? 1 : 2;
          const length = count > 1 ? 9 : 24;
          for (let i = from; i < from + count; i += 1) {
            const [x, y] = [view.x(points[i][0]), view.y(points[i][1])];
            if (mode === "arrows") arrow(context, x, y, headings[turned + i - from], length);
            else if (mode === "points") {
              context.moveTo(x + 2.2, y);
              context.arc(x, y, 2.2, 0, TURN);
            } else context.lineTo(x, y);
          }
          if (mode === "closed") context.closePath();
          if (mode === "points") context.fill();
          else context.stroke();
        }
      },
    };
  }

  function strokes(data) {
    const points = columns(data.points, [TIME, LENGTH, LENGTH]);
    const first = starts(data.pens.map((pen) => pen[3]));
    return {
      colour: data.pens[0]?.[0] ?? "line",
      always: true,
      drawAt(view, time) {
        const { context } = view;
        context.lineCap = context.lineJoin = "round";
        data.pens.forEach(([colour, width, until], which) => {
          const [from, end] = [first[which], first[which + 1]];
          if (points[from][0] > time + 1e-9 || (until !== null && until * TIME <= time)) return;
          context.beginPath();
          let i = from;
          for (; i < end && points[i][0] <= time + 1e-9; i += 1) context.lineTo(view.x(points[i][1]), view.y(points[i][2]));
          if (i < end) {
            const [before, after] = [points[i - 1], points[i]];
            const part = (time - before[0]) / (after[0] - before[0]);
            const [x, y] = [1, 2].map((axis) => before[axis] + part * (after[axis] - before[axis]));
            context.lineTo(view.x(x), view.y(y));
          }
          context.lineWidth = width;
          context.strokeStyle = paint(view, colour);
          context.stroke();
        });
      },
    };
  }

  const KINDS = { grid, images, scans, shapes, strokes };

  function decode(data) {
    const layer = KINDS[data.kind](data);
    const times = data.times === undefined ? [] : unpack(data.times, TIME);
    return {
      ...layer,
      name: data.name,
      kind: data.kind,
      tellAt: layer.tell && ((time, x, y) => {
        const index = lastAt(times, time);
        return index < 0 ? { text: "not there yet" } : layer.tell(index, x, y);
      }),
      /* What it shows at a time: which of its moments, -1 for nothing. */
      moment(time, start) {
        if (layer.always) return time;
        const index = lastAt(times, time);
        // what a laser measures a moment after the start is there from the start
        return index < 0 && layer.early && times[0] - start < 1 ? 0 : index;
      },
      draw(view, time, start, slot) {
        if (layer.always) return layer.drawAt(view, time);
        const index = this.moment(time, start);
        if (index < 0) return false;
        layer.draw(view, index, slot);
        return true;
      },
    };
  }

  /* An arrow head, in pixels. */
  const HEAD = [[13, 0], [-9, 8], [-5, 0], [-9, -8]];
  const LEAST = 14; // pixels: an outline is not drawn smaller
  const LEAST_TURTLE = 30; // pixels

  /* A turtle of 45 pixels that faces right, in the colour of its shell. */
  const LIMBS = new Path2D(`M-14,-2.5L-22,0L-14,2.5ZM12,0a5.5,4.8 0 1,0 11,0a5.5,4.8 0 1,0 -11,0Z${
    [[4, -12.5], [4, 12.5], [-14, -12.5], [-14, 12.5]].map(([x, y]) => `M${x},${y}a5,3.6 0 1,0 10,0a5,3.6 0 1,0 -10,0Z`).join("")}`);
  const SHELL = new Path2D("M-15,0a15,12 0 1,0 30,0a15,12 0 1,0 -30,0Z");
  const PATTERN = new Path2D("M-6,0L-3,-5.2L3,-5.2L6,0L3,5.2L-3,5.2ZM6,0H14M-6,0H-14M3,-5.2L7,-10M3,5.2L7,10M-3,-5.2L-7,-10M-3,5.2L-7,10");
  const EYES = new Path2D("M17.5,-2.6h0.1M17.5,2.6h0.1");
  const LONGEST = 45;
  const DARK = "#1b2733";

  function drawTurtle(context, colour, edge, scale) {
    context.scale(scale, scale);
    context.lineCap = context.lineJoin = "round";
    for (const [path, width, stroke, fill] of [
      [LIMBS, 3, edge, colour], [SHELL, 3, edge, colour], [LIMBS, 0, "", colour], [SHELL, 2, DARK, colour], [PATTERN, 1.5, DARK],
      [EYES, 2.4, DARK],
    ]) {
      [context.lineWidth, context.strokeStyle, context.fillStyle] = [width, stroke, fill];
      if (width) context.stroke(path);
      if (fill) context.fill(path);
    }
  }

  function body(data, turtle) {
    const track = columns(data.track, [TIME, LENGTH, LENGTH, ANGLE]);
    const times = track.map((row) => row[0]);
    const [from, until] = [(data.from ?? -Infinity) * TIME, (data.until ?? Infinity) * TIME];
    function at(time) {
      const i = Math.max(0, lastAt(times, time));
      const [before, after] = [track[i], track[i + 1] ?? track[i]];
      const part = after[0] > before[0] ? Math.min(1, Math.max(0, (time - before[0]) / (after[0] - before[0]))) : 0;
      return [1, 2, 3].map((axis) => before[axis] + part * (after[axis] - before[axis]));
    }
    return {
      name: data.name,
      colour: data.colour,
      trail: data.trail !== false,
      at,
      isThere: (time) => time >= from && time < until,
      draw(view, time, withTrail) {
        if (!this.isThere(time)) return;
        const { context } = view;
        const pose = at(time);
        const colour = paint(view, data.colour);
        if (withTrail) {
          const count = lastAt(times, time) + 1;
          context.beginPath();
          for (let i = 0; i < count; i += 1) context.lineTo(view.x(track[i][1]), view.y(track[i][2]));
          context.lineTo(view.x(pose[0]), view.y(pose[1]));
          context.lineWidth = 2;
          context.lineJoin = "round";
          context.strokeStyle = colour;
          context.stroke();
        }
        const reach = data.outline ? Math.max(...data.outline.map(([x, y]) => Math.hypot(x, y))) : 0;
        const scale = reach ? Math.max(view.scale, LEAST / reach) : 1;
        context.save();
        context.translate(view.x(pose[0]), view.y(pose[1]));
        context.rotate(-pose[2]);
        if (turtle) {
          drawTurtle(context, colour, view.theme.page, Math.max((turtle * view.scale) / LONGEST, LEAST_TURTLE / LONGEST));
          context.restore();
          return;
        }
        context.beginPath();
        for (const [x, y] of data.outline ?? HEAD) context.lineTo(scale * x, -scale * y);
        context.closePath();
        context.fillStyle = colour;
        context.strokeStyle = view.theme.page;
        context.lineWidth = 1.5;
        context.fill();
        context.stroke();
        if (data.outline) { // a mark ahead, since an outline may be round
          context.beginPath();
          context.moveTo(0, 0);
          context.lineTo(scale * reach * 0.8, 0);
          context.stroke();
        }
        context.restore();
      },
    };
  }

  /* Why a place costs what it costs, layer by layer. An obstacle is on the map, if one is shown, or else seen. */
  function why(layers, time, [x, y]) {
    const grids = layers.filter((layer) => layer.tellAt);
    const maps = grids.filter((layer) => layer.isMap);
    const isMapped = ({ x: atX, y: atY }) => maps.some((layer) => layer.tellAt(time, atX, atY).value >= 65);
    return grids.map((layer) => {
      const { text, from } = layer.tellAt(time, x, y);
      const source = from && maps.length ? (isMapped(from) ? ", on the map" : ", seen by a sensor") : "";
      return `${layer.name}: ${text}${source}`;
    }).join("; ");
  }

  globalThis.rosminiReplayLayers = { decode, body, why };
})();
