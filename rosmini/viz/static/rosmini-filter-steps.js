/* A particle filter on a map, with a slider over its steps. A plain script that sets `globalThis.rosminiFilterSteps`;
   `mount(host, data, options)` shows what `rosmini.viz.filter_steps.FilterSteps.data` has. */

(() => {
  "use strict";

  const STYLE = `
.rosmini-filter { color: var(--rosmini-ink); font: 13px var(--rosmini-font, sans-serif); }
.rosmini-filter canvas { border: 1px solid var(--rosmini-group-line); box-sizing: border-box; display: block; width: 100%; }
.rf-said { font-variant-numeric: tabular-nums; margin: 4px 0 0; min-height: 1.5em; }
.rf-steps { align-items: center; display: flex; flex-wrap: wrap; gap: 10px; margin-top: 8px; }
.rf-steps label { align-items: center; display: flex; flex: 1; gap: 8px; min-width: 160px; }
.rf-steps input { accent-color: var(--rosmini-blue); flex: 1; }
.rf-steps button { background: var(--rosmini-page); border: 1px solid var(--rosmini-group-line); color: inherit; font: inherit; padding: 3px 10px; }
`;
  const SHARP = 1440; // pixels of the canvas from left to right
  const LIGHT = [230, 159, 0], HEAVY = [213, 94, 0], TRUTH = "#009e73";
  const PAUSE = 350; // ms between two steps
  const bytes = (text) => Uint8Array.from(atob(text), (character) => character.charCodeAt(0));

  class Steps {
    constructor(host, data, { title }) {
      this.data = data;
      this.places = new Int16Array(bytes(data.places).buffer);
      this.headings = bytes(data.headings);
      this.weights = bytes(data.weights);
      this.begins = [0];
      for (const each of data.steps) this.begins.push(this.begins.at(-1) + each.shown);
      const box = document.createElement("div");
      box.className = "rosmini-filter";
      box.innerHTML = `<style>${STYLE}</style><canvas role="img"></canvas><p class="rf-said" role="status"></p>
<div class="rf-steps" role="group"><button type="button">Play</button><button type="button">Next step</button>
<label>step <input type="range" min="0" max="${data.steps.length - 1}" step="1" value="0"></label></div>`;
      host.replaceChildren(box);
      this.canvas = box.querySelector("canvas");
      this.scale = SHARP / data.size[0];
      [this.canvas.width, this.canvas.height] = [SHARP, Math.round(SHARP * data.size[1] / data.size[0])];
      this.said = box.querySelector("p");
      box.querySelector(".rf-steps").setAttribute("aria-label", `Steps of ${title}`);
      this.slider = box.querySelector("input");
      const [play, next] = box.querySelectorAll("button");
      this.button = play;
      this.slider.addEventListener("input", () => this.draw());
      this.slider.addEventListener("keydown", (event) => event.stopPropagation()); // a notebook has commands on single keys
      play.addEventListener("click", () => this.play());
      next.addEventListener("click", () => this.go(Number(this.slider.value) + 1));
      this.ground = new Image();
      this.ground.addEventListener("load", () => this.draw());
      this.ground.src = data.ground;
      this.draw();
    }

    go(step) {
      this.slider.value = step;
      this.draw();
    }

    play() {
      if (this.timer) return this.stop();
      if (Number(this.slider.value) >= this.data.steps.length - 1) this.go(0);
      this.button.textContent = "Pause";
      this.timer = setInterval(() => {
        this.go(Number(this.slider.value) + 1);
        if (!this.slider.isConnected || Number(this.slider.value) >= this.data.steps.length - 1) this.stop();
      }, PAUSE);
    }

    stop() {
      clearInterval(this.timer);
      this.timer = null;
      this.button.textContent = "Play";
    }

    draw() {
      const index = Number(this.slider.value), step = this.data.steps[index];
      const pen = this.canvas.getContext("2d");
      pen.imageSmoothingEnabled = false;
      if (this.ground.complete) pen.drawImage(this.ground, 0, 0, this.canvas.width, this.canvas.height);
      pen.lineCap = "round";
      for (let i = this.begins[index]; i < this.begins[index + 1]; i++) this.particle(pen, i);
      if (step.truth) this.robot(pen, step.truth);
      this.said.textContent = `${index + 1}. ${step.said}`;
      this.slider.setAttribute("aria-valuetext", this.said.textContent);
      this.canvas.setAttribute("aria-label", `Map with particles after the step ${step.said}`);
    }

    /* Heavy ones are redder, thicker and longer. */
    particle(pen, i) {
      const weight = this.weights[i] / 255, heading = (this.headings[i] / 256) * 2 * Math.PI;
      const x = (this.places[2 * i] / 100) * this.scale;
      const y = this.canvas.height - (this.places[2 * i + 1] / 100) * this.scale;
      const long = this.data.tick * this.scale * (0.5 + 0.5 * weight);
      pen.strokeStyle = `rgb(${LIGHT.map((light, k) => Math.round(light + (HEAVY[k] - light) * weight)).join(" ")} / ${0.35 + 0.65 * weight})`;
      pen.lineWidth = 1.5 + 2.5 * weight;
      pen.beginPath();
      pen.moveTo(x, y);
      pen.lineTo(x + long * Math.cos(heading), y - long * Math.sin(heading));
      pen.stroke();
    }

    robot(pen, [east, north, heading]) {
      const x = east * this.scale, y = this.canvas.height - north * this.scale, radius = 0.16 * this.scale;
      pen.strokeStyle = TRUTH;
      pen.lineWidth = 4;
      pen.beginPath();
      pen.arc(x, y, radius, 0, 2 * Math.PI);
      pen.moveTo(x, y);
      pen.lineTo(x + 1.6 * radius * Math.cos(heading), y - 1.6 * radius * Math.sin(heading));
      pen.stroke();
    }
  }

  globalThis.rosminiFilterSteps = { mount: (host, data, options) => { host.steps = new Steps(host, data, options); } };
})();
