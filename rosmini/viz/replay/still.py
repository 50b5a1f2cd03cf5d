"""The last moment of a run as an SVG: pages show it until their script runs, or if no script can run."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rosmini.viz.figures import WIDTH
from rosmini.viz.map_colours import ALPHA, UNKNOWN, colours_of, painted, scheme_of
from rosmini.viz.replay.grids import Grid, Grids, coarse
from rosmini.viz.replay.layers import Layer, Scans, Shape, Shapes, Strokes
from rosmini.viz.replay.run import Body, Run
from rosmini.viz.rounding import points_to_keep, snap
from rosmini.viz.style import LIGHT, hex_colour, variable
from rosmini.viz.svg import document, element, number
from rosmini.viz.view import Picture

Floats = NDArray[np.float64]

MAX_HEIGHT = 480.0
"""Maximum height of the picture [px]."""
MAX_CELLS = 110
"""Maximum number of cells per side of a map, which is drawn as a path around each run of cells."""
TOLERANCE = 0.3
"""Maximum deviation of a drawn line from its points [px]."""
MAX_SCAN_POINTS = 180
"""Maximum number of points of a scan that are drawn."""
HEAD = ((13.0, 0.0), (-9.0, 8.0), (-5.0, 0.0), (-9.0, -8.0))
"""An arrowhead [px], as the player draws it."""


class Canvas:
    """Converts metres to pixels."""

    def __init__(self, run: Run) -> None:
        self.x0, self.y0, self.x1, self.y1 = run.extent()
        wide, high = max(self.x1 - self.x0, 1e-6), max(self.y1 - self.y0, 1e-6)
        self.scale = min(WIDTH / wide, MAX_HEIGHT / high)
        self.width, self.height = wide * self.scale, high * self.scale

    def px(self, points: Floats) -> Floats:
        """Convert points (n, 2) [m] to pixels, y down."""
        flipped = (points[:, :2] - (self.x0, self.y1)) * (self.scale, -self.scale)
        return snap(flipped, 0.1)

    def line(self, points: Floats, *, closed: bool = False) -> str:
        """Return the path data of a line without points that make no visible difference."""
        pixels = self.px(points)
        pixels = pixels[points_to_keep(pixels, TOLERANCE)] if len(pixels) > 2 else pixels
        return "M" + "L".join(f"{number(x)},{number(y)}" for x, y in pixels.tolist()) + ("Z" if closed else "")


def still_of(run: Run, *, title: str, alt: str) -> Picture:
    """Draw the end of a run."""
    canvas = Canvas(run)
    parts = []
    if run.background is not None:
        parts.append(element("rect", width=canvas.width, height=canvas.height, style=f"fill:{run.background}"))
    parts += [_layer(layer, canvas, run.end) for layer in run.layers]
    parts += [_body(body, canvas, run.end) for body in run.bodies if body.shown_from <= run.end < body.shown_until]
    svg = document(
        element("g", "".join(parts), fill="none"), width=canvas.width, height=canvas.height, title=title, alt=alt,
        css="", colours=list(LIGHT), kind="rosmini-run",
    )  # fmt: skip
    return Picture(svg, text=run.text(title), alt=alt)


def _layer(layer: Layer, canvas: Canvas, end: float) -> str:
    if isinstance(layer, Grids) and layer.grids:
        return _grid(layer.grids[-1], layer.scheme or scheme_of(layer.name), canvas)
    if isinstance(layer, Shapes) and layer.items:
        return "".join(_shape(shape, canvas) for shape in layer.items[-1])
    if isinstance(layer, Scans) and layer.count:
        return _scan(layer, canvas)
    if isinstance(layer, Strokes):
        shown = [stroke for stroke in layer.strokes if stroke.until > end]
        return "".join(
            _path(canvas.line(stroke.points), stroke.colour, width=stroke.width)
            for stroke in shown
            if len(stroke.points) > 1
        )
    return ""


def _paint(colour: str) -> str:
    return colour if colour.startswith("#") else variable(colour if colour in LIGHT else "line")


def _path(data: str, colour: str, *, width: float = 2.0, fill: bool = False) -> str:
    kind = f"fill:{_paint(colour)}" if fill else f"stroke:{_paint(colour)};stroke-width:{width:g};stroke-linecap:round"
    return element("path", d=data, style=kind + ";stroke-linejoin:round")


def _grid(grid: Grid, scheme: str, canvas: Canvas) -> str:
    """Return a path for each colour, around its runs of cells."""
    cells, resolution, (x, y, heading) = grid
    factor = -(-max(cells.shape) // MAX_CELLS)
    cells, resolution = (coarse(cells, factor), resolution * factor) if factor > 1 else (cells, resolution)
    colours = painted(cells, scheme)
    paths: dict[tuple[int, ...], list[str]] = {}
    for row in range(cells.shape[0]):
        edges = np.flatnonzero(np.diff(cells[row].astype(int), prepend=-1, append=-1))
        for start, end in zip(edges[:-1].tolist(), edges[1:].tolist(), strict=True):
            colour = tuple(colours[row, start].tolist())
            if colour[3] and cells[row, start] != UNKNOWN:
                paths.setdefault(colour, []).append(f"M{start},{row}h{end - start}v1h-{end - start}z")
    (px, py), turned = canvas.px(np.array([(x, y)]))[0].tolist(), np.rad2deg(heading)
    size = resolution * canvas.scale
    placed = f"translate({number(px)},{number(py)}) rotate({-turned:.3f}) scale({size:.4f},{-size:.4f})"
    drawn = [
        element("path", d="".join(data), style=f"fill:#{red:02x}{green:02x}{blue:02x};fill-opacity:{alpha / 255:.2g}")
        for (red, green, blue, alpha), data in sorted(paths.items())
    ]
    if scheme == "map" and (cells == UNKNOWN).any():  # below all others, since the known cells of a map cover it
        unknown = hex_colour(colours_of(scheme)[UNKNOWN, :3].tolist())
        drawn.insert(0, element("rect", width=cells.shape[1], height=cells.shape[0], style=f"fill:{unknown}"))
    return element("g", "".join(drawn), transform=placed, opacity=f"{ALPHA:g}", shape_rendering="crispEdges")


def _shape(shape: Shape, canvas: Canvas) -> str:
    if not len(shape.points):
        return ""
    if shape.mode in ("line", "closed"):
        return _path(canvas.line(shape.points, closed=shape.mode == "closed"), shape.colour)
    pixels = canvas.px(shape.points)[: 4 * MAX_SCAN_POINTS]
    if shape.mode == "points":
        return _dots(pixels, shape.colour)
    length = 24.0 if len(pixels) == 1 else 9.0
    headings = shape.points[: len(pixels), 2]
    ends = snap(pixels + length * np.column_stack([np.cos(headings), -np.sin(headings)]), 0.1)
    data = "".join(
        f"M{number(a)},{number(b)}L{number(c)},{number(d)}"
        for (a, b), (c, d) in zip(pixels.tolist(), ends.tolist(), strict=True)
    )
    return _path(data, shape.colour, width=1.2)


def _dots(pixels: Floats, colour: str) -> str:
    data = "".join(f"M{number(x)},{number(y)}h0" for x, y in pixels.tolist())
    return _path(data, colour, width=3.6)


def _scan(layer: Scans, canvas: Canvas) -> str:
    ranges, (x, y, heading) = layer.ranges[-1], layer.poses[-1].tolist()
    seen = np.flatnonzero(np.isfinite(ranges) & (ranges > 0))
    seen = seen[:: -(-len(seen) // MAX_SCAN_POINTS) or 1]
    angles = heading + layer.start + layer.step * seen
    points = np.column_stack([x + ranges[seen] * np.cos(angles), y + ranges[seen] * np.sin(angles)])
    return _dots(canvas.px(points), "vermilion")


def _body(body: Body, canvas: Canvas, end: float) -> str:
    last = body.poses[int(np.searchsorted(body.times, end + 1e-9)) - 1]
    parts = []
    if body.trail and len(body.poses) > 1:
        parts.append(_path(canvas.line(body.poses[:, :2]), body.colour))
    c, s = np.cos(last[2]), np.sin(last[2])
    size = canvas.scale if body.outline is not None else 1.0
    head = np.array(body.outline if body.outline is not None else HEAD)
    pixels = snap(canvas.px(last[None, :2]) + size * _turned(head, c, s), 0.1)
    data = "M" + "L".join(f"{number(x)},{number(y)}" for x, y in pixels.tolist()) + "Z"
    edge = f"fill:{_paint(body.colour)};stroke:{variable('page')};stroke-width:1.5;stroke-linejoin:round"
    return "".join([*parts, element("path", d=data, style=edge)])


def _turned(points: Floats, c: float, s: float) -> Floats:
    """Rotate points (n, 2), x ahead and y left, and turn y down."""
    return np.column_stack([points[:, 0] * c - points[:, 1] * s, -(points[:, 0] * s + points[:, 1] * c)])
