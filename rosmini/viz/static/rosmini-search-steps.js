/* Searches on grids, side by side, with a slider over the cells that they take up. A plain script that sets
   `globalThis.rosminiSearchSteps`; `mount(host, data, options)` shows what `rosmini.viz.search_steps.SearchSteps.data` has. */

(() => {
  "use strict";

  const STYLE = `
.rosmini-search { color: var(--rosmini-ink); font: 13px var(--rosmini-font, sans-serif); }
.rs-grids { display: flex; flex-wrap: wrap; gap: 12px 20px; }
.rs-grids > div { flex: 1 1 220px; min-width: 0; }
.rs-grids span { color: var(--rosmini-muted); display: block; margin-bottom: 4px; }
.rs-grids canvas { border: 1px solid var(--rosmini-group-line); box-sizing: border-box; display: block; width: 100%; }
.rs-said { font-variant-numeric: tabular-nums; margin: 4px 0 0; min-height: 1.5em; }
.rs-steps { align-items: center; display: flex; gap: 10px; margin-top: 8px; }
.rs-steps label { align-items: center; display: flex; flex: 1; gap: 8px; }
.rs-steps input { accent-color: var(--rosmini-blue); flex: 1; }
.rs-steps button { background: var(--rosmini-page); border: 1px solid var(--rosmini-group-line); color: inherit; font: inherit; padding: 3px 10px; }
`;
  const SHARP = 4; // pixels of a canvas for a cell
  const PATH = "#d55e00", START = "#009e73";
  const bytes = (text) => Uint8Array.from(atob(text), (character) => character.charCodeAt(0));

  /* Cells that were reached by a frame and have a neighbour that will be later: they wait. */
  function frontier(when, width, frame) {
    const waiting = [];
    const later = (i) => when[i] > frame;
    for (let i = 0; i < when.length; i++) {
      if (!when[i] || when[i] > frame) continue;
      const x = i % width;
      if ((x > 0 && later(i - 1)) || (x < width - 1 && later(i + 1)) || later(i - width) || later(i + width)) waiting.push(i);
    }
    return waiting;
  }

  class Steps {
    constructor(host, data, { title }) {
      this.data = data;
      this.shades = bytes(data.shades);
      this.searches = data.searches.map((each) => ({ ...each, ground: bytes(each.ground), when: bytes(each.when) }));
      const box = document.createElement("div");
      box.className = "rosmini-search";
      box.innerHTML = `<style>${STYLE}</style><div class="rs-grids"></div><div class="rs-steps" role="group">
<button type="button">Play</button><label>step <input type="range" min="0" max="${data.frames}" step="1" value="0"></label></div>`;
      host.replaceChildren(box);
      const grids = box.querySelector(".rs-grids");
      for (const each of this.searches) {
        const part = document.createElement("div");
        part.innerHTML = `<span></span><canvas role="img"></canvas><p class="rs-said" role="status"></p>`;
        part.querySelector("span").textContent = each.name;
        each.canvas = part.querySelector("canvas");
        each.said = part.querySelector("p");
        [each.canvas.width, each.canvas.height] = data.size.map((side) => side * SHARP);
        grids.append(part);
      }
      box.querySelector(".rs-steps").setAttribute("aria-label", `Steps of ${title}`);
      this.slider = box.querySelector("input");
      this.button = box.querySelector("button");
      this.slider.addEventListener("input", () => this.draw());
      this.slider.addEventListener("keydown", (event) => event.stopPropagation()); // a notebook has commands on single keys
      this.button.addEventListener("click", () => this.play());
      this.draw();
    }

    play() {
      if (this.timer) return this.stop();
      if (Number(this.slider.value) >= this.data.frames) this.slider.value = 0;
      this.button.textContent = "Pause";
      this.timer = setInterval(() => {
        this.slider.value = Number(this.slider.value) + 1;
        this.draw();
        if (!this.slider.isConnected || Number(this.slider.value) >= this.data.frames) this.stop();
      }, 50);
    }

    stop() {
      clearInterval(this.timer);
      this.timer = null;
      this.button.textContent = "Play";
    }

    draw() {
      const frame = Number(this.slider.value);
      for (const each of this.searches) this.one(each, frame);
      this.slider.setAttribute("aria-valuetext", `after ${frame * this.data.step} cells`);
    }

    one(each, frame) {
      const [width, height] = this.data.size;
      const image = new ImageData(width, height);
      const set = (i, r, g, b) => image.data.set([r, g, b, 255], 4 * i);
      let reached = 0;
      for (let i = 0; i < width * height; i++) {
        const when = each.when[i];
        if (when && when <= frame + 1) {
          reached += 1;
          const shade = Math.min(Math.floor(((when - 1) * (this.shades.length / 3 - 1)) / Math.max(this.data.frames, 1)), this.shades.length / 3 - 1);
          set(i, ...this.shades.subarray(3 * shade, 3 * shade + 3));
        } else set(i, each.ground[i], each.ground[i], each.ground[i]);
      }
      const done = frame * this.data.step >= each.taken;
      if (!done) for (const i of frontier(each.when, width, frame + 1)) set(i, ...this.data.waiting);
      const small = document.createElement("canvas");
      [small.width, small.height] = [width, height];
      small.getContext("2d").putImageData(image, 0, 0);
      const pen = each.canvas.getContext("2d");
      pen.imageSmoothingEnabled = false;
      pen.drawImage(small, 0, 0, width * SHARP, height * SHARP);
      if (done) this.path(pen, each.path, height);
      this.dot(pen, each.start, START, height);
      this.dot(pen, each.goal, PATH, height);
      const taken = Math.min(frame * this.data.step, each.taken);
      const end = !done ? "" : each.path.length ? ", arrived" : ", no path";
      each.said.textContent = `${taken} cells taken up, ${reached} reached${end}`;
      each.canvas.setAttribute("aria-label", `${each.name}: ${each.said.textContent}`);
    }

    path(pen, points, height) {
      pen.strokeStyle = PATH;
      pen.lineWidth = SHARP * 0.6;
      pen.beginPath();
      for (let i = 0; i < points.length; i += 2) pen.lineTo((points[i] + 0.5) * SHARP, (height - points[i + 1] - 0.5) * SHARP);
      pen.stroke();
    }

    dot(pen, [x, y], colour, height) {
      pen.fillStyle = colour;
      pen.beginPath();
      pen.arc((x + 0.5) * SHARP, (height - y - 0.5) * SHARP, SHARP * 0.9, 0, 2 * Math.PI);
      pen.fill();
    }
  }

  globalThis.rosminiSearchSteps = { frontier, mount: (host, data, options) => { host.steps = new Steps(host, data, options); } };
})();
