/* What the replay player plays: a run as `rosmini.viz.replay` packed it, decoded, and what is so in it at a time.

   A plain script, for runs that are none of a simulated robot with `rosmini-replay-layers.js`; it sets
   `globalThis.rosminiReplayData`:

     decode(data)                 the run in metres, radians and seconds.
     beamPose(run, time, beam)    where the robot of a decoded run was at a beam of the scan that has this time.
     unpack, naturals, columns, lastAt   for the script of the layers: what packing.py wrote, and where a time is in a row.
     the rest                     for the player: where things are at a time, and what it says of them. */

(() => {
  "use strict";

  const EARLY = 1; // seconds: a scan that comes so soon after the start is there from the start

  /* What `pack_natural` of rosmini/viz/replay/packing.py wrote. */
  function naturals(text) {
    const bytes = atob(text);
    const values = [];
    let [value, factor] = [0, 1];
    for (let i = 0; i < bytes.length; i += 1) {
      const byte = bytes.charCodeAt(i);
      value += (byte & 127) * factor;
      factor *= 128;
      if (byte & 128) continue;
      values.push(value);
      [value, factor] = [0, 1];
    }
    return values;
  }

  /* What `pack` wrote, times `unit`. */
  function unpack(text, unit) {
    let value = 0;
    return naturals(text).map((folded) => {
      value += folded % 2 ? -(folded + 1) / 2 : folded / 2;
      return value * unit;
    });
  }

  /* Columns that lie one after another, each with its unit, as rows. */
  function columns(text, units) {
    const values = unpack(text, 1);
    const count = values.length / units.length;
    return Array.from({ length: count }, (_, i) => units.map((unit, column) => values[i + column * count] * unit));
  }

  const LENGTH = 1e-3;
  const ANGLE = 1e-4;
  const TIME = 1e-3;
  const NANOSECOND = 1e-9;

  const POSE = [LENGTH, LENGTH, ANGLE];

  /* Logo's steps, as `rosmini.sim.logo` has them: how many make a metre, and where [0 0] is [m]. */
  const STEPS = { window: { metre: 45, middle: 249.5 / 45 }, floor: { metre: 100, middle: 0 } };

  function decode(data) {
    const { bodies, layers } = data;
    const ranges = unpack(data.scans ?? "", data.scan_unit ?? LENGTH);
    const beams = data.scene?.robot.lidar?.beams ?? 1;
    const tracked = (items) => (items ?? []).map((item) => ({ ...item, track: columns(item.track, POSE) }));
    const more = globalThis.rosminiReplayLayers;
    const start = data.start * TIME;
    const isWindow = data.background !== undefined; // of turtlesim, which has neither metres nor a ground
    const steps = data.name === "Logo" ? STEPS[isWindow ? "window" : "floor"] : undefined;
    const turtle = steps ? STEPS.window.metre / steps.metre : isWindow ? 1 : undefined; // length [m]
    return {
      scene: data.scene,
      start,
      end: (data.start + data.duration) * TIME,
      origin: data.scene ? 0 : start, // what the clock of the player counts from
      truth: columns(data.truth ?? "", POSE),
      odom: columns(data.odom ?? "", POSE),
      commands: columns(data.commands ?? "", [TIME, LENGTH, ANGLE]),
      name: data.name ?? "",
      title: data.title ?? data.name ?? "",
      others: tracked(data.others),
      things: tracked(data.things),
      increment: (data.time_increment ?? 0) * NANOSECOND,
      scans: unpack(data.scan_times ?? "", TIME).map((time, i) => [time, ranges.slice(i * beams, (i + 1) * beams)]),
      bounds: data.bounds,
      background: data.background,
      isWindow,
      steps,
      notes: data.notes ?? [],
      bodies: (bodies ?? []).map((each) => more.body(each, turtle)),
      layers: (layers ?? []).map((each) => more.decode(each)),
    };
  }

  /* Where in a row of times the last is that is not after `time`; -1 if all are. */
  function lastAt(times, time) {
    let [low, high] = [0, times.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (times[middle] <= time + 1e-9) low = middle + 1;
      else high = middle;
    }
    return low - 1;
  }

  /* The last of `items`, ordered by their first element, that is not after `time`. */
  const latest = (items, time) => items[lastAt(items.map((item) => item[0]), time)];

  /* The scan that holds at a time; soon after the start the first one does already. */
  const scanAt = (run, time) => latest(run.scans, time) ?? (run.scans[0]?.[0] - run.start < EARLY ? run.scans[0] : undefined);

  /* The part of the world that the run is about: all that its laser may have seen, and where it drove. */
  function bounds(run) {
    if (run.bounds) return run.bounds;
    const least = (values) => values.reduce((a, b) => Math.min(a, b));
    const most = (values) => values.reduce((a, b) => Math.max(a, b));
    const around = (points) => [least, most].flatMap((of) => [0, 1].map((axis) => of(points.map((point) => point[axis]))));
    const [left, bottom, right, top] = run.scene.bounds;
    const sight = run.scene.robot.lidar?.max ?? 3.5;
    const been = run.truth.concat(...run.others.map((other) => other.track));
    // odometry that runs away is not followed beyond what the laser may have seen
    const edge = around(been).map((side, i) => side + (i < 2 ? -sight : sight));
    const held = ([x, y]) => [Math.min(edge[2], Math.max(edge[0], x)), Math.min(edge[3], Math.max(edge[1], y))];
    const [x0, y0, x1, y1] = around(been.concat(run.odom.map(held)));
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

  /* A pose in the units of the program that a run is about: ROS's, turtlesim's, or Logo's. */
  function place([x, y, theta], { steps, isWindow } = {}) {
    if (steps) {
      const heading = (90 - (theta * 180) / Math.PI) % 360;
      const [right, up] = [x, y].map((side) => number((side - steps.middle) * steps.metre, 0));
      return `[${right} ${up}], heading ${number(Math.round(heading + 360) % 360, 0)}`;
    }
    if (isWindow) return `x ${number(x, 2)}, y ${number(y, 2)}, theta ${number(half(theta), 2)}`;
    return `${number(x, 2)}, ${number(y, 2)} m, ${degrees(theta)}\u00b0`;
  }

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

  /* What is so at a time, in words, [key, label, text]: where the robot is, where odometry puts it, what it was told. */
  function readings(run, time) {
    if (!run.scene) {
      return run.bodies.slice(0, 4).map((body, i) => [`body${i}`, body.name, body.isThere(time) ? place(body.at(time), run) : "not there"]);
    }
    const [truth, odom] = [poseAt(run, run.truth, time), poseAt(run, run.odom, time)];
    const command = latest(run.commands, time);
    const off = Math.hypot(odom[0] - truth[0], odom[1] - truth[1]);
    return [
      ["truth", "Robot", place(truth)],
      ["odom", "Odometry", place(odom)],
      ["error", "Off by", `${number(off, 3)} m, ${degrees(odom[2] - truth[2])}\u00b0`],
      ["command", "Command", command ? `${number(command[1], 2)} m/s, ${number(command[2], 2)} rad/s` : "none yet"],
    ];
  }

  const SAID = { truth: "Robot", odom: "", error: "Error of odometry", command: "Command" };

  /* The same as a sentence each. */
  function spoken(run, time) {
    return readings(run, time)
      .filter(([key]) => SAID[key] !== "")
      .map(([key, label, text]) => `${SAID[key] ?? label} ${text}.`)
      .join(" ");
  }

  /* What of runs can be switched, [key, label, colour, line]: the robot's paths, its laser, bodies, layers. */
  function switches(runs) {
    const found = new Map();
    for (const run of runs) {
      if (run.scene) {
        found.set("truth", ["True path", "blue", "solid"]);
        found.set("odom", ["Odometry", "orange", "dashed"]);
        if (run.scans.length) found.set("scan", ["Laser", "vermilion", "dotted"]);
        if (run.layers.some((layer) => layer.kind === "grid")) found.set("world", ["World", "muted", "solid"]);
      }
      for (const { name, colour } of run.bodies) found.set(`body ${name}`, [name, colour, "solid"]);
      for (const { name, colour, dotted } of run.layers) found.set(`layer ${name}`, [name, colour, dotted ? "dotted" : "solid"]);
    }
    return found;
  }

  globalThis.rosminiReplayData = {
    decode, beamPose, unpack, naturals, columns, lastAt,
    bounds, number, poseAt, reach, readings, sampleAt, scanAt, spoken, switches,
  };
})();
