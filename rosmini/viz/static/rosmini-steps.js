/* A player of stored frames. A plain script that sets `globalThis.rosminiSteps`; `mount(host, data, options)` shows what
   `rosmini.viz.stepped_player.SteppedPlayer.data` has, in the panels of the still picture. */

(() => {
  "use strict";

  const STYLE = `
.rosmini-steps { font: 13px var(--rosmini-font, sans-serif); }
.rosmini-steps > .rs-panels { display: flex; flex-wrap: wrap; gap: 12px 20px; justify-content: center; }
.rs-panels > div { flex: 0 1 auto; max-width: 100%; }
.rs-panels span { display: block; margin-bottom: 4px; opacity: 0.8; }
.rs-panels svg { display: block; height: auto; max-width: 100%; outline: 1px solid rgb(128 128 128 / 50%); outline-offset: -1px; }
.rs-said { font-variant-numeric: tabular-nums; margin: 6px 0 0 !important; white-space: pre-line; }
.rs-controls { align-items: center; display: flex; flex-wrap: wrap; gap: 6px 16px; margin-top: 8px; }
.rs-controls label { align-items: center; display: flex; flex: 1 1 250px; gap: 8px; }
.rs-controls input { accent-color: var(--rosmini-blue, #0072b2); flex: 1; min-width: 80px; }
.rs-value { font-variant-numeric: tabular-nums; min-width: 4.5em; }
.rs-controls button { background: transparent; border: 1px solid currentColor; border-radius: 3px; color: inherit; font: inherit; padding: 3px 10px; }
`;

  class Player {
    constructor(host, data, { title, still }) {
      this.data = data;
      const box = document.createElement("div");
      box.className = "rosmini-steps";
      box.innerHTML = `<style>${STYLE}</style><div class="rs-panels"></div>
<div class="rs-controls" role="group"></div><p class="rs-said" role="status"></p>`;
      host.replaceChildren(box);
      this.said = box.querySelector(".rs-said");
      this.panels = Array.from(still.querySelectorAll(".rm-panel"), (panel) => this.panel(panel, box.querySelector(".rs-panels")));
      const controls = box.querySelector(".rs-controls");
      controls.setAttribute("aria-label", `Controls of ${title}`);
      controls.addEventListener("keydown", (event) => event.stopPropagation()); // a notebook has commands on single keys
      if (data.axes.length === 1) {
        this.button = this.control(controls, "Play", () => this.play());
        this.control(controls, "Next step", () => this.go(Number(this.sliders[0].value) + 1));
      }
      this.sliders = data.axes.map((axis, i) => this.slider(controls, axis, data.first[i]));
      this.draw();
    }

    panel(panel, place) {
      const svg = panel.cloneNode(true);
      for (const name of ["x", "y"]) svg.removeAttribute(name);
      svg.setAttribute("role", "img");
      const part = document.createElement("div");
      if (panel.dataset.name) part.append(Object.assign(document.createElement("span"), { textContent: panel.dataset.name }));
      part.append(svg);
      place.append(part);
      return svg;
    }

    control(place, text, act) {
      const button = Object.assign(document.createElement("button"), { type: "button", textContent: text });
      button.addEventListener("click", act);
      place.append(button);
      return button;
    }

    slider(place, [name, values], first) {
      const label = document.createElement("label");
      const slider = Object.assign(document.createElement("input"), { type: "range", min: 0, max: values.length - 1, value: first });
      slider.setAttribute("aria-label", name);
      slider.addEventListener("input", () => this.draw());
      const value = Object.assign(document.createElement("span"), { className: "rs-value" });
      label.append(name, slider, value);
      place.append(label);
      return slider;
    }

    go(step) {
      this.sliders[0].value = step;
      this.draw();
    }

    play() {
      if (this.timer) return this.stop();
      const [slider] = this.sliders, last = Number(slider.max);
      if (Number(slider.value) >= last) this.go(0);
      this.button.textContent = "Pause";
      this.timer = setInterval(() => {
        this.go(Number(slider.value) + 1);
        if (!slider.isConnected || Number(slider.value) >= last) this.stop();
      }, this.data.period);
    }

    stop() {
      clearInterval(this.timer);
      this.timer = null;
      this.button.textContent = "Play";
    }

    draw() {
      const number = this.sliders.reduce((sum, slider, i) => sum * this.data.axes[i][1].length + Number(slider.value), 0);
      const [pictures, text] = this.data.frames[number];
      this.said.textContent = text;
      this.panels.forEach((svg, i) => {
        svg.lastElementChild.innerHTML = this.data.pictures[pictures[i]];
        svg.setAttribute("aria-label", svg.dataset.name ? `${svg.dataset.name}: ${text}` : text);
      });
      this.sliders.forEach((slider, i) => {
        const value = this.data.axes[i][1][Number(slider.value)];
        slider.nextElementSibling.textContent = value;
        slider.setAttribute("aria-valuetext", value);
      });
    }
  }

  globalThis.rosminiSteps = { mount: (host, data, options) => { host.player = new Player(host, data, options); } };
})();
