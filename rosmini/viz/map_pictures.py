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
    pose = None if robot is None else pose_of(robot, "the robot's pose")
    dots = None if points is None else line_of(points, "points")
    line = None if path is None else line_of(path, "the path")
    cells = Cells(grid.occupancy.view(np.uint8), grid.resolution, grid.origin)
    said = _text(grid, pose, dots, line)
    with house_style():
        handles = _legend(grid, dots, line)
        corners = cells.corners()
        (x0, y0), (x1, y1) = corners.min(axis=0).tolist(), corners.max(axis=0).tolist()
        figure, axes, scale = map_axes((x0, y0, x1, y1), size, legend_width(handles))
        image = cells_image(figure, axes, cells, "map")
        draw_frame(axes, cells, scale)
        if line is not None:
            draw_trail(axes, line[:, :2], scale)
        if dots is not None:
            draw_dots(axes, dots[:, :2], "vermilion", 7.0)
        if pose is not None:
            draw_robot(axes, model, pose, scale)
        legend(figure, handles, LEFT)
        return matplotlib_picture(
            figure, text=f"{title or 'map'}: {said}", alt=_alt(grid, said), form="svg", caption=title, under=image,
            steady=STEADY,
        )  # fmt: skip


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


def cells_element(address: str, **where: str | float) -> str:
    """Return a GIF of cells as an SVG element, where cells stay rectangles, with a position and other attributes."""
    return element("image", href=address, **where, preserveAspectRatio="none", style="image-rendering:pixelated")


def draw_frame(axes: Axes, cells: Cells, scale: float) -> None:
    """Draw the edge of a grid and two short axes at its origin: x red, y green, as in RViz."""
    corners = cells.corners()
    edges = np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)
    draw_strokes(axes, edges, "group-line", 1.0)
    ends = transform_points(cells.origin, np.array([(ARROW, 0.0), (0.0, ARROW)]) / scale)
    for end, colour in zip(ends, ("vermilion", "green"), strict=True):
        draw_strokes(axes, np.array([[corners[0], end]]), colour, 3.0)


def _legend(grid: GridMap, dots: Floats | None, line: Floats | None) -> list[Any]:
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    handles: list[Any] = []
    for name, value in (("free", 0), ("occupied", 100), ("unknown", -1)):
        if (grid.occupancy == value).any():
            red, green, blue, _ = colours_of("map")[value & 0xFF].tolist()
            # pure black and pure white would follow the theme of the page
            face = f"#{min(max(red, 1), 254):02x}{min(max(green, 1), 254):02x}{min(max(blue, 1), 254):02x}"
            handles.append(Patch(facecolor=face, edgecolor=LIGHT["group-line"], label=name))
    if line is not None:
        handles.append(Line2D([], [], color=LIGHT["blue"], linewidth=TRAIL_WIDTH, label="path"))
    if dots is not None:
        marker = {"marker": "o", "markersize": 6.0, "linestyle": ""}
        handles.append(Line2D([], [], color=LIGHT["vermilion"], label="points", **marker))  # type: ignore[arg-type]
    return handles


def _text(grid: GridMap, robot: Pose | None, dots: Floats | None, line: Floats | None) -> str:
    height, width = grid.occupancy.shape
    across, up = (fixed(n * grid.resolution, 2) for n in (width, height))
    lines = [
        f"{width} x {height} cells of {grid.resolution:.4g} m, {across} x {up} m, origin {pose_text(grid.origin)}",
        ", ".join(shares(grid)),
    ]
    if line is not None:
        lines.append(f"path: {fixed(length_of(line), 2)} m")
    if dots is not None:
        places = [f"({fixed(x, 2)}, {fixed(y, 2)})" for x, y in dots[:, :2]]
        lines.append(f"points: {', '.join(places) if len(places) <= MAX_LISTED else len(places)}")
    if robot is not None:
        lines.append(f"robot: pose {pose_text(robot)}")
    return "\n".join(lines)


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


def _alt(grid: GridMap, said: str) -> str:
    lines = said.split("\n")
    rest = f" On it: {'; '.join(lines[2:])}." if lines[2:] else ""
    return f"A map from above: {lines[0].replace(' x ', ' by ')}. Of its cells are {', '.join(shares(grid))}.{rest}"
