/* How the teleoperation pad looks. `rosmini-pad.js` puts this into the page once, and sets the colours of the page's theme on the pad. */

globalThis.rosminiPadStyle = `
.rosmini-pad {
  --rp-soft: color-mix(in srgb, var(--rosmini-line) 14%, var(--rosmini-page));
  --rp-edge: color-mix(in srgb, var(--rosmini-line) 38%, var(--rosmini-page));
  color: var(--rosmini-ink);
  background: var(--rosmini-page);
  border: 1px solid var(--rp-edge);
  border-radius: 12px;
  container-type: inline-size;
  font: 14px/1.45 "Helvetica Neue", Helvetica, Arial, "Liberation Sans", "DejaVu Sans", sans-serif;
  max-width: 860px;
  overflow: hidden;
  text-align: left;
}
.rosmini-pad *, .rosmini-pad *::before { box-sizing: border-box; }
.rosmini-pad p, .rosmini-pad pre { margin: 0; }
.rosmini-pad [hidden] { display: none !important; }
.rosmini-pad kbd {
  background: var(--rosmini-page);
  border: 1px solid var(--rp-edge);
  border-bottom-width: 2px;
  border-radius: 4px;
  box-shadow: none;
  color: var(--rosmini-ink);
  display: inline-block;
  font: 600 12px/1.4 ui-monospace, SFMono-Regular, Menlo, Consolas, "DejaVu Sans Mono", monospace;
  min-width: 1.7em;
  padding: 0 0.35em;
  text-align: center;
}
.rp-stage {
  border-radius: 11px 11px 0 0;
  outline: none;
  position: relative;
}
.rp-stage:focus { outline: 2px solid transparent; }
.rp-stage:focus::after { border: 3px solid var(--rosmini-blue); border-radius: 11px 11px 0 0; content: ""; inset: 0; pointer-events: none; position: absolute; }
.rp-sight { cursor: pointer; min-height: 64px; padding: 4px; position: relative; }
.rp-blind .rp-sight { min-height: 54px; }
.rp-sight canvas { border-radius: 8px; }
.rp-pill, .rp-hint {
  background: color-mix(in srgb, var(--rosmini-page) 88%, transparent);
  border-radius: 99px;
  pointer-events: none;
  position: absolute;
}
.rp-pill {
  align-items: center;
  border: 1px solid var(--rp-edge);
  display: flex;
  font-size: 12px;
  gap: 6px;
  left: 14px;
  max-width: calc(100% - 28px);
  padding: 2px 10px 2px 8px;
  top: 14px;
}
.rp-pill i { background: var(--rosmini-group-line); border-radius: 50%; flex: none; height: 8px; width: 8px; }
.rp-pill[data-mood="driving"] i { background: var(--rosmini-green); }
.rp-pill[data-mood="blocked"] i { background: var(--rosmini-vermilion); border-radius: 1px; }
.rp-pill[data-mood="waiting"] i, .rp-pill[data-mood="gone"] i { background: var(--rosmini-orange); border-radius: 1px; }
.rp-pill[data-mood="waiting"], .rp-pill[data-mood="gone"] { border-radius: 12px; font-weight: 600; }
.rp-hint {
  border: 1px solid var(--rosmini-blue);
  bottom: 18px;
  left: 50%;
  padding: 5px 14px;
  transform: translateX(-50%);
  white-space: nowrap;
}
.rp-blind .rp-hint { bottom: auto; left: auto; right: 14px; top: 10px; transform: none; }
.rp-held .rp-hint { visibility: hidden; }
.rp-side {
  background: var(--rp-soft);
  border-top: 1px solid var(--rp-edge);
  display: grid;
  grid-template-columns: auto minmax(150px, 1fr) minmax(0, 1.35fr);
}
.rp-keys { align-content: center; display: grid; gap: 6px; grid-template: repeat(3, 54px) / repeat(3, 54px); padding: 12px 16px; }
.rp-options { border-top: 1px solid var(--rp-edge); display: flex; flex-wrap: wrap; font-size: 12.5px; gap: 4px 24px; padding: 8px 16px 0; }
.rp-options label { align-items: center; cursor: pointer; display: flex; gap: 6px; min-height: 26px; }
.rosmini-pad select { background: var(--rosmini-page); border: 1px solid var(--rp-edge); border-radius: 6px; color: var(--rosmini-ink); font: inherit; max-width: 100%; min-height: 26px; min-width: 0; }
.rosmini-pad input { accent-color: var(--rosmini-blue); margin: 0; }
.rosmini-pad select:focus-visible, .rosmini-pad input:focus-visible { box-shadow: 0 0 0 3px var(--rosmini-blue); outline: 2px solid transparent; }
.rp-gauges { align-content: center; display: grid; gap: 10px; padding: 12px 16px 12px 0; }
.rosmini-pad button {
  appearance: none;
  background: var(--rosmini-page);
  border: 1px solid var(--rp-edge);
  border-radius: 10px;
  color: var(--rosmini-ink);
  cursor: pointer;
  font: inherit;
  margin: 0;
  padding: 0;
  -webkit-tap-highlight-color: transparent;
  touch-action: manipulation;
  user-select: none;
  -webkit-user-select: none;
}
.rosmini-pad button.rp-key {
  align-items: center;
  border-bottom-width: 3px;
  display: flex;
  flex-direction: column;
  gap: 2px;
  justify-content: center;
  touch-action: none;
}
.rp-arrow { color: var(--rosmini-blue); font-size: 19px; font-weight: 700; line-height: 1; }
.rp-name { clip-path: inset(50%); height: 1px; overflow: hidden; position: absolute; width: 1px; }
.rosmini-pad .rp-key kbd { background: none; border: 0; color: var(--rosmini-muted); padding: 0; }
.rosmini-pad button.rp-stop .rp-arrow { color: var(--rosmini-vermilion); font-size: 15px; line-height: 19px; }
.rosmini-pad button:hover { border-color: var(--rosmini-blue); }
.rosmini-pad button:focus-visible { box-shadow: 0 0 0 3px var(--rosmini-blue); outline: 2px solid transparent; }
.rosmini-pad button.rp-down { background: var(--rosmini-blue); border-color: var(--rosmini-blue); border-bottom-width: 1px; padding-top: 2px; }
.rosmini-pad button.rp-stop.rp-down { background: var(--rosmini-vermilion); border-color: var(--rosmini-vermilion); }
.rosmini-pad button.rp-down .rp-arrow, .rosmini-pad button.rp-down kbd { color: var(--rosmini-page); }
.rp-meters { display: grid; gap: 10px; }
.rp-meter { display: grid; grid-template-columns: auto 1fr; }
.rp-name { color: var(--rosmini-muted); font-size: 12px; }
.rp-value { font-variant-numeric: tabular-nums; }
.rp-meter .rp-value { font-weight: 600; text-align: right; }
.rp-scale {
  background: color-mix(in srgb, var(--rosmini-line) 24%, var(--rosmini-page));
  border-radius: 4px;
  grid-column: 1 / 3;
  height: 8px;
  margin-top: 4px;
  position: relative;
}
.rp-scale::before { background: var(--rosmini-muted); content: ""; height: 14px; left: 50%; position: absolute; top: -3px; width: 1px; }
.rp-bar, .rp-mark { position: absolute; }
.rp-bar { background: var(--rosmini-blue); border-radius: 3px; height: 8px; }
.rp-mark { background: var(--rosmini-ink); border-radius: 2px; height: 14px; margin-left: -1.5px; top: -3px; width: 3px; }
.rp-actions { align-content: start; display: grid; gap: 8px; }
.rosmini-pad button.rp-plain { min-height: 44px; padding: 4px 10px; }
.rosmini-pad button[data-act="start"] { background: var(--rosmini-blue); border-color: var(--rosmini-blue); color: var(--rosmini-page); font-weight: 600; }
.rp-readings { display: flex; flex-wrap: wrap; gap: 2px 28px; padding: 2px 16px 6px; }
.rp-readings .rp-name { margin-right: 8px; }
.rp-messages { background: #17202a; color: #e8edf2; display: flex; flex-direction: column; min-width: 0; padding: 8px 14px; }
.rp-messages, .rosmini-pad .rp-log pre { font: 12.5px/1.4 ui-monospace, SFMono-Regular, Menlo, Consolas, "DejaVu Sans Mono", monospace; }
.rp-command { overflow-wrap: anywhere; }
.rp-command span { color: #2fc79a; }
.rp-command em { color: #a3afba; float: right; font-style: normal; }
.rp-log { display: flex; flex: 1 1 172px; flex-direction: column; justify-content: flex-end; margin-top: 4px; min-height: 172px; overflow: hidden; }
.rp-log p { color: #a3afba; margin-bottom: auto; }
.rosmini-pad .rp-log pre {
  background: none;
  border: 0;
  box-shadow: none;
  color: #a3afba;
  flex: none;
  overflow: hidden;
  padding: 0;
}
.rosmini-pad .rp-log pre:last-child { color: #ffffff; }
.rosmini-pad .rp-help { color: var(--rosmini-muted); font-size: 12.5px; line-height: 1.75; padding: 8px 16px 10px; }
.rp-help span { margin-right: 14px; white-space: nowrap; }
.rp-spoken { clip-path: inset(50%); height: 1px; overflow: hidden; position: absolute; white-space: nowrap; width: 1px; }
.rp-turtles .rp-stage { display: grid; grid-template-columns: minmax(0, 440px) minmax(0, 1fr); }
.rp-turtles .rp-side { grid-column: 1; grid-template-columns: auto minmax(0, 1fr); }
.rp-turtles .rp-messages { grid-area: 1 / 2 / 3 / 3; }
.rp-turtles .rp-log { flex: 1 1 170px; min-height: 170px; }
.rp-turtles .rp-poses { flex: 0 0 110px; min-height: 110px; }
.rp-turtles .rp-sight canvas { aspect-ratio: 1; display: block; width: 100%; }
@container (max-width: 620px) {
  .rp-turtles .rp-stage { grid-template-columns: minmax(0, 1fr); }
  .rp-turtles .rp-messages { grid-area: auto; }
  .rp-side { grid-template-columns: auto minmax(0, 1fr); }
  .rp-keys, .rp-gauges { padding: 12px; }
  .rp-gauges { padding-left: 0; }
  .rp-messages { grid-column: 1 / 3; }
  .rp-log:has(p) { flex: none; min-height: 0; padding-bottom: 8px; }
}
@container (max-width: 420px) {
  .rp-readings { display: grid; }
  }
@media (hover: none) {
  .rp-hint { display: none; }
}
@media (prefers-reduced-motion: no-preference) {
  .rosmini-pad button { transition: background-color 80ms, border-color 80ms; }
}
@media (forced-colors: active) {
  .rp-stage:focus::after { border-color: Highlight; }
  .rosmini-pad button:focus-visible { outline: 3px solid Highlight; outline-offset: -3px; }
  .rp-bar { background: Highlight; }
  .rp-mark { background: CanvasText; }
}
`;
