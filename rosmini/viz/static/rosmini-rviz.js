/* RViz's window in three dimensions: a running scene in meshcat's viewer, with tools under the mouse.

   It needs rosmini-meshcat.js and is called by rosmini-rqt.js:

     rosminiRviz.show(panel, content, buffers)   `content` is {type: "solid", whole, camera, labels, grips, turns, background, size} of
                                                 `rosmini/viz/rviz/solid_page.py`, of which only what has changed is there; buffers are
                                                 commands of meshcat's viewer.

   `camera` is [N, x, y, z, yaw, pitch, distance, field of view]: what one looks at [m], from where [rad, m], and an angle [deg]. The mouse
   turns the scene here, at once, and the kernel learns of it by "orbit N yaw pitch distance dx dy dz"; a camera with a smaller N than was
   sent last is from before that. `turns` says that the left button turns the scene, but on things under the paths of `grips`: else it is
   the tool's, which is told in words where the mouse is in a picture of `size` [px]: "press x y", "move x y", "release x y". */

(() => {
  "use strict";

  const PAUSE_MS = 50; // no two words of a hand follow one another faster
  const NEAR = 1e-4; // by so little of its distance a camera does not differ from another
  const FARTHEST = 2000; // metres
  const KEYS = /^[a-z]$/;

  const placed = ([x, y, z]) => [x, z, -y]; // the camera's frame has y up

  class Solid {
    constructor(panel, host) {
      Object.assign(this, { panel, host, state: {}, sent: 0, told: 0 });
      host.rosminiSolid = this;
      const still = host; // it is seen when its place is
      globalThis.rosminiMeshcat.mount(host, { commands: "", themes: { light: {}, dark: {} }, duration: 0, follow: null, legend: [], background: ["#303030", "#303030", "#ffffff"] }, {
        title: "RViz", alt: "The scene of RViz in three dimensions.", height: 420, still, show: () => {}, asset: globalThis.rosminiAsset,
        ready: (viewer, frame) => this.begin(viewer, frame),
      }).then((shown) => { if (shown === false) panel.set("view", "flat"); });
    }

    begin(viewer, frame) {
      const { MOUSE } = frame.contentWindow.MeshCat.THREE;
      const { controls, camera } = viewer;
      Object.assign(this, { viewer, frame, labels: [], at: null, state: {} });
      controls.maxDistance = FARTHEST;
      controls.minDistance = 0.05;
      if (MOUSE) controls.mouseButtons = { LEFT: MOUSE.ROTATE, MIDDLE: MOUSE.PAN, RIGHT: MOUSE.DOLLY };
      camera.near = 0.02;
      camera.far = FARTHEST;
      controls.addEventListener("change", () => this.turned());
      const page = frame.contentDocument;
      for (const kind of ["pointerdown", "pointermove", "pointerup", "pointercancel"]) page.addEventListener(kind, (event) => this.point(event), true);
      page.addEventListener("keydown", (event) => {
        if (KEYS.test(event.key) && !event.ctrlKey && !event.altKey && !event.metaKey) this.say(`key ${event.key}`);
      });
      this.panel.tell({ type: "hello" }); // it has nothing yet
    }

    say(words) {
      this.panel.set("view", words);
    }

    // -- from the kernel ----------------------------------------------------------------------------------------------

    hear(content, buffers) {
      if (!this.viewer || (!content.whole && !this.filled)) return;
      this.filled = true;
      const { viewer, frame, state } = this;
      for (const each of buffers) viewer.handle_command_bytearray(new Uint8Array(each.buffer ?? each, each.byteOffset ?? 0, each.byteLength));
      Object.assign(state, content);
      if (content.size) Object.assign(frame.style, { height: "auto", aspectRatio: `${content.size[0]} / ${content.size[1]}` });
      if (content.background) frame.contentDocument.body.style.background = content.background;
      if (content.labels) this.write(content.labels);
      if (content.camera) this.look(content.camera);
      viewer.set_dirty();
    }

    write(labels) {
      for (const each of this.labels) {
        each.removeFromParent();
        each.material.map.dispose();
        each.material.dispose();
      }
      this.labels = labels.map((each) => globalThis.rosminiMeshcat.label(this.frame.contentWindow, this.viewer, each));
    }

    look([turn, x, y, z, yaw, pitch, distance, angle]) {
      const { camera, controls } = this.viewer;
      if (turn < this.sent || this.turning) return;
      const target = placed([x, y, z]);
      const flat = distance * Math.cos(pitch);
      const eye = placed([x + flat * Math.cos(yaw), y + flat * Math.sin(yaw), z + distance * Math.sin(pitch)]);
      controls.target.set(...target);
      camera.position.set(...eye);
      if (camera.fov !== angle) camera.fov = angle;
      camera.updateProjectionMatrix();
      this.at = { target: controls.target.clone(), eye: camera.position.clone() };
    }

    // -- from the hand ------------------------------------------------------------------------------------------------

    /* The mouse, the wheel or keys have turned the view: the kernel learns of it, soon. */
    turned() {
      const { camera, controls } = this.viewer;
      const reach = camera.position.distanceTo(controls.target);
      if (!this.at || (camera.position.distanceTo(this.at.eye) < NEAR * reach && controls.target.distanceTo(this.at.target) < NEAR * reach)) return;
      this.turning ??= setTimeout(() => this.report(), PAUSE_MS);
    }

    report() {
      const { camera, controls } = this.viewer;
      this.turning = undefined;
      const [dx, dy, dz] = ["x", "y", "z"].map((axis) => camera.position[axis] - controls.target[axis]);
      const reach = Math.hypot(dx, dy, dz);
      const shift = ["x", "y", "z"].map((axis) => controls.target[axis] - this.at.target[axis]);
      this.at = { target: controls.target.clone(), eye: camera.position.clone() };
      this.sent += 1;
      const numbers = [Math.atan2(-dz, dx), Math.asin(dy / reach), reach, shift[0], -shift[2], shift[1]];
      this.say(`orbit ${this.sent} ${numbers.map((each) => each.toFixed(5)).join(" ")}`);
    }

    point(event) {
      if (event.type === "pointerdown") this.held = event.button === 0 && this.takes(event);
      if (!this.held) return;
      event.stopImmediatePropagation(); // the view stays
      const words = event.type === "pointerdown" ? "press" : event.type === "pointermove" ? "move" : "release";
      if (words === "press") {
        const canvas = this.viewer.renderer.domElement;
        canvas.focus({ preventScroll: true });
        canvas.setPointerCapture(event.pointerId);
        event.preventDefault();
      }
      if (words === "move" && performance.now() - this.told < PAUSE_MS) return;
      this.told = performance.now();
      this.say(`${words} ${this.pixel(event).join(" ")}`);
      if (words === "release") this.held = false;
    }

    pixel(event) {
      const box = this.viewer.renderer.domElement.getBoundingClientRect();
      const [width, height] = this.state.size;
      return [((event.clientX - box.left) / box.width) * width, ((event.clientY - box.top) / box.height) * height].map((each) => each.toFixed(1));
    }

    /* Whether a press is the tool's: of one that turns the view only where there is something to take hold of. */
    takes(event) {
      if (!this.state.turns) return true;
      const { Raycaster, Vector2 } = this.frame.contentWindow.MeshCat.THREE;
      const box = this.viewer.renderer.domElement.getBoundingClientRect();
      const ray = new Raycaster();
      ray.setFromCamera(new Vector2((2 * (event.clientX - box.left)) / box.width - 1, 1 - (2 * (event.clientY - box.top)) / box.height), this.viewer.camera);
      const things = [];
      for (const path of this.state.grips) globalThis.rosminiMeshcat.find(this.viewer, path).traverse((each) => { if (each.isMesh) things.push(each); });
      return ray.intersectObjects(things, false).length > 0;
    }
  }

  function show(panel, content, buffers) {
    const host = panel.host.querySelector(".rq-solid");
    if (host && (host.rosminiSolid ?? new Solid(panel, host)).panel === panel) host.rosminiSolid.hear(content, buffers);
  }

  globalThis.rosminiRviz = { show };
})();
