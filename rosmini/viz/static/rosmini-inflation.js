/* A costmap whose inflation can be turned. A plain script that sets `globalThis.rosminiInflation`.

   `inflated(costs, size, settings)` is `rosmini.navigation.costmap_2d.inflation.inflate`; a test compares the two.
   `mount(host, data, options)` shows `data`, what `rosmini.viz.inflation_dials.InflationDials.data` has. */

(() => {
  "use strict";

  const LETHAL = 254, INSCRIBED = 253, UNKNOWN = 255;
  const STYLE = `
.rosmini-inflation { color: var(--rosmini-ink); font: 13px var(--rosmini-font, sans-serif); }
.ri-map { background: #fff; border: 1px solid var(--rosmini-group-line); box-sizing: border-box; cursor: crosshair; display: block; image-rendering: pixelated; max-height: 480px; max-width: 100%; width: 100%; object-fit: contain; }
.ri-map:focus-visible { outline: 3px solid var(--rosmini-blue); }
.ri-dials { align-items: center; display: flex; flex-wrap: wrap; gap: 6px 20px; margin: 12px 0 6px; }
.ri-dials label { align-items: center; display: flex; gap: 6px; }
.ri-dials input { accent-color: var(--rosmini-blue); width: 140px; }
.ri-value { font-variant-numeric: tabular-nums; min-width: 3.6em; }
.ri-said { margin: 0 0 6px; min-height: 3em; }
.ri-bad { color: var(--rosmini-vermilion); font-weight: 600; }
.ri-curve { display: block; height: auto; max-width: 100%; }
.ri-curve text { fill: var(--rosmini-muted); font: 11px var(--rosmini-font, sans-serif); }
.ri-curve .line { fill: none; stroke: var(--rosmini-blue); stroke-width: 2; }
.ri-curve .axis { stroke: var(--rosmini-group-line); }
.ri-curve .at { fill: var(--rosmini-vermilion); }
`;

  const bytes = (text) => Uint8Array.from(atob(text), (character) => character.charCodeAt(0));

  function unrolled(runs, count) {
    const costs = new Uint8Array(count);
    for (let i = 0, at = 0; i < runs.length; i += 2) {
      costs.fill(runs[i], at, at + runs[i + 1]);
      at += runs[i + 1];
    }
    return costs;
  }

  const cellDistance = (radius, resolution) => Math.max(0, Math.ceil(radius / resolution));

  function costAt(distance, { inscribed, scaling }) {
    if (distance === 0) return LETHAL;
    if (distance <= inscribed) return INSCRIBED;
    return Math.trunc((INSCRIBED - 1) * Math.exp(-scaling * (distance - inscribed)));
  }

  /* The squared distance in cells to the nearest obstacle, up to `reach`; beyond it is Infinity. */
  function squaredDistances(costs, [width, height], reach) {
    const along = new Float64Array(costs.length).fill(Infinity);
    for (let y = 0; y < height; y++) {
      for (const [from, to, step] of [[0, width, 1], [width - 1, -1, -1]]) {
        for (let x = from, far = Infinity; x !== to; x += step) {
          const i = y * width + x;
          far = costs[i] === LETHAL ? 0 : far + 1;
          along[i] = Math.min(along[i], far);
        }
      }
    }
    const squared = along.map((far) => (far > reach ? Infinity : far * far));
    const result = squared.slice();
    for (let rows = 1; rows <= reach; rows++) {
      for (let i = 0, j = rows * width; j < costs.length; i++, j++) {
        if (squared[i] + rows * rows < result[j]) result[j] = squared[i] + rows * rows;
        if (squared[j] + rows * rows < result[i]) result[i] = squared[j] + rows * rows;
      }
    }
    return result.map((value) => (value > reach * reach ? Infinity : value));
  }

  function inflated(costs, size, { resolution, radius, inscribed, scaling }) {
    const reach = cellDistance(radius, resolution);
    const squared = squaredDistances(costs, size, reach);
    const table = new Map([[Infinity, 0]]);
    const cost = (value) => {
      if (!table.has(value)) table.set(value, costAt(Math.sqrt(value) * resolution, { inscribed, scaling }));
      return table.get(value);
    };
    const result = costs.slice();
    if (!reach) return { costs: result, squared };
    for (let i = 0; i < costs.length; i++) {
      const added = cost(squared[i]);
      if (costs[i] === UNKNOWN ? added >= INSCRIBED : added > costs[i]) result[i] = added;
    }
    return { costs: result, squared };
  }

  const MEANING = { 0: "free", 253: "in collision whatever the heading", 254: "an obstacle", 255: "unknown" };

  class Dials {
    constructor(host, data, { title }) {
      this.size = data.size;
      this.base = unrolled(bytes(data.runs), data.size[0] * data.size[1]);
      this.colours = bytes(data.colours);
      this.origin = data.origin;
      this.settings = { resolution: data.resolution, radius: data.radius, inscribed: data.inscribed, scaling: data.scaling };
      this.at = null; // the cell that is looked at
      const box = document.createElement("div");
      box.className = "rosmini-inflation";
      box.innerHTML = `<style>${STYLE}</style><canvas class="ri-map" tabindex="0" role="img"></canvas>
<div class="ri-dials" role="group"></div><p class="ri-said" role="status"></p>
<svg class="ri-curve" viewBox="0 0 640 150" width="640" role="img"></svg>`;
      host.replaceChildren(box);
      this.map = box.querySelector("canvas");
      this.said = box.querySelector(".ri-said");
      this.curve = box.querySelector("svg");
      [this.map.width, this.map.height] = this.size;
      box.querySelector(".ri-dials").setAttribute("aria-label", `Numbers of ${title}`);
      this.controls(box.querySelector(".ri-dials"));
      this.map.addEventListener("pointermove", (event) => this.point(event));
      this.map.addEventListener("keydown", (event) => this.key(event));
      globalThis.rosminiCanvas.watch(this.map, () => this.paint(box));
      this.paint(box);
      this.draw();
    }

    /* The palette of the page holds in it, whether that page has our style sheet or not. */
    paint(box) {
      for (const [name, value] of Object.entries(globalThis.rosminiCanvas.theme(box.parentElement))) {
        box.style.setProperty(`--rosmini-${name}`, value);
      }
    }

    controls(place) {
      const dials = [
        ["radius", "inflation_radius", 0, 1.5, 0.05, "m"],
        ["scaling", "cost_scaling_factor", 0.5, 20, 0.5, ""],
        ["inscribed", "inscribed radius", 0, 0.5, 0.005, "m"],
      ];
      for (const [key, name, low, high, step, unit] of dials) {
        const value = this.settings[key];
        place.insertAdjacentHTML("beforeend",
          `<label>${name} <input type="range" min="${Math.min(low, value)}" max="${Math.max(high, value)}" step="${step}" value="${value}" data-key="${key}" data-unit="${unit}"><span class="ri-value">${value} ${unit}</span></label>`);
      }
      place.addEventListener("input", ({ target }) => {
        this.settings[target.dataset.key] = Number(target.value);
        target.nextElementSibling.textContent = `${target.value} ${target.dataset.unit}`;
        this.draw();
      });
      place.addEventListener("keydown", (event) => event.stopPropagation()); // a notebook has commands on single keys
    }

    draw() {
      Object.assign(this, inflated(this.base, this.size, this.settings));
      const [width, height] = this.size;
      const picture = new ImageData(width, height);
      for (let i = 0; i < this.costs.length; i++) {
        picture.data.set(this.colours.subarray(4 * this.costs[i], 4 * this.costs[i] + 4), 4 * i);
      }
      this.map.getContext("2d").putImageData(picture, 0, 0);
      this.map.setAttribute("aria-label", `The costs: ${this.shares()}. Arrow keys choose a cell.`);
      this.say();
    }

    shares() {
      const counts = { free: 0, "near something": 0, inscribed: 0, obstacle: 0, unknown: 0 };
      for (const cost of this.costs) {
        counts[cost === 0 ? "free" : cost < INSCRIBED ? "near something" : cost === INSCRIBED ? "inscribed" : cost === LETHAL ? "obstacle" : "unknown"]++;
      }
      const said = (count) => (count < 0.005 * this.costs.length ? "under 1" : Math.round((100 * count) / this.costs.length));
      return Object.entries(counts).filter(([, count]) => count).map(([name, count]) => `${name} ${said(count)} %`).join(", ");
    }

    say() {
      const { radius, inscribed } = this.settings;
      const bad = radius < inscribed;
      this.said.classList.toggle("ri-bad", bad);
      this.said.textContent = bad
        ? "The inflation radius is under the inscribed radius: plans go where the robot does not fit."
        : this.at === null ? this.shares() : this.cell();
      this.plot();
    }

    cell() {
      const [width, height] = this.size;
      const { resolution, inscribed, scaling } = this.settings;
      const cost = this.costs[this.at];
      const column = this.at % width, row = height - 1 - Math.floor(this.at / width);
      const where = `cell (${column}, ${row})`;
      const away = Math.sqrt(this.squared[this.at]) * resolution;
      const meaning = MEANING[cost] ?? "some headings may collide";
      if (!Number.isFinite(away)) return `${where}: cost ${cost}, ${meaning}; no obstacle within the inflation radius`;
      if (away <= inscribed || cost === UNKNOWN) return `${where}: ${away.toFixed(2)} m from an obstacle, cost ${cost}, ${meaning}`;
      return `${where}: ${away.toFixed(2)} m from an obstacle, cost 252 exp(-${scaling} (${away.toFixed(2)} - ${inscribed})) = ${cost}`;
    }

    /* The cost by distance, and where the cell that is looked at is on it. */
    plot() {
      const { radius, resolution } = this.settings;
      const reach = cellDistance(radius, resolution) * resolution;
      const most = Math.max(1.5, reach);
      const x = (distance) => (40 + (590 * distance) / most).toFixed(1);
      const y = (cost) => (120 - (105 * cost) / 254).toFixed(1);
      const points = [];
      for (let d = 0; d <= reach + 1e-9; d += most / 300) points.push(`${x(d)},${y(costAt(d, this.settings))}`);
      points.push(`${x(reach)},${y(costAt(reach, this.settings))}`, `${x(reach)},${y(0)}`, `${x(most)},${y(0)}`);
      const labels = [0, 0.5, 1, 1.5].filter((d) => d <= most).map((d) => `<text x="${x(d)}" y="136" text-anchor="middle">${d}</text>`).join("");
      const away = this.at === null ? Infinity : Math.sqrt(this.squared[this.at]) * resolution;
      const dot = Number.isFinite(away) && reach ? `<circle class="at" cx="${x(away)}" cy="${y(costAt(away, this.settings))}" r="4.5"/>` : "";
      this.curve.innerHTML = `<line class="axis" x1="40" y1="120" x2="630" y2="120"/><line class="axis" x1="40" y1="15" x2="40" y2="120"/>
<text x="34" y="124" text-anchor="end">0</text><text x="34" y="20" text-anchor="end">254</text>${labels}
<text x="630" y="148" text-anchor="end">distance from the nearest obstacle [m]</text><text x="46" y="14">cost</text>
<polyline class="line" points="${points.join(" ")}"/>${dot}`;
      this.curve.setAttribute("aria-label", `The cost by distance: 254 at 0 m, 253 up to ${this.settings.inscribed} m, 0 from ${reach.toFixed(2)} m on`);
    }

    point(event) {
      const frame = this.map.getBoundingClientRect();
      const [width, height] = this.size;
      const scale = Math.min(frame.width / width, frame.height / height);
      const x = Math.floor((event.clientX - frame.left - (frame.width - width * scale) / 2) / scale);
      const y = Math.floor((event.clientY - frame.top - (frame.height - height * scale) / 2) / scale);
      if (x < 0 || y < 0 || x >= width || y >= height) return;
      this.at = y * width + x;
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

  globalThis.rosminiInflation = {
    inflated: (costs, size, settings) => inflated(costs, size, settings).costs,
    mount: (host, data, options) => { host.dials = new Dials(host, data, options); },
  };
})();
