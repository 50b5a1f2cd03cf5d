/* An image in grey and the map that map_server makes of it, with dials. A plain script that sets `globalThis.rosminiMapDials`.

   `cells(greys, settings)` is `rosmini.navigation.map_server.map_io.occupancy_of` for grey pixels; a test compares the two.
   `mount(host, data, options)` shows `data`, what `rosmini.viz.map_dials.MapDials.data` has. */

(() => {
  "use strict";

  const STYLE = `
.rosmini-dials { color: var(--rosmini-ink); font: 13px var(--rosmini-font, sans-serif); }
.md-images { display: flex; flex-wrap: wrap; gap: 12px 20px; }
.md-images > div { flex: 1 1 240px; min-width: 0; }
.md-images span { color: var(--rosmini-muted); display: block; margin-bottom: 4px; }
.md-images canvas { cursor: crosshair; display: block; image-rendering: pixelated; border: 1px solid var(--rosmini-group-line); box-sizing: border-box; width: 100%; }
.md-images canvas:focus-visible { outline: 3px solid var(--rosmini-blue); }
.md-dials { align-items: center; display: flex; flex-wrap: wrap; gap: 6px 20px; margin: 12px 0 6px; }
.md-dials label { align-items: center; display: flex; gap: 6px; }
.md-dials input[type="range"] { accent-color: var(--rosmini-blue); width: 150px; }
.md-value { font-variant-numeric: tabular-nums; min-width: 3.2em; }
.md-dials select { background: var(--rosmini-page); border: 1px solid var(--rosmini-group-line); color: inherit; font: inherit; padding: 2px 4px; }
.md-said { min-height: 1.5em; margin: 0; }
.md-bad { color: var(--rosmini-bad-line); font-weight: 600; }
`;

  const bytes = (text) => Uint8Array.from(atob(text), (character) => character.charCodeAt(0));

  /* What greys mean: 0 free, 100 occupied, -1 unknown, others between; in the mode raw the byte itself. */
  function cell(grey, { mode, negate, free, occupied }) {
    const value = negate ? 255 - grey : grey;
    if (mode === "raw") return value > 127 ? value - 256 : value;
    const p = (255 - value) / 255;
    if (p > occupied) return 100;
    if (p < free) return 0;
    if (mode === "trinary") return -1;
    const span = occupied - free;
    return Math.trunc(1 + 98 * (span ? Math.min(Math.max((p - free) / span, 0), 1) : 0));
  }

  function cells(greys, settings) {
    const table = Int8Array.from({ length: 256 }, (_, grey) => cell(grey, settings));
    return Int8Array.from(greys, (grey) => table[grey]);
  }

  const word = (value) => ({ 0: "free", 100: "occupied", "-1": "unknown" })[value] ?? `${value}`;

  function paint(canvas, [width, height], colour) {
    const picture = new ImageData(width, height);
    for (let i = 0; i < width * height; i++) picture.data.set([...colour(i), 255], 4 * i);
    canvas.getContext("2d").putImageData(picture, 0, 0);
  }

  class Dials {
    constructor(host, data, { title }) {
      this.size = data.size;
      this.greys = bytes(data.greys);
      this.colours = bytes(data.colours);
      this.settings = { mode: data.mode, negate: data.negate, free: data.free, occupied: data.occupied };
      this.at = null; // the pixel that is looked at
      const box = document.createElement("div");
      box.className = "rosmini-dials";
      box.innerHTML = `<style>${STYLE}</style><div class="md-images">
<div><span>image: point at a pixel, or use the arrow keys</span><canvas tabindex="0" role="img"></canvas></div>
<div><span>map</span><canvas role="img"></canvas></div></div>
<div class="md-dials" role="group"></div><p class="md-said" role="status"></p>`;
      host.replaceChildren(box);
      [this.image, this.map] = box.querySelectorAll("canvas");
      this.said = box.querySelector(".md-said");
      this.image.setAttribute("aria-label", `The image ${data.name}: arrow keys choose a pixel`);
      box.querySelector(".md-dials").setAttribute("aria-label", `Numbers of ${title}`);
      for (const canvas of [this.image, this.map]) [canvas.width, canvas.height] = this.size;
      paint(this.image, this.size, (i) => [this.greys[i], this.greys[i], this.greys[i]]);
      this.controls(box.querySelector(".md-dials"), data.modes);
      for (const canvas of [this.image, this.map]) canvas.addEventListener("pointermove", (event) => this.point(canvas, event));
      this.image.addEventListener("keydown", (event) => this.key(event));
      this.draw();
    }

    controls(place, modes) {
      for (const [key, name] of [["free", "free_thresh"], ["occupied", "occupied_thresh"]]) {
        const value = this.settings[key];
        place.insertAdjacentHTML("beforeend",
          `<label>${name} <input type="range" min="0" max="1" step="0.001" value="${value}" data-key="${key}"><span class="md-value">${value}</span></label>`);
      }
      const options = modes.map((mode) => `<option${mode === this.settings.mode ? " selected" : ""}>${mode}</option>`).join("");
      place.insertAdjacentHTML("beforeend", `<label>mode <select data-key="mode">${options}</select></label>
<label><input type="checkbox" data-key="negate"${this.settings.negate ? " checked" : ""}> negate</label>`);
      place.addEventListener("input", ({ target }) => {
        const { key } = target.dataset;
        if (!key) return;
        this.settings[key] = target.type === "range" ? Number(target.value) : target.type === "checkbox" ? target.checked : target.value;
        if (target.type === "range") target.nextElementSibling.textContent = target.value;
        this.draw();
      });
      place.addEventListener("keydown", (event) => event.stopPropagation()); // a notebook has commands on single keys
    }

    draw() {
      this.cells = cells(this.greys, this.settings);
      paint(this.map, this.size, (i) => this.colours.subarray(3 * (this.cells[i] & 255), 3 * (this.cells[i] & 255) + 3));
      this.map.setAttribute("aria-label", `The map: ${this.shares()}`);
      this.say();
    }

    shares() {
      const counts = { free: 0, occupied: 0, unknown: 0 };
      for (const value of this.cells) {
        const name = { 0: "free", 100: "occupied", "-1": "unknown" }[value] ?? "between";
        counts[name] = (counts[name] ?? 0) + 1;
      }
      return Object.entries(counts).map(([name, count]) => `${name} ${((100 * count) / this.cells.length).toFixed(1)} %`).join(", ");
    }

    say() {
      const { free, occupied } = this.settings;
      const bad = free > occupied;
      this.said.classList.toggle("md-bad", bad);
      if (bad) this.said.textContent = "free_thresh is above occupied_thresh: no map, cells would be both";
      else this.said.textContent = this.at === null ? this.shares() : this.pixel();
    }

    pixel() {
      const grey = this.greys[this.at];
      const value = this.settings.negate ? 255 - grey : grey;
      const p = this.settings.mode === "raw" ? "" : `, p = ${((255 - value) / 255).toFixed(3)}`;
      return `pixel ${grey}${p}: ${word(this.cells[this.at])} (${this.cells[this.at]})`;
    }

    point(canvas, event) {
      const frame = canvas.getBoundingClientRect();
      const [width, height] = this.size;
      const clip = (value, most) => Math.min(Math.max(Math.floor(value), 0), most - 1);
      const x = clip(((event.clientX - frame.left) / frame.width) * width, width);
      this.at = clip(((event.clientY - frame.top) / frame.height) * height, height) * width + x;
      this.say();
    }

    key(event) {
      const [width, height] = this.size;
      const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
      if (!step) return;
      event.preventDefault();
      event.stopPropagation();
      const from = this.at ?? Math.floor(height / 2) * width + Math.floor(width / 2);
      const x = Math.min(Math.max((from % width) + step[0], 0), width - 1);
      const y = Math.min(Math.max(Math.floor(from / width) + step[1], 0), height - 1);
      this.at = y * width + x;
      this.say();
    }
  }

  globalThis.rosminiMapDials = { cells, mount: (host, data, options) => { host.dials = new Dials(host, data, options); } };
})();
