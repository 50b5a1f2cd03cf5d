"""Costmaps from above, in RViz's colours, with the footprint of the robot.

The cells have the colours of RViz, also on a dark page.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rosmini.core.geometry.poses import Pose, transform_points
from rosmini.navigation.costmap_2d.costmap import Costmap2D
from rosmini.navigation.costmap_2d.publisher import published_values
from rosmini.viz.figures import WIDTH, house_style, legend, legend_width
from rosmini.viz.map_colours import colours_of, painted, thinned
from rosmini.viz.rounding import fixed
from rosmini.viz.rviz.gifs import gif, gif_url
from rosmini.viz.style import LIGHT
from rosmini.viz.svg import element
from rosmini.viz.view import Picture, ViewError, matplotlib_picture
from rosmini.viz.world_drawing import draw_strokes
from rosmini.viz.world_pictures import HEIGHT, LEFT, map_axes, pose_text

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

KINDS = (
    ("free", 0, 0),
    ("near something", 1, 252),
    ("inscribed", 253, 253),
    ("obstacle", 254, 254),
    ("unknown", 255, 255),
)
"""The kinds of cost: name, lowest and highest value."""
STEADY = ("page", "vermilion", "green")
"""Colours of things drawn on a costmap, which stay the same on a dark page."""
ARROW = 22.0
"""The length of the axes at the origin [px]."""


def costmap_picture(
    grid: Costmap2D, *, robot: Pose, footprint: ArrayLike, name: str = "costmap", title: str | None = None
) -> Picture:
    """Draw a costmap in its frame, in metres, to scale.

    Args:
        grid: the costs.
        robot: its pose x [m], y [m], heading [rad] in the frame of the costmap.
        footprint: its outline (n, 2) [m] in its base frame, drawn at the robot's pose.
        name: the name of the costmap, for the text form.
        title: a caption under the picture, and the first words of its text form.

    Raises:
        ViewError: the costmap has no cells.

    """
    if not grid.costs.size:
        raise ViewError("there is nothing to draw: the costmap has no cells")
    across, up = grid.size_m
    origin = ", ".join(fixed(value, 2) for value in grid.origin)
    extent = (
        f"{grid.width} x {grid.height} cells of {grid.resolution:.4g} m, {fixed(across, 2)} x {fixed(up, 2)} m, "
        f"origin ({origin})"
    )
    outline = np.asarray(footprint, dtype=float)
    counts = ", ".join(shares(grid.costs))
    where = f"robot: pose {pose_text(robot)}, footprint of {len(outline)} points"
    alt = f"A {name} from above: {extent.replace(' x ', ' by ')}. Of its cells are {counts}. On it: {where}."
    (x0, y0), cells = grid.origin, published_values()[grid.costs].view(np.uint8)
    with house_style():
        handles = _legend(grid.costs)
        figure, axes, scale = map_axes((x0, y0, x0 + across, y0 + up), (WIDTH, HEIGHT), legend_width(handles))
        image = _cells_image(figure, axes, cells, grid)
        _draw_frame(axes, grid, scale)
        _draw_footprint(axes, robot, outline)
        legend(figure, handles, LEFT)
        text = "\n".join([f"{title or name}: {extent}", counts, where])
        return matplotlib_picture(figure, text=text, alt=alt, form="svg", caption=title, under=image, steady=STEADY)


def shares(costs: NDArray[np.uint8]) -> list[str]:
    """Return the percentage of cells of each kind of cost, in whole percent; kinds without cells are left out."""
    said = []
    for name, low, high in KINDS:
        count = int(((costs >= low) & (costs <= high)).sum())
        if count:
            percent = 100 * count / costs.size
            said.append(f"{name} {fixed(percent, 0) if percent >= 0.5 else 'under 1'}%")
    return said


def _legend(costs: NDArray[np.uint8]) -> list[Any]:
    """Return an entry of the legend for each kind of cost that occurs, and one for the footprint."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    table = colours_of("costmap")
    handles: list[Any] = []
    for name, low, high in KINDS[1:]:
        if ((costs >= low) & (costs <= high)).any():
            shown = int(published_values()[min(high, 252) if low == 1 else low]) & 0xFF
            face = "#{:02x}{:02x}{:02x}".format(*table[shown, :3].tolist())
            handles.append(Patch(facecolor=face, edgecolor=LIGHT["group-line"], label=name))
    return [*handles, Line2D([], [], color=LIGHT["ink"], linewidth=1.6, label="footprint")]


def _cells_image(figure: Figure, axes: Axes, cells: NDArray[np.uint8], grid: Costmap2D) -> str:
    """Return the cells as an SVG element, which lies below the things drawn on these axes."""
    values, _ = thinned(cells, "costmap")
    data, opacity = gif(painted(values, "costmap"))
    width, height = figure.get_size_inches() * 72
    box, (x0, x1), (y0, _) = axes.get_position(), axes.get_xlim(), axes.get_ylim()
    scale = box.width * width / (x1 - x0)
    across, up = (side * scale for side in grid.size_m)
    left = box.x0 * width + (grid.origin[0] - x0) * scale
    bottom = (1 - box.y0) * height - (grid.origin[1] - y0) * scale
    a, d, e, f = (fixed(value, 3) for value in (across, -up, left, bottom))
    return element(
        "image", href=gif_url(data), width=1, height=1,
        preserveAspectRatio="none", transform=f"matrix({a} 0 0 {d} {e} {f})",
        style="image-rendering:pixelated" if across >= values.shape[1] else None,
        opacity=None if opacity == 1 else opacity,
    )  # fmt: skip


def _draw_frame(axes: Axes, grid: Costmap2D, scale: float) -> None:
    """Draw the edge of a costmap and two short axes at its origin: x red, y green, as in RViz."""
    corners = np.array(grid.origin) + np.array([(0, 0), (1, 0), (1, 1), (0, 1)]) * grid.size_m
    draw_strokes(axes, np.stack([corners, np.roll(corners, -1, axis=0)], axis=1), "group-line", 1.0)
    for offset, colour in (((ARROW, 0.0), "vermilion"), ((0.0, ARROW), "green")):
        draw_strokes(axes, np.array([[corners[0], corners[0] + np.array(offset) / scale]]), colour, 3.0)


def _draw_footprint(axes: Axes, robot: Pose, outline: NDArray[np.float64]) -> None:
    """Draw the footprint of the robot at its pose, and a line to its front."""
    placed = transform_points(robot, outline)
    edges = np.stack([placed, np.roll(placed, -1, axis=0)], axis=1)
    nose = transform_points(robot, np.array([(0.0, 0.0), (outline[:, 0].max(), 0.0)]))
    for strokes in (edges, nose[None]):
        draw_strokes(axes, strokes, "page", 4.0)
        draw_strokes(axes, strokes, "ink", 1.6)
