/* A robot with two driven wheels and a laser, driven by keys, with no page around it: what `rosmini-pad.js` shows where
   there is no kernel. A plain script that sets `globalThis.rosminiTeleop`.

   It does what `rosmini.viz.live.teleop`, `rosmini.sim` and `rosmini.core.geometry` do in Python, with the numbers that Python
   hands it; tests compare the two. Metres, radians, seconds; a pose is [x, y, theta].

     new Teleop(table)      keys to velocities: press(key), steer(linear, angular), cycle() -> [linear, angular].
     new Robot(scene, pose) wheels, motion and walls: command(linear, angular), step(seconds), pose, speed, blocked.
     laser(scene, pose)     the ranges of one revolution, Infinity where nothing is hit,
                            -Infinity where it is too close.
     new Run(data)          all of it on one clock: press(key), steer(linear, angular), use(table), advance(seconds), reset(),
                            messages, ranges, time.
     yaml(twist)            a geometry_msgs/Twist as `rostopic echo` prints it. */

(() => {
  "use strict";

  const TURN = 2 * Math.PI;
  const LOOK = 0.3; // metres
  const clamp = (value, limit) => Math.max(-limit, Math.min(limit, value));

  class Teleop {
    constructor(table) {
      this.table = table;
      this.speed = [this.limited(table.linear.step, 0), this.limited(table.angular.step, 1)];
      this.stop();
    }

    stop() {
      this.target = [0, 0];
      this.command = [0, 0];
      this.aside = [0, 0]; // to the left, up
      this.direction = [0, 0, 0, 0];
      this.steered = false; // by a gamepad, not by keys
    }

    get atRest() {
      return [...this.target, ...this.command, ...this.aside].every((value) => value === 0);
    }

    get repeats() {
      return this.table.holds === null || this.steered;
    }

    press(key) {
      const { stops, factors, moves, adds, linear, angular } = this.table;
      if (stops.includes(key)) this.stop();
      else if (key in factors) {
        this.speed = this.speed.map((speed, i) => this.limited(speed * factors[key][i], i));
        if (!this.steered) this.aim();
      } else if (adds) {
        const [ahead, , , left] = moves[key];
        this.target = [
          this.limited(this.target[0] + ahead * linear.step, 0), this.limited(this.target[1] + left * angular.step, 1),
        ];
        this.steered = false;
      } else {
        this.direction = moves[key];
        this.steered = false;
        this.aim();
      }
      return this.cycle();
    }

    aim() {
      const [ahead, left, up, turn] = this.direction;
      const [linear, angular] = this.speed;
      this.target = [this.round(ahead * linear), this.round(turn * angular)];
      this.aside = [this.round(left * linear), this.round(up * linear)];
    }

    steer(linear, angular) {
      this.steered = true;
      this.aside = [0, 0];
      this.direction = [0, 0, 0, 0];
      this.target = [this.limited(linear, 0), this.limited(angular, 1)];
      return this.cycle();
    }

    cycle() {
      const { linear, angular } = this.table;
      this.command = [
        this.approach(this.command[0], this.target[0], linear.slope ?? Infinity),
        this.approach(this.command[1], this.target[1], angular.slope ?? Infinity),
      ];
      return this.command;
    }

    approach(value, target, slope) {
      return this.round(target > value ? Math.min(target, value + slope) : Math.max(target, value - slope));
    }

    limited(value, which) {
      return this.round(clamp(value, this.table[which ? "angular" : "linear"].max));
    }

    round(value) {
      return Math.floor(value * this.table.grain + 0.5) / this.table.grain;
    }
  }

  const placed = ([x, y, theta], [px, py]) => [
    x + Math.cos(theta) * px - Math.sin(theta) * py,
    y + Math.sin(theta) * px + Math.cos(theta) * py,
  ];

  /* Everything that stops a robot: sides [x1, y1, x2, y2], and discs [x, y, r]; `seen` is what stops a laser. */
  function solids(scene, seen) {
    const sides = seen && scene.low_walls ? [] : [...scene.segments];
    const discs = [];
    for (const shape of scene.shapes) {
      if ((seen && shape.low) || shape.over) continue;
      if (shape.kind === "disc") discs.push([shape.x, shape.y, shape.r]);
      else shape.points.forEach((point, i) => sides.push([...point, ...shape.points[(i + 1) % shape.points.length]]));
    }
    return { sides, discs };
  }

  const solidsOf = new WeakMap();
  function solid(scene, seen = false) {
    if (!solidsOf.has(scene)) solidsOf.set(scene, [solids(scene, false), solids(scene, true)]);
    return solidsOf.get(scene)[Number(seen)];
  }

  /* How far it is from (x, y) to the nearest point of a side. */
  function distanceToSide(x, y, [x1, y1, x2, y2]) {
    const [dx, dy] = [x2 - x1, y2 - y1];
    const length = dx * dx + dy * dy;
    const t = length === 0 ? 0 : Math.max(0, Math.min(1, ((x - x1) * dx + (y - y1) * dy) / length));
    return Math.hypot(x - x1 - t * dx, y - y1 - t * dy);
  }

  const side = (ax, ay, bx, by, px, py) => (bx - ax) * (py - ay) - (by - ay) * (px - ax);

  function cross([ax, ay, bx, by], [cx, cy, dx, dy]) {
    return (
      side(ax, ay, bx, by, cx, cy) * side(ax, ay, bx, by, dx, dy) <= 0 &&
      side(cx, cy, dx, dy, ax, ay) * side(cx, cy, dx, dy, bx, by) <= 0 &&
      Math.max(ax, bx) >= Math.min(cx, dx) && Math.max(cx, dx) >= Math.min(ax, bx) &&
      Math.max(ay, by) >= Math.min(cy, dy) && Math.max(cy, dy) >= Math.min(ay, by)
    );
  }

  /* Whether a robot's footprint at `pose` touches something. Walls are lines: what is inside of one has crossed its outline. */
  function touches(scene, pose, size = 1, { sides, discs } = solid(scene)) {
    const footprint = scene.robot.footprint.map(([x, y]) => [size * x, size * y]);
    const corners = footprint.map((corner) => placed(pose, corner));
    const outline = corners.map((corner, i) => [...corner, ...corners[(i + 1) % corners.length]]);
    const reach = Math.max(...footprint.map(([x, y]) => Math.hypot(x, y)));
    const [x, y] = pose;
    const inside = (px, py) => outline.every(([ax, ay, bx, by]) => side(ax, ay, bx, by, px, py) >= 0);
    return (
      sides.some(
        (wall) =>
          distanceToSide(x, y, wall) <= reach && (inside(wall[0], wall[1]) || outline.some((edge) => cross(edge, wall))),
      ) ||
      discs.some(
        ([cx, cy, r]) =>
          Math.hypot(cx - x, cy - y) <= reach + r &&
          (inside(cx, cy) || outline.some((edge) => distanceToSide(cx, cy, edge) <= r)),
      )
    );
  }

  class Robot {
    constructor(scene, pose) {
      this.scene = scene;
      this.start = [...pose];
      this.reset();
    }

    reset() {
      this.pose = [...this.start];
      this.speed = [0, 0]; // linear, angular
      this.wanted = [0, 0]; // the same for the command
      this.blocked = false;
      // A robot that already leans against something gets out again.
      this.size = 1;
      while (this.size > 0.8 && touches(this.scene, this.pose, this.size)) this.size -= 0.02;
      this.look();
    }

    /* Gather what it can run into until it is LOOK metres from here. */
    look() {
      const corner = Math.max(...this.scene.robot.footprint.map(([x, y]) => Math.hypot(x, y)));
      this.from = this.pose;
      this.around = near(this.scene, this.pose, corner + 2 * LOOK, false);
    }

    touches(pose) {
      return touches(this.scene, pose, this.size, this.around);
    }

    command(linear, angular) {
      const { max_linear: v, max_angular: w } = this.scene.robot;
      this.wanted = [clamp(linear, v), clamp(angular, w)];
    }

    /* The rims of the wheels go over to their commanded speeds, and the robot along an arc; what is in its way stops it. */
    step(dt) {
      const { wheel_separation: width, acceleration } = this.scene.robot;
      const rims = ([v, w]) => [v - (w * width) / 2, v + (w * width) / 2];
      const now = rims(this.speed);
      const [left, right] = rims(this.wanted).map((goal, i) => ramp(now[i], goal, acceleration, dt));
      const [v, w] = [(left.way + right.way) / 2, (right.way - left.way) / width];
      const next = arc(this.pose, v, w);
      if (Math.hypot(next[0] - this.from[0], next[1] - this.from[1]) > LOOK) this.look();
      this.blocked = (v !== 0 || w !== 0) && this.touches(next);
      if (this.blocked) {
        this.pose = this.reach(v, w);
        this.speed = [0, 0];
      } else {
        this.pose = next;
        this.speed = [(left.speed + right.speed) / 2, (right.speed - left.speed) / width];
      }
    }

    /* So far it comes on a way that ends in something. */
    reach(v, w) {
      let [free, best] = [0, this.pose];
      for (let part = 0.5; part > 1e-3; part /= 2) {
        const pose = arc(this.pose, (free + part) * v, (free + part) * w);
        if (!this.touches(pose)) [free, best] = [free + part, pose];
      }
      return best;
    }
  }

  /* The way in `dt` seconds of what goes from one speed to another as fast as it can, and its speed then. */
  function ramp(speed, goal, acceleration, dt) {
    const needed = Math.abs(goal - speed) / acceleration;
    if (needed <= dt) return { way: ((speed + goal) / 2) * needed + goal * (dt - needed), speed: goal };
    const end = speed + Math.sign(goal - speed) * acceleration * dt;
    return { way: ((speed + end) / 2) * dt, speed: end };
  }

  /* `way` metres ahead along a circle, with a turn of `turn` in all: its chord points to the middle of the two headings. */
  function arc([x, y, theta], way, turn) {
    const half = turn / 2;
    const chord = half === 0 ? way : (way * Math.sin(half)) / half;
    return [x + chord * Math.cos(theta + half), y + chord * Math.sin(theta + half), theta + turn];
  }

  /* What is within `reach` of a point; `seen` by a laser, or all. */
  function near(scene, [x, y], reach, seen) {
    const { sides, discs } = solid(scene, seen);
    return {
      sides: sides.filter((wall) => distanceToSide(x, y, wall) <= reach),
      discs: discs.filter(([cx, cy, r]) => Math.hypot(cx - x, cy - y) <= reach + r),
    };
  }

  /* A beam to each of `beams` directions, counter-clockwise, the first one ahead if nothing else is said. REP 117: -Infinity is too close. */
  function laser(scene, pose) {
    const { x: ahead, y: aside = 0, beams, min, max, start = 0, step = TURN / beams } = scene.robot.lidar;
    const [ox, oy] = placed(pose, [ahead, aside]);
    const { sides, discs } = near(scene, [ox, oy], max, true);
    const ranges = new Float64Array(beams);
    for (let i = 0; i < beams; i += 1) {
      const angle = pose[2] + start + step * i;
      const range = beam(sides, discs, ox, oy, Math.cos(angle), Math.sin(angle));
      ranges[i] = range > max ? Infinity : range < min ? -Infinity : range;
    }
    return ranges;
  }

  function beam(sides, discs, ox, oy, dx, dy) {
    let best = Infinity;
    for (const [x1, y1, x2, y2] of sides) {
      const [ex, ey] = [x2 - x1, y2 - y1];
      const determinant = dx * ey - dy * ex;
      if (determinant === 0) continue; // along the wall
      const [rx, ry] = [x1 - ox, y1 - oy];
      const along = (rx * dy - ry * dx) / determinant;
      const t = (rx * ey - ry * ex) / determinant;
      if (along >= 0 && along <= 1 && t >= 0 && t < best) best = t;
    }
    for (const [cx, cy, r] of discs) {
      const [rx, ry] = [cx - ox, cy - oy];
      const middle = rx * dx + ry * dy;
      const miss = rx * dy - ry * dx;
      if (Math.abs(miss) > r) continue;
      const half = Math.sqrt(r * r - miss * miss);
      const t = middle - half >= 0 ? middle - half : middle + half >= 0 ? 0 : Infinity;
      if (t < best) best = t;
    }
    return best;
  }

  /* A run on a clock of its own, which goes in whole steps: the same keys at the same times give the same run. */
  class Run {
    constructor(data, robot = null) {
      this.data = data;
      this.robot = robot ?? (data.scene ? new Robot(data.scene, data.pose) : null);
      this.messages = []; // the last few: {linear, angular, time}
      this.sent = 0;
      this.map = data.maps.find(({ name }) => name === data.keys);
      this.reset();
    }

    use(map) {
      this.map = map;
      this.teleop = new Teleop(map);
      this.nextCycle = Infinity;
    }

    reset() {
      this.teleop = new Teleop(this.map);
      this.robot?.reset();
      this.steps = 0;
      this.rest = 0;
      this.nextCycle = Infinity; // in steps, as the next scan: sums of fractions would drift
      this.nextScan = 0;
      this.messages.length = 0;
      this.sent = 0;
      this.scan();
    }

    get time() {
      return this.steps * this.data.step;
    }

    get atRest() {
      return this.teleop.atRest && !this.robot?.speed.some((value) => value !== 0);
    }

    press(key) {
      this.send(this.teleop.press(key));
    }

    steer(linear, angular) {
      this.send(this.teleop.steer(linear, angular));
    }

    send([linear, angular]) {
      this.robot?.command(linear, angular, this.teleop.aside[0]);
      this.messages.push({ linear, angular, aside: this.teleop.aside, time: this.time });
      if (this.messages.length > 8) this.messages.shift();
      this.sent += 1;
      const { teleop, map } = this;
      this.nextCycle = teleop.atRest ? Infinity : this.steps + Math.round((teleop.repeats ? map.period : map.holds) / this.data.step);
    }

    scan() {
      if (!this.data.scene) { this.nextScan = Infinity; return; }
      this.scanPose = this.robot.pose;
      this.ranges = laser(this.data.scene, this.robot.pose);
      this.nextScan = this.steps + Math.round(1 / this.data.scan_rate / this.data.step);
    }

    cycle() {
      if (this.teleop.repeats) { this.send(this.teleop.cycle()); return; }
      this.teleop.stop(); // what is driven has forgotten the message by now
      this.nextCycle = Infinity;
    }

    advance(seconds) {
      for (this.rest += seconds; this.rest >= this.data.step - 1e-9; this.rest -= this.data.step) {
        this.robot?.step(this.data.step);
        this.steps += 1;
        if (this.steps >= this.nextCycle) this.cycle();
        if (this.steps >= this.nextScan) this.scan();
      }
    }
  }

  /* A number as Python prints it. */
  function number(value) {
    if (Number.isInteger(value) && Math.abs(value) < 1e16) return Object.is(value, -0) ? "-0.0" : value.toFixed(1);
    if (Math.abs(value) >= 1e-4) return String(value);
    return value.toExponential().replace(/e-(\d)$/, "e-0$1");
  }

  function yaml({ linear, angular, aside: [y, z] = [0, 0] }) {
    const vector = (name, ...parts) => `${name}: \n${["x", "y", "z"].map((axis, i) => `  ${axis}: ${number(parts[i])}`).join("\n")}`;
    return `${vector("linear", linear, y, z)}\n${vector("angular", 0, 0, angular)}\n---`;
  }

  globalThis.rosminiTeleop = { Teleop, Robot, Run, laser, touches, yaml, number };
})();
