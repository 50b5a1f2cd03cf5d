"""Costmaps from above, in RViz's colours, with an optional robot, footprint, plan and goal."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rosmini.navigation.costmap_2d.costmap import Costmap2D
from rosmini.navigation.costmap_2d.publisher import published_values
from rosmini.sim.models import BURGER, RobotModel
from rosmini.viz.figures import WIDTH
from rosmini.viz.map_colours import colours_of
from rosmini.viz.map_pictures import Cells, Marks, cells_picture
from rosmini.viz.rounding import fixed
from rosmini.viz.style import LIGHT
from rosmini.viz.view import Picture, ViewError
from rosmini.viz.world_pictures import HEIGHT

Floats = NDArray[np.float64]

KINDS = (
    ("free", 0, 0),
    ("near something", 1, 252),
    ("inscribed", 253, 253),
    ("obstacle", 254, 254),
    ("unknown", 255, 255),
)
"""The kinds of cost: name, lowest and highest value."""


def costmap_picture(
    grid: Costmap2D,
    *,
    robot: Sequence[float] | None = None,
    model: RobotModel = BURGER,
    footprint: ArrayLike | None = None,
    plan: ArrayLike | None = None,
    goal: Sequence[float] | None = None,
    window: Sequence[int] | None = None,
    scheme: str = "costmap",
    name: str = "costmap",
    title: str | None = None,
    size: tuple[float, float] = (WIDTH, HEIGHT),
) -> Picture:
    """Draw a costmap in its frame, in metres, to scale.

    Args:
        grid: the costs.
        robot: its pose x [m], y [m], heading [rad] in the frame of the costmap.
        model: the robot's model.
        footprint: its outline (n, 2) [m] in its base frame, drawn at the robot's pose.
        plan: a path (n, 2) or (n, 3) [m].
        goal: a point or a pose [m].
        window: show only these cells: first column, first row, and the column and row after the last.
        scheme: "costmap", RViz's colours, or "safe", which colour-blind people can distinguish.
        name: the name of the costmap, for the text form.
        title: a caption under the picture, and the first words of its text form.
        size: the largest width and height [CSS px].

    Raises:
        ViewError: `grid` is not a costmap, or something to be drawn on it is invalid; the message says what is wrong.

    """
    cells = cells_of(grid, window)
    marks = Marks(
        robot, plan, None if goal is None else [list(goal)], footprint=footprint, model=model,
        words=("plan", "goal"), colours=("green", "green"), sizes=(9.0, 7.0),
    )  # fmt: skip
    origin = f"({fixed(cells.origin[0], 2)}, {fixed(cells.origin[1], 2)})"
    return cells_picture(
        cells, shares(cells.values), marks, _swatches(cells, scheme), origin=origin, title=title, size=size,
        name=name, scheme=scheme, shown=published(cells.values),
    )  # fmt: skip


def cells_of(grid: Costmap2D, window: Sequence[int] | None = None) -> Cells:
    """Return the costs of a costmap, or of a window of it, and their position. Raises `ViewError`."""
    if not isinstance(grid, Costmap2D):
        raise ViewError(f"a costmap must be a Costmap2D, not a {type(grid).__name__}; for a Costmap2DROS, use its grid")
    if window is None:
        window = (0, 0, grid.width, grid.height)
    x0, y0, xn, yn = (int(value) for value in window)
    x0, y0, xn, yn = max(x0, 0), max(y0, 0), min(xn, grid.width), min(yn, grid.height)
    if xn <= x0 or yn <= y0:
        raise ViewError(
            f"there is nothing to draw: the costmap has {grid.width} x {grid.height} cells, and the window is "
            f"{tuple(window)} (first column, first row, and the column and row after the last)"
        )
    origin = grid.origin[0] + x0 * grid.resolution, grid.origin[1] + y0 * grid.resolution
    return Cells(grid.costs[y0:yn, x0:xn], grid.resolution, (*origin, 0.0))


def published(costs: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Return costs (h, w) as the bytes of the message that RViz receives."""
    return published_values()[costs].view(np.uint8)


def shares(costs: NDArray[np.uint8]) -> list[str]:
    """Return the percentage of cells of each kind of cost, in whole percent; kinds without cells are left out."""
    said = []
    for name, low, high in KINDS:
        count = int(((costs >= low) & (costs <= high)).sum())
        if count:
            percent = 100 * count / costs.size
            said.append(f"{name} {fixed(percent, 0) if percent >= 0.5 else 'under 1'} %")
    return said


def _swatches(cells: Cells, scheme: str) -> list[Any]:
    """Return a legend patch for each kind of cost that occurs."""
    from matplotlib.patches import Patch

    table = colours_of(scheme)
    handles: list[Any] = []
    for name, low, high in KINDS[1:]:
        if ((cells.values >= low) & (cells.values <= high)).any():
            shown = int(published_values()[min(high, 252) if low == 1 else low]) & 0xFF
            face = "#{:02x}{:02x}{:02x}".format(*table[shown, :3].tolist())
            handles.append(Patch(facecolor=face, edgecolor=LIGHT["group-line"], label=name))
    return handles
