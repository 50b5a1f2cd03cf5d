/* The controls of a teleoperation pad: the keys of a program as buttons and as words, and gamepads. A plain script that sets
   `globalThis.rosminiPadKeys`.

     grid(map)              an element with the buttons of a key map (`table` of `rosmini.viz.live.teleop`), and a Map of them.
     keyOf(map, event)      the key of the map that a keyboard event means, or undefined.
     buttonOf(map, buttons, key)   the button that does what a key does.
     instructions(map)      what the keys do, as elements.
     new Gamepads(take)     calls take([ahead, left]) with -1 to 1 each while a shoulder button of a gamepad is held, which is its
                            dead man's switch, and take(null) when it is released; close(). */

(() => {
  "use strict";

  const LOOKS = new Map([
    ["1,0,0,0", ["Forward", "↑"]], ["-1,0,0,0", ["Backward", "↓"]],
    ["0,0,0,1", ["Turn left", "↺"]], ["0,0,0,-1", ["Turn right", "↻"]],
    ["1,0,0,1", ["Forward and left", "↖"]], ["1,0,0,-1", ["Forward and right", "↗"]],
    ["-1,0,0,-1", ["Backward and left", "↙"]], ["-1,0,0,1", ["Backward and right", "↘"]],
  ]);
  const HELP = {
    turtlebot3_teleop_key: [
      [["w"], "faster,", ["x"], "slower;"],
      [["a"], "more to the left,", ["d"], "more to the right;"],
      [["s"], "or", ["space"], "stop at once;"],
      ["the arrows do as", ["w"], ["x"], ["a"], ["d"], "do;"],
    ],
    teleop_twist_keyboard: [
      [["i"], "ahead,", [","], "back;"],
      [["j"], ["l"], "turn;"],
      [["u"], ["o"], ["m"], ["."], "both;"],
      [["k"], "and any other key: stop;"],
      [["q"], ["z"], "10 % faster, slower;"],
      [["w"], ["x"], "straight on only;"],
      [["e"], ["c"], "turning only;"],
      ["with", ["Shift"], "sideways,", ["t"], ["b"], "up and down, where a robot can;"],
    ],
    turtle_teleop_key: [
      [["↑"], ["↓"], "ahead and back,", ["←"], ["→"], "turns,"],
      ["one message for each press, which lasts a second;"],
      [["space"], "stop at once;"],
    ],
  };
  const NAMES = { " ": "space", ArrowUp: "↑", ArrowDown: "↓", ArrowLeft: "←", ArrowRight: "→" };
  const SWITCHES = [4, 5, 6, 7]; // the shoulder buttons of a standard gamepad
  const DEAD_ZONE = 0.08;

  function element(tag, attributes = {}, ...children) {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
    made.append(...children);
    return made;
  }

  const meaning = (map, key) => (map.stops.includes(key) ? "stop" : String(map.moves[key] ?? map.factors[key]));
  const keysOf = (map) => [...Object.keys(map.moves), ...Object.keys(map.factors), ...map.stops];

  function button(map, key, [name, arrow]) {
    const shortcuts = keysOf(map).filter((other) => meaning(map, other) === meaning(map, key))
      .map((other) => (other === " " ? "Space" : other));
    const made = element(
      "button",
      {
        type: "button", class: `rp-key${map.stops.includes(key) ? " rp-stop" : ""}`, "data-key": key,
        "aria-keyshortcuts": shortcuts.join(" "), title: `${name} (${key})`,
      },
      element("span", { class: "rp-arrow", "aria-hidden": "true" }, arrow), element("span", { class: "rp-name" }, name),
      element("kbd", {}, NAMES[key] ?? key),
    );
    return made;
  }

  function grid(map) {
    const buttons = new Map();
    const keys = element("div", { class: "rp-keys", role: "group", "aria-label": "Keys" });
    map.buttons.forEach((key, i) => {
      if (!key) return;
      const made = button(map, key, map.stops.includes(key) ? ["Stop", "■"] : LOOKS.get(String(map.moves[key])));
      made.style.gridArea = `${1 + Math.floor(i / 3)} / ${1 + (i % 3)}`;
      buttons.set(key, made);
      keys.append(made);
    });
    const speeds = Object.entries(map.factors).filter(([, factors]) => factors[0] === factors[1]);
    for (const [key, [factor]] of speeds.reverse()) {
      const made = button(map, key, factor > 1 ? ["Faster", "+"] : ["Slower", "−"]);
      buttons.set(key, made);
      keys.append(made);
    }
    return { keys, buttons };
  }

  function keyOf(map, event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return undefined;
    // Where the keyboard writes another alphabet, the place of a key counts.
    const named = event.key.length === 1 && event.key > "~" ? event.code.replace("Key", "") : event.key;
    const known = keysOf(map);
    for (const key of [named, named.length === 1 ? named.toLowerCase() : named]) if (known.includes(key)) return key;
    return map.others_stop && named.length === 1 ? map.stops[0] : undefined;
  }

  function buttonOf(map, buttons, key) {
    return buttons.get(key) ?? [...buttons].find(([other]) => meaning(map, other) === meaning(map, key))?.[1];
  }

  function instructions(map) {
    const line = (parts) =>
      element("span", {}, ...parts.flatMap((part) => [typeof part === "string" ? part : element("kbd", {}, ...part), " "]));
    const driven = map.name === "turtle_teleop_key" ? "turtle" : "robot";
    const last = [["Esc"], `leaves the pad, and the ${driven} stops.`];
    return [...HELP[map.name], last].flatMap((parts) => [line(parts), " "]); // a line may break between them
  }

  class Gamepads {
    constructor(take) {
      this.take = take;
      this.held = false;
      this.look = () => {
        const pad = [...navigator.getGamepads()].find((each) => each?.connected);
        this.asked = pad ? requestAnimationFrame(this.look) : undefined;
        const held = Boolean(pad) && SWITCHES.some((which) => pad.buttons[which]?.pressed);
        if (held) this.take([1, 0].map((axis) => this.stick(-pad.axes[axis])));
        else if (this.held) this.take(null);
        this.held = held;
      };
      this.begin = () => { if (this.asked === undefined) this.look(); };
      globalThis.addEventListener("gamepadconnected", this.begin);
      if (navigator.getGamepads?.().some?.((each) => each?.connected)) this.begin();
    }

    /* How far a stick is out, from the edge of its dead zone. */
    stick(value) {
      const beyond = Math.max(0, Math.abs(value) - DEAD_ZONE) / (1 - DEAD_ZONE);
      return Math.sign(value) * Math.min(1, Math.round(beyond * 100) / 100);
    }

    close() {
      globalThis.removeEventListener("gamepadconnected", this.begin);
      cancelAnimationFrame(this.asked);
    }
  }

  globalThis.rosminiPadKeys = { element, grid, keyOf, buttonOf, instructions, Gamepads };
})();
