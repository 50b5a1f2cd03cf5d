/* A turtle of turtlesim with no page around it, and the paper that turtles draw on. A plain script that sets
   `globalThis.rosminiTurtle`; it needs rosmini-teleop.js before it.

   The motion is that of `rosmini.sim.turtlesim.turtle`, with the numbers that Python hands it; tests compare the two. Metres, radians,
   seconds; y is up in a pose, and down in a window, whose numbers are pixels.

     new Turtle(turtle)     one that is driven: command(linear, angular, sideways), step(seconds), reset(), pose, speed, blocked, and
                            `window`, what `rosmini.sim.turtlesim.frame.Frame.state` has. `turtle` is the data of `rosmini.viz.live.page`.
     run(data)              a run of `rosmini-teleop.js` with it.
     new Paper(canvas, turtle)   draws a window: draw(window); message(window) is the turtlesim/Pose as `rostopic echo` prints it. */

(() => {
  "use strict";

  const { Run, number } = globalThis.rosminiTeleop;
  const PI = 3.14159265; // as turtlesim has it
  const STROKES = 20000; // so many of a run in a page are remembered; the paper has the others
  const single = Math.fround;

  const wrapped = (angle) => angle - 2 * PI * Math.floor((angle + PI) / (2 * PI));

  class Turtle {
    constructor(turtle) {
      this.turtle = turtle;
      this.clears = turtle.state.clears;
      this.reset(true);
    }

    /* The turtle as Python left it; a reset by hand puts it into the middle of a fresh sheet, as the service does. */
    reset(first = false) {
      const { limit, state, name } = this.turtle;
      this.others = first ? state.turtles.filter((each) => each.name !== name) : [];
      this.own = state.turtles.find((each) => each.name === name);
      const [x, y, theta] = first ? this.own.pose : [single(limit / 2), single(limit / 2), 0];
      [this.x, this.y, this.theta] = [x, limit - y, theta];
      this.speed = [0, 0]; // ahead, to the left; and how fast it turns
      this.turning = 0;
      this.now = 0;
      this.since = -Infinity;
      this.waiting = null;
      this.strokes = first ? [...state.strokes] : [];
      this.first = first ? state.first : 0;
      if (!first) this.clears += 1;
      this.blocked = false;
      this.rest = 0;
    }

    get pose() {
      return [this.x, this.turtle.limit - this.y, this.theta];
    }

    command(linear, angular, sideways) {
      this.waiting = [linear, sideways, angular];
    }

    step(seconds) {
      this.now += seconds;
      this.rest += seconds;
      if (this.rest < this.turtle.step - 1e-9) return;
      this.rest = 0;
      this.update(this.now);
    }

    /* One update, which moves it on by 16 ms. */
    update(now) {
      const { step, holds, limit, state: { metre } } = this.turtle;
      if (this.waiting) {
        this.speed = this.waiting.slice(0, 2);
        this.turning = this.waiting[2];
        this.waiting = null;
        this.since = now;
      }
      if (now - this.since > holds + 1e-9) [this.speed, this.turning] = [[0, 0], 0];
      const [forward, sideways] = this.speed;
      const before = [this.x, this.y];
      this.theta = wrapped(this.theta + this.turning * step);
      const [cos, sin] = [Math.cos(this.theta), Math.sin(this.theta)];
      const x = this.x + (cos * forward * step - sin * sideways * step);
      const y = this.y - (cos * sideways * step + sin * forward * step);
      [this.x, this.y] = [x, y].map((value) => Math.min(Math.max(value, 0), limit));
      this.blocked = this.x !== x || this.y !== y;
      if (this.blocked) this.hit = `Oh no! I hit the wall! (Clamping from [x=${x.toFixed(6)}, y=${y.toFixed(6)}])`;
      if (!this.own.pen_on || (this.x === before[0] && this.y === before[1])) return;
      this.strokes.push([metre * this.x, metre * this.y, metre * before[0], metre * before[1], ...this.own.pen]);
      if (this.strokes.length > STROKES) this.first += this.strokes.splice(0, STROKES / 2).length;
    }

    get window() {
      const { metre, size } = this.turtle.state;
      const turtle = {
        ...this.own, x: metre * this.x, y: metre * this.y, theta: this.theta, pose: this.pose,
        velocity: [Math.hypot(...this.speed), this.turning],
      };
      return {
        ...this.turtle.state, size, clears: this.clears, strokes: this.strokes, first: this.first,
        next: this.first + this.strokes.length, turtles: [...this.others, turtle],
      };
    }
  }

  function run(data) {
    return new Run(data, new Turtle(data.turtle));
  }

  class Paper {
    constructor(canvas, turtle) {
      const { size } = turtle.state;
      this.turtle = turtle;
      this.context = canvas.getContext("2d");
      this.sheet = new OffscreenCanvas(2 * size, 2 * size); // fine enough for screens that have two pixels for one
      [canvas.width, canvas.height] = [2 * size, 2 * size];
      this.drawings = turtle.drawings.map((parts) => parts.map(([path, colour]) => [new Path2D(path), colour]));
    }

    draw(window) {
      const { context, sheet } = this;
      this.paint(window);
      context.drawImage(sheet, 0, 0);
      context.save();
      context.scale(2, 2);
      for (const { x, y, theta, kind } of window.turtles) {
        context.save();
        context.translate(x, y);
        context.rotate(-theta);
        for (const [path, colour] of this.drawings[kind % this.drawings.length]) {
          context.fillStyle = colour;
          context.fill(path);
        }
        context.restore();
      }
      context.restore();
    }

    /* Draw the strokes that are new; all of them on a fresh sheet. */
    paint({ size, background, strokes, first, next, clears }) {
      const paper = this.sheet.getContext("2d");
      if (clears !== this.clears || this.next === undefined || next < this.next) {
        paper.setTransform(2, 0, 0, 2, 0, 0);
        paper.fillStyle = `rgb(${background})`;
        paper.fillRect(0, 0, size, size);
        paper.lineCap = "square";
        [this.clears, this.next] = [clears, first];
      }
      for (let i = Math.max(0, this.next - first); i < strokes.length; i += 1) {
        const [x1, y1, x2, y2, r, g, b, width] = strokes[i];
        paper.strokeStyle = `rgb(${r}, ${g}, ${b})`;
        paper.lineWidth = width;
        paper.beginPath();
        paper.moveTo(x1, y1);
        paper.lineTo(x2, y2);
        paper.stroke();
      }
      this.next = next;
    }

    message({ turtles }) {
      const turtle = turtles.find(({ name }) => name === this.turtle.name);
      if (!turtle) return "";
      const values = [...turtle.pose, ...turtle.velocity].map((value) => number(single(value)));
      const fields = ["x", "y", "theta", "linear_velocity", "angular_velocity"];
      return `${fields.map((field, i) => `${field}: ${values[i]}`).join("\n")}\n---`;
    }
  }

  globalThis.rosminiTurtle = { Turtle, Paper, run };
})();
