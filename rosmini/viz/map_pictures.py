"""A map from above: free, occupied and unknown cells, in metres, with an optional robot, points and a path.

Its cells have the colours of RViz, also on a dark page, since white and black have a meaning.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rosmini.core.geometry.poses import Pose, transform_points
from rosmini.core.maps import GridMap
from rosmini.sim.models import BURGER, RobotModel
from rosmini.viz.figures import WIDTH, house_style, legend, legend_width
from rosmini.viz.map_colours import colours_of, painted, thinned
from rosmini.viz.rounding import fixed
from rosmini.viz.rviz.gifs import gif, gif_url
from rosmini.viz.style import LIGHT
from rosmini.viz.svg import element
from rosmini.viz.view import Picture, ViewError, matplotlib_picture
from rosmini.viz.world_drawing import TRAIL_WIDTH, draw_dots, draw_robot, draw_strokes, draw_trail
from rosmini.viz.world_pictures import HEIGHT, LEFT, length_of, line_of, map_axes, pose_of, pose_text

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Floats = NDArray[np.float64]
Bytes = NDArray[np.uint8]

STEADY = ("page", "blue", "vermilion", "green")
"""Colours of things drawn on a map, which also stay the same on a dark page."""
ARROW = 22.0
"""The length of the axes at a map's origin [px]."""
MAX_LISTED = 6
"""Maximum number of points that are listed one by one."""


class Cells(NamedTuple):
    """Cells as bytes (h, w), the first row at the origin; the side of a cell [m], and the pose of the grid's corner."""

    values: Bytes
    resolution: float
    origin: Pose

    def corners(self) -> Floats:
        """Return the corners (4, 2) of the grid, counter-clockwise from the origin."""
        height, width = self.values.shape
        unit = np.array([(0, 0), (width, 0), (width, height), (0, height)], dtype=float)
        return transform_points(self.origin, unit * self.resolution)


def map_picture(
    grid: GridMap,
    *,
    robot: Sequence[float] | None = None,
    model: RobotModel = BURGER,
    points: ArrayLike | None = None,
    path: ArrayLike | None = None,
    title: str | None = None,
    size: tuple[float, float] = (WIDTH, HEIGHT),
) -> Picture:
    """Draw a map in its frame, in metres, to scale.

    Args:
        grid: the map.
        robot: a robot's x [m], y [m] and heading [rad] in the frame of the map.
        model: the robot's model.
        points: positions (n, 2) [m] to mark with dots.
        path: a line (n, 2) or (n, 3) [m].
        title: a caption under the picture, and the first words of its text form.
        size: the largest width and height [CSS px].

    Raises:
        ViewError: it is not a map, or a pose, points or a path are invalid; the message says what is wrong.

    """
    if not isinstance(grid, GridMap):
        raise ViewError(f"a map must be a GridMap, not a {type(grid).__name__}: use load_map or GridMap.from_message")
    marks = Marks(robot, path, points, model=model)
    cells = Cells(grid.occupancy.view(np.uint8), grid.resolution, grid.origin)
    origin = pose_text(grid.origin)
    return cells_picture(cells, shares(grid), marks, _swatches(grid), origin=origin, title=title, size=size)


class Marks:
    """A robot, its footprint, a line and dots that are drawn on a map or a costmap. Raises `ViewError`."""

    def __init__(
        self, robot: Sequence[float] | None, line: ArrayLike | None, dots: ArrayLike | None, *,
        footprint: ArrayLike | None = None, model: RobotModel = BURGER, words: tuple[str, str] = ("path", "points"),
        colours: tuple[str, str] = ("blue", "vermilion"), sizes: tuple[float, float] = (7.0, 6.0),
    ) -> None:  # fmt: skip
        self.pose = None if robot is None else pose_of(robot, "the robot's pose")
        self.line = None if line is None else line_of(line, f"the {words[0]}")
        self.dots = None if dots is None else line_of(dots, f"the {words[1]}")
        self.model, self.words, self.colours, self.sizes = model, words, colours, sizes
        outline = None if footprint is None else line_of(footprint, "the footprint")
        self.outline = None if self.pose is None or outline is None or len(outline) < 3 else outline

    def draw(self, axes: Axes, scale: float) -> None:
        """Draw everything."""
        if self.line is not None:
            draw_trail(axes, self.line[:, :2], scale, colour=self.colours[0])
        if self.dots is not None:
            draw_dots(axes, self.dots[:, :2], self.colours[1], self.sizes[0])
        if self.pose is None:
            return
        if self.outline is None:
            draw_robot(axes, self.model, self.pose, scale)
            return
        placed = transform_points(self.pose, self.outline[:, :2])
        edges = np.stack([placed, np.roll(placed, -1, axis=0)], axis=1)
        nose = transform_points(self.pose, np.array([(0.0, 0.0), (self.outline[:, 0].max(), 0.0)]))
        for strokes in (edges, nose[None]):
            draw_strokes(axes, strokes, "page", 4.0)
            draw_strokes(axes, strokes, "ink", 1.6)

    def legend(self) -> list[Any]:
        """Return the entries of the legend."""
        from matplotlib.lines import Line2D

        colours = [LIGHT[colour] for colour in self.colours]
        handles: list[Any] = []
        if self.line is not None:
            handles.append(Line2D([], [], color=colours[0], linewidth=TRAIL_WIDTH, label=self.words[0]))
        if self.dots is not None:
            dot: dict[str, Any] = {"marker": "o", "markersize": self.sizes[1], "linestyle": ""}
            handles.append(Line2D([], [], color=colours[1], label=self.words[1], **dot))
        if self.outline is not None:
            handles.append(Line2D([], [], color=LIGHT["ink"], linewidth=1.6, label="footprint"))
        return handles

    def lines(self) -> list[str]:
        """Return a line of text for each."""
        lines = []
        if self.line is not None:
            lines.append(f"{self.words[0]}: {fixed(length_of(self.line), 2)} m")
        if self.dots is not None:
            places = [f"({fixed(x, 2)}, {fixed(y, 2)})" for x, y in self.dots[:, :2]]
            lines.append(f"{self.words[1]}: {', '.join(places) if len(places) <= MAX_LISTED else len(places)}")
        if self.pose is not None:
            outline = f", footprint of {len(self.outline)} points" if self.outline is not None else ""
            lines.append(f"robot: pose {pose_text(self.pose)}{outline}")
        return lines


def cells_picture(
    cells: Cells, shares: Sequence[str], marks: Marks, swatches: Sequence[Any], *, origin: str,
    title: str | None, size: tuple[float, float], name: str = "map", scheme: str = "map", shown: Bytes | None = None,
) -> Picture:  # fmt: skip
    """Draw cells, or what is `shown` in their place, with marks on them. Raises `ViewError`."""
    height, width = cells.values.shape
    across, up = (fixed(n * cells.resolution, 2) for n in (width, height))
    extent = f"{width} x {height} cells of {cells.resolution:.4g} m, {across} x {up} m, origin {origin}"
    lines = marks.lines()
    text = "\n".join([f"{title or name}: {extent}", ", ".join(shares), *lines])
    rest = f" On it: {'; '.join(lines)}." if lines else ""
    alt = f"A {name} from above: {extent.replace(' x ', ' by ')}. Of its cells are {', '.join(shares)}.{rest}"
    with house_style():
        handles = [*swatches, *marks.legend()]
        corners = cells.corners()
        (x0, y0), (x1, y1) = corners.min(axis=0).tolist(), corners.max(axis=0).tolist()
        figure, axes, scale = map_axes((x0, y0, x1, y1), size, legend_width(handles))
        drawn = cells if shown is None else Cells(shown, cells.resolution, cells.origin)
        image = cells_image(figure, axes, drawn, scheme)
        draw_frame(axes, cells, scale)
        marks.draw(axes, scale)
        legend(figure, handles, LEFT)
        return matplotlib_picture(figure, text=text, alt=alt, form="svg", caption=title, under=image, steady=STEADY)


def cells_image(figure: Figure, axes: Axes, cells: Cells, scheme: str) -> str:
    """Return the cells as an SVG element, which lies below the things drawn on these axes."""
    values, _ = thinned(cells.values, scheme)
    data, opacity = gif(painted(values, scheme))
    width, height = figure.get_size_inches() * 72
    box, (x0, x1), (_, y1) = axes.get_position(), axes.get_xlim(), axes.get_ylim()
    left, top = box.x0 * width, (1 - box.y1) * height
    scale = box.width * width / (x1 - x0)
    origin, right, _, up = cells.corners() * (scale, -scale) + (left - x0 * scale, top + y1 * scale)
    pixelated = np.abs(right - origin).max() >= values.shape[1]  # otherwise walls may be left out
    a, b, c, d, e, f = (fixed(value, 3) for value in (*(right - origin), *(up - origin), *origin))
    return element(
        "image", href=gif_url(data), width=1, height=1,
        preserveAspectRatio="none", transform=f"matrix({a} {b} {c} {d} {e} {f})",
        style="image-rendering:pixelated" if pixelated else None, opacity=None if opacity == 1 else opacity,
    )  # fmt: skip


def draw_frame(axes: Axes, cells: Cells, scale: float) -> None:
    """Draw the edge of a grid and two short axes at its origin: x red, y green, as in RViz."""
    corners = cells.corners()
    edges = np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)
    draw_strokes(axes, edges, "group-line", 1.0)
    ends = transform_points(cells.origin, np.array([(ARROW, 0.0), (0.0, ARROW)]) / scale)
    for end, colour in zip(ends, ("vermilion", "green"), strict=True):
        draw_strokes(axes, np.array([[corners[0], end]]), colour, 3.0)


def _swatches(grid: GridMap) -> list[Any]:
    from matplotlib.patches import Patch

    handles: list[Any] = []
    for name, value in (("free", 0), ("occupied", 100), ("unknown", -1)):
        if (grid.occupancy == value).any():
            red, green, blue, _ = colours_of("map")[value & 0xFF].tolist()
            # pure black and pure white would follow the theme of the page
            face = f"#{min(max(red, 1), 254):02x}{min(max(green, 1), 254):02x}{min(max(blue, 1), 254):02x}"
            handles.append(Patch(facecolor=face, edgecolor=LIGHT["group-line"], label=name))
    return handles


def shares(grid: GridMap) -> list[str]:
    """Return the percentages of free, occupied, unknown and other cells."""
    counts = {
        "free": int(grid.free.sum()),
        "occupied": int((grid.occupancy == 100).sum()),
        "unknown": int(grid.unknown.sum()),
    }
    counts["between"] = grid.occupancy.size - sum(counts.values())
    named = ((name, count) for name, count in counts.items() if count or name != "between")
    return [f"{name} {fixed(100 * count / grid.occupancy.size, 1)} %" for name, count in named]
