/* The trajectories of a local planner, one of which is chosen. A plain script that sets `globalThis.rosminiTrajectories`;
   it draws with `rosminiCanvas`.

   `mount(host, data, options)` shows `data`, what `rosmini.viz.trajectory_window.TrajectoryWindow.data` has. */

(() => {
  "use strict";

  const STYLE = `
.rosmini-trajectories { color: var(--rosmini-ink, inherit); font: 13px var(--rosmini-font, sans-serif); }
.rosmini-trajectories canvas { border: 1px solid var(--rosmini-group-line, #9aa5af); box-sizing: border-box; cursor: crosshair; }
.rt-dials { display: flex; flex-wrap: wrap; gap: 6px 20px; margin: 10px 0 6px; }
.rt-dials label { align-items: center; display: flex; gap: 6px; }
.rt-dials input { accent-color: var(--rosmini-blue, #0072b2); width: 220px; }
.rt-value { font-variant-numeric: tabular-nums; min-width: 5em; }
.rt-said { margin: 0 0 6px; min-height: 2.6em; }
.rosmini-trajectories table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
.rosmini-trajectories th, .rosmini-trajectories td { border-bottom: 1px solid var(--rosmini-group-line, #9aa5af); padding: 1px 12px 1px 0; text-align: right; }
.rosmini-trajectories th:first-child { text-align: left; }
.rt-bad { color: var(--rosmini-vermilion, #d55e00); font-weight: 600; }
`;

  const bytes = (text) => Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
  const escape = (text) => text.replace(/[&<>]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;" })[c]);

  class Trajectories {
    constructor(host, data, { title }) {
      this.data = data;
      const raw = bytes(data.points);
      const view = new DataView(raw.buffer);
      let at = 0;
      // of each: a list of [x, y, heading], in metres
      this.tracks = data.lengths.map((length) => Array.from({ length }, () => {
        const pose = [0, 2, 4].map((offset, i) => view.getInt16(at + offset, true) / 1000 + (i < 2 ? data.area[i] : 0));
        at += 6;
        return pose;
      }));
      this.chosen = data.chosen;
      this.build(host, title);
      this.fit();
      this.choose(this.chosen);
      rosminiCanvas.watch(this.canvas, () => { this.fit(); this.draw(); });
    }

    fit() { this.view = rosminiCanvas.fit(this.canvas, this.data.area, { maxHeight: 440, margin: 0 }); }

    build(host, title) {
      this.box = document.createElement("div");
      this.box.className = "rosmini-trajectories";
      const most = this.tracks.length - 1;
      this.box.innerHTML = `<style>${STYLE}</style><canvas role="img"></canvas>
<div class="rt-dials" role="group"><label>trajectory <input type="range" min="0" max="${most}" step="1" data-key="sample"><span class="rt-value"></span></label>
<label>point <input type="range" min="0" step="1" data-key="point"><span class="rt-value"></span></label></div>
<p class="rt-said" role="status"></p><table><thead><tr><th>critic</th><th>gave</th><th>weight</th><th>cost</th></tr></thead><tbody></tbody></table>`;
      host.replaceChildren(this.box);
      this.canvas = this.box.querySelector("canvas");
      this.canvas.setAttribute("aria-label", title);
      this.box.querySelector(".rt-dials").setAttribute("aria-label", `Sliders of ${title}`);
      [this.sample, this.point] = this.box.querySelectorAll("input");
      this.sample.addEventListener("input", () => this.choose(Number(this.sample.value)));
      this.point.addEventListener("input", () => { this.draw(); });
      this.box.addEventListener("keydown", (event) => event.stopPropagation()); // a notebook has commands on single keys
      this.canvas.addEventListener("pointerdown", (event) => this.pick(event));
      this.back = this.costs();
    }

    costs() {
      if (!this.data.size) return null;
      const [width, height] = this.data.size;
      const canvas = Object.assign(document.createElement("canvas"), { width, height });
      const picture = new ImageData(width, height);
      const colours = bytes(this.data.colours);
      bytes(this.data.costs).forEach((cost, i) => picture.data.set(colours.subarray(4 * cost, 4 * cost + 4), 4 * i));
      canvas.getContext("2d").putImageData(picture, 0, 0);
      return canvas;
    }

    choose(number) {
      this.chosen = number;
      this.sample.value = String(number);
      this.point.max = String(this.tracks[number].length - 1);
      this.point.value = this.point.max;
      const words = this.words(number);
      const said = this.box.querySelector(".rt-said");
      said.textContent = words;
      said.classList.toggle("rt-bad", this.data.shades[number] < 0);
      this.sample.nextElementSibling.textContent = `${number + 1} of ${this.tracks.length}`;
      this.sample.setAttribute("aria-valuetext", words);
      this.box.querySelector("tbody").innerHTML = this.data.critics.map((critic, i) => this.row(critic, number, i)).join("");
      this.draw();
    }

    words(number) {
      const [x, y, theta] = this.data.commands[number].map((value) => value.toFixed(3));
      const told = `${x} m/s ahead${Number(y) ? `, ${y} m/s to the left` : ""}, ${theta} rad/s`;
      if (this.data.shades[number] < 0) return `${told}: rejected by ${this.data.reasons[number]}`;
      const cost = this.data.gave[number].reduce((sum, given, i) => sum + given * this.data.weights[i], 0);
      return `${told}: cost ${cost.toFixed(2)}`;
    }

    /* What a critic gave; one of weight 0 is not asked, and one that gives less than 0 rejects. */
    row(critic, number, i) {
      const [given, weight] = [this.data.gave[number][i], this.data.weights[i]];
      if (!weight) return "";
      const bad = given < 0 ? ' class="rt-bad"' : "";
      const cost = given < 0 ? "rejected" : (given * weight).toFixed(2);
      return `<tr><th scope="row">${escape(critic)}</th><td>${given < 0 ? "" : given.toFixed(2)}</td><td>${weight.toFixed(3)}</td><td${bad}>${cost}</td></tr>`;
    }

    line(points, colour, width, { closed = false, opacity = 1, dash = [] } = {}) {
      const { context, x, y } = this.view;
      context.strokeStyle = colour;
      context.lineWidth = width;
      context.globalAlpha = opacity;
      context.setLineDash(dash);
      context.beginPath();
      points.forEach((point, i) => context[i ? "lineTo" : "moveTo"](x(point[0]), y(point[1])));
      if (closed) context.closePath();
      context.stroke();
    }

    draw() {
      const { context, width, height, theme } = this.view;
      context.globalAlpha = 1;
      context.clearRect(0, 0, width, height);
      this.ground();
      for (let i = this.tracks.length - 1; i >= 0; i--) {
        const shade = this.data.shades[i];
        if (shade < 0) this.line(this.tracks[i], theme.vermilion, 0.7, { opacity: 0.5 });
        else this.line(this.tracks[i], theme.blue, 1.2, { opacity: 0.9 - 0.17 * shade });
      }
      this.line(this.data.plan, theme.green, 2, { dash: [5, 3] });
      const track = this.tracks[this.chosen];
      const at = Number(this.point.value);
      this.point.nextElementSibling.textContent = `${at + 1} of ${track.length}`;
      this.line(track, theme.orange, 3);
      this.footprint(track[0], theme.ink);
      this.footprint(track[at], theme.orange);
      context.globalAlpha = 1;
      rosminiCanvas.scaleBar(this.view);
    }

    ground() {
      if (!this.back) return;
      const { context, x, y } = this.view;
      const [x0, y0, x1, y1] = this.data.area;
      context.imageSmoothingEnabled = false;
      context.globalAlpha = 0.6;
      context.drawImage(this.back, x(x0), y(y1), x(x1) - x(x0), y(y0) - y(y1));
    }

    footprint([x, y, theta], colour) {
      const [cos, sin] = [Math.cos(theta), Math.sin(theta)];
      const outline = this.data.outline.map(([px, py]) => [x + px * cos - py * sin, y + px * sin + py * cos]);
      this.line(outline, colour, 1.4, { closed: true });
    }

    /* The trajectory whose end is nearest to where somebody clicks. */
    pick(event) {
      const frame = this.canvas.getBoundingClientRect();
      const [x, y] = this.view.metres(event.clientX - frame.left, event.clientY - frame.top);
      let best = [Infinity, this.chosen];
      this.tracks.forEach((track, number) => {
        const last = track[track.length - 1];
        const away = Math.hypot(last[0] - x, last[1] - y);
        if (away < best[0]) best = [away, number];
      });
      this.choose(best[1]);
    }
  }

  globalThis.rosminiTrajectories = { mount: (host, data, options) => { host.trajectories = new Trajectories(host, data, options); } };
})();
