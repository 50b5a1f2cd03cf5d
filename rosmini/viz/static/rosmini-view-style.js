/* How a view of a simulation looks. `rosmini-view.js` puts this into the page once, and sets the colours of the page's theme on the view. */

globalThis.rosminiViewStyle = `
.rosmini-view {
  --rv-soft: color-mix(in srgb, var(--rosmini-line) 14%, var(--rosmini-page));
  --rv-edge: color-mix(in srgb, var(--rosmini-line) 38%, var(--rosmini-page));
  color: var(--rosmini-ink);
  background: var(--rosmini-page);
  border: 1px solid var(--rv-edge);
  border-radius: 12px;
  font: 14px/1.45 "Helvetica Neue", Helvetica, Arial, "Liberation Sans", "DejaVu Sans", sans-serif;
  max-width: 860px;
  overflow: hidden;
  text-align: left;
}
.rosmini-view *, .rosmini-view *::before { box-sizing: border-box; }
.rosmini-view p { margin: 0; }
.rosmini-view [hidden] { display: none !important; }
.rosmini-view kbd {
  background: var(--rosmini-page);
  border: 1px solid var(--rv-edge);
  border-bottom-width: 2px;
  border-radius: 4px;
  box-shadow: none;
  color: var(--rosmini-ink);
  display: inline-block;
  font: 600 12px/1.4 ui-monospace, SFMono-Regular, Menlo, Consolas, "DejaVu Sans Mono", monospace;
  margin-right: 2px;
  min-width: 1.7em;
  padding: 0 0.35em;
  text-align: center;
}
.rv-bar { align-items: center; background: var(--rv-soft); border-bottom: 1px solid var(--rv-edge); display: flex; flex-wrap: wrap; gap: 8px; padding: 8px 12px; }
.rv-pill { align-items: center; display: flex; font-size: 12px; gap: 6px; }
.rv-pill i { background: var(--rosmini-group-line); border-radius: 50%; flex: none; height: 8px; width: 8px; }
.rv-pill[data-mood="running"] i { background: var(--rosmini-green); }
.rv-pill[data-mood="waiting"] i, .rv-pill[data-mood="gone"] i { background: var(--rosmini-orange); border-radius: 1px; }
.rv-pill[data-mood="waiting"], .rv-pill[data-mood="gone"] { font-weight: 600; }
.rv-clock { flex: 1; font-variant-numeric: tabular-nums; font-weight: 600; min-width: 7em; text-align: right; }
.rosmini-view button.rv-plain {
  appearance: none;
  background: var(--rosmini-page);
  border: 1px solid var(--rv-edge);
  border-radius: 10px;
  color: var(--rosmini-ink);
  cursor: pointer;
  font: inherit;
  margin: 0;
  min-height: 36px;
  padding: 4px 12px;
}
.rosmini-view button.rv-plain[data-act="start"] { background: var(--rosmini-blue); border-color: var(--rosmini-blue); color: var(--rosmini-page); font-weight: 600; }
.rosmini-view button.rv-plain:hover:enabled { border-color: var(--rosmini-blue); }
.rosmini-view button.rv-plain:disabled { cursor: default; opacity: 0.5; }
.rosmini-view button:focus-visible { box-shadow: 0 0 0 3px var(--rosmini-blue); outline: 2px solid transparent; }
.rv-stage { overflow: hidden; padding: 0; position: relative; }
.rv-things { inset: 0; pointer-events: none; position: absolute; }
.rosmini-view button.rv-thing {
  appearance: none;
  background: none;
  border: 2px solid transparent;
  border-radius: 50%;
  cursor: grab;
  left: 0;
  margin: 0;
  padding: 0;
  pointer-events: auto;
  position: absolute;
  top: 0;
  touch-action: none;
  user-select: none;
  -webkit-user-select: none;
  -webkit-tap-highlight-color: transparent;
}
.rosmini-view button.rv-thing:hover { border-color: var(--rv-edge); }
.rosmini-view button.rv-thing:focus { border-color: var(--rosmini-blue); }
.rv-handle {
  background: var(--rosmini-page);
  border: 3px solid var(--rosmini-blue);
  border-radius: 50%;
  cursor: crosshair;
  height: 22px;
  left: 0;
  position: absolute;
  top: 0;
  touch-action: none;
  width: 22px;
}
.rv-holding, .rv-holding button.rv-thing { cursor: grabbing !important; }
.rosmini-view .rv-message { border-top: 1px solid var(--rv-edge); min-height: 3.8em; padding: 6px 16px; }
.rosmini-view .rv-message.rv-bad { border-left: 4px solid var(--rosmini-vermilion); font-weight: 600; padding-left: 12px; }
.rosmini-view .rv-help { border-top: 1px solid var(--rv-edge); color: var(--rosmini-muted); font-size: 12.5px; line-height: 1.75; padding: 8px 16px 10px; }
.rv-help span { margin-right: 10px; }
@media (prefers-reduced-motion: no-preference) {
  .rosmini-view button.rv-refused { animation: rv-refused 0.45s ease-out; }
}
@keyframes rv-refused { 0%, 60% { border-color: var(--rosmini-vermilion); box-shadow: 0 0 0 6px color-mix(in srgb, var(--rosmini-vermilion) 40%, transparent); } }
@media (forced-colors: active) {
  .rosmini-view button.rv-thing:focus { border-color: Highlight; }
  .rv-handle { border-color: Highlight; }
}
`;
