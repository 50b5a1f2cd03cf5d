"""Costmaps from above, in RViz's colours, with an optional robot, footprint, plan and goal."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rosmini.core.geometry.poses import Pose, transform_points
from rosmini.navigation.costmap_2d.costmap import Costmap2D
from rosmini.navigation.costmap_2d.publisher import published_values
from rosmini.sim.models import BURGER, RobotModel
from rosmini.viz.figures import WIDTH, house_style, legend, legend_width
from rosmini.viz.map_colours import colours_of
from rosmini.viz.map_pictures import STEADY, Cells, cells_image, draw_frame
from rosmini.viz.rounding import fixed
from rosmini.viz.style import LIGHT
from rosmini.viz.view import Picture, ViewError, matplotlib_picture
from rosmini.viz.world_drawing import TRAIL_WIDTH, draw_dots, draw_robot, draw_strokes, draw_trail
from rosmini.viz.world_pictures import HEIGHT, LEFT, length_of, line_of, map_axes, pose_of, pose_text

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
    scene = _Scene(
        pose=None if robot is None else pose_of(robot, "the robot's pose"),
        outline=None if footprint is None else line_of(footprint, "the footprint"),
        plan=None if plan is None else line_of(plan, "the plan"),
        goal=None if goal is None else line_of([list(goal)], "the goal"),
    )
    said = _text(cells, scene)
    with house_style():
        handles = [*_swatches(cells, scheme), *scene.legend()]
        corners = cells.corners()
        (x0, y0), (x1, y1) = corners.min(axis=0).tolist(), corners.max(axis=0).tolist()
        figure, axes, scale = map_axes((x0, y0, x1, y1), size, legend_width(handles))
        image = cells_image(figure, axes, Cells(published(cells.values), *cells[1:]), scheme)
        draw_frame(axes, cells, scale)
        scene.draw(axes, model, scale)
        legend(figure, handles, LEFT)
        return matplotlib_picture(
            figure, text=f"{title or name}: {said}", alt=_alt(cells, scene, name), form="svg", caption=title,
            under=image, steady=STEADY,
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


class _Scene:
    """The things drawn on top of the costs."""

    def __init__(self, pose: Pose | None, outline: Floats | None, plan: Floats | None, goal: Floats | None) -> None:
        self.pose, self.plan, self.goal = pose, plan, goal
        self.outline = None if pose is None or outline is None or len(outline) < 3 else outline

    def draw(self, axes: Any, model: RobotModel, scale: float) -> None:
        if self.plan is not None:
            draw_trail(axes, self.plan[:, :2], scale, colour="green")
        if self.goal is not None:
            draw_dots(axes, self.goal[:, :2], "green", 9.0)
        if self.pose is not None:
            if self.outline is None:
                draw_robot(axes, model, self.pose, scale)
                return
            placed = transform_points(self.pose, self.outline[:, :2])
            draw_strokes(axes, np.stack([placed, np.roll(placed, -1, axis=0)], axis=1), "page", 4.0)
            draw_strokes(axes, np.stack([placed, np.roll(placed, -1, axis=0)], axis=1), "ink", 1.6)
            nose = transform_points(self.pose, np.array([(0.0, 0.0), (self.outline[:, 0].max(), 0.0)]))
            draw_strokes(axes, nose[None], "page", 4.0)
            draw_strokes(axes, nose[None], "ink", 1.6)

    def legend(self) -> list[Any]:
        from matplotlib.lines import Line2D

        handles: list[Any] = []
        if self.plan is not None:
            handles.append(Line2D([], [], color=LIGHT["green"], linewidth=TRAIL_WIDTH, label="plan"))
        if self.goal is not None:
            handles.append(Line2D([], [], color=LIGHT["green"], marker="o", markersize=7.0, linestyle="", label="goal"))
        if self.outline is not None:
            handles.append(Line2D([], [], color=LIGHT["ink"], linewidth=1.6, label="footprint"))
        return handles

    def said(self) -> list[str]:
        lines = []
        if self.plan is not None:
            lines.append(f"plan: {fixed(length_of(self.plan), 2)} m")
        if self.goal is not None:
            lines.append(f"goal: ({fixed(self.goal[0, 0], 2)}, {fixed(self.goal[0, 1], 2)})")
        if self.pose is not None:
            outline = f", footprint of {len(self.outline)} points" if self.outline is not None else ""
            lines.append(f"robot: pose {pose_text(self.pose)}{outline}")
        return lines


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


def _text(cells: Cells, scene: _Scene) -> str:
    height, width = cells.values.shape
    across, up = (fixed(n * cells.resolution, 2) for n in (width, height))
    origin = f"({fixed(cells.origin[0], 2)}, {fixed(cells.origin[1], 2)})"
    return "\n".join(
        [
            f"{width} x {height} cells of {cells.resolution:.4g} m, {across} x {up} m, origin {origin}",
            ", ".join(shares(cells.values)),
            *scene.said(),
        ]
    )


def _alt(cells: Cells, scene: _Scene, name: str) -> str:
    size = _text(cells, scene).split("\n")[0].replace(" x ", " by ")
    rest = f" On it: {'; '.join(scene.said())}." if scene.said() else ""
    return f"A {name} from above: {size}. Of its cells are {', '.join(shares(cells.values))}.{rest}"
