"""A world from above: walls and obstacles, with an optional robot, its laser scan, and its path."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.poses import Pose, compose, inverse
from rosmini.core.geometry.products import norms
from rosmini.sim.models import BURGER, RobotModel
from rosmini.sim.world import Obstacle, World
from rosmini.viz.beams import Beams
from rosmini.viz.figures import MAX_SIZE, add_axes, blank_figure, house_style, legend, legend_width, set_ticks, step_of
from rosmini.viz.rounding import degrees, fixed
from rosmini.viz.style import LIGHT
from rosmini.viz.view import Picture, ViewError, matplotlib_picture
from rosmini.viz.world_drawing import (
    DASHES,
    TRAIL_WIDTH,
    draw_former_place,
    draw_moved_path,
    draw_name,
    draw_robot,
    draw_scan,
    draw_start,
    draw_trail,
    draw_world,
    name_box,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Floats = NDArray[np.float64]
Bounds = tuple[float, float, float, float]

LEFT, RIGHT, TOP, LEGEND, BOTTOM = 46.0, 8.0, 8.0, 28.0, 40.0
"""The margins around a map [px]; LEGEND is added to TOP."""
HEIGHT = 540.0
MIN_SIZE = 200.0
"""Minimum width and height of a picture [px]."""
MIN_ASPECT = 0.2
"""Minimum ratio of the shorter side to the longer side of the visible area."""


COLOURS = ("green", "purple", "sky", "vermilion", "orange")
"""Colours of robots other than the first one, which is blue."""


@dataclass(frozen=True)
class Other:
    """Another robot in a picture."""

    name: str
    model: RobotModel
    pose: Pose
    trail: Floats | None = None
    """Past positions, (n, 2) or (n, 3)."""


def colour_of(number: int) -> str:
    """Return the colour of the other robot with this index."""
    return COLOURS[number % len(COLOURS)]


class Scene:
    """The contents of a picture of a world, with its drawing and its texts."""

    def __init__(self, world: World, model: RobotModel = BURGER) -> None:
        self.world = world
        self.model = model
        self.robot: Pose | None = None
        self.ghost: Pose | None = None
        """The robot's pose according to odometry."""
        self.beams: Beams | None = None
        self.laser: Pose = (0.0, 0.0, 0.0)
        self.trail: Floats | None = None
        self.odom: Floats | None = None
        self.name = ""
        """The robot's name, used if there are others."""
        self.alone_too = False
        """True to use its name even if there are no others."""
        self.others: list[Other] = []
        self.former_places: list[Obstacle] = []
        """Objects at their places before they were moved."""
        self.moved_paths: list[tuple[Floats, str]] = []
        """Paths of moved objects, (n, 2), and their colours."""

    def add_scan(self, beams: Beams, robot: Pose, each: Floats | None) -> None:
        """Add the scan of a robot at the pose `robot`, or with one of the poses `each` (beams, 3) per beam."""
        self.laser = laser_pose(robot, self.model)
        x, y, _ = self.model.laser.mount
        starts = None if each is None else compose(inverse(self.laser), compose(each, (x, y, 0.0)))
        self.beams = replace(beams, starts=starts)

    def picture(self, title: str | None, size: tuple[float, float]) -> Picture:
        """Return the drawing."""
        with house_style():
            handles = self._legend()
            figure, axes, scale = map_axes(self.bounds(), size, legend_width(handles))
            self._draw(axes, scale)
            legend(figure, handles, LEFT)
            return matplotlib_picture(
                figure, text=self.text(title), alt=self.alt(), form="svg", caption=title, adapt=True
            )

    def _draw(self, axes: Axes, scale: float) -> None:
        draw_world(axes, self.world, scale)
        for place_ in self.former_places:
            draw_former_place(axes, place_)
        for way, colour in self.moved_paths:
            draw_moved_path(axes, way, colour, scale)
        if self.beams is not None:
            draw_scan(axes, self.beams, self.laser, scale)
        if self.trail is not None:
            draw_trail(axes, self.trail[:, :2], scale)
            draw_start(axes, self.trail[0, :2], scale)
        if self.odom is not None:
            draw_trail(axes, self.odom[:, :2], scale, colour="orange", dashed=True)
        if self.ghost is not None:
            draw_robot(axes, self.model, self.ghost, scale, ghost=True)
        for i, other in enumerate(self.others):
            colour = colour_of(i)
            if other.trail is not None:
                draw_trail(axes, other.trail[:, :2], scale, colour=colour)
                draw_start(axes, other.trail[0, :2], scale, colour=colour)
        for i, other in enumerate(self.others):
            draw_robot(axes, other.model, other.pose, scale, colour=colour_of(i))
        if self.robot is not None:
            draw_robot(axes, self.model, self.robot, scale)
        self._draw_names(axes, scale)

    def _draw_names(self, axes: Axes, scale: float) -> None:
        """Draw the robots' names, if there are several; of overlapping ones only the first."""
        named = [(other.name, other.model, other.pose, colour_of(i)) for i, other in enumerate(self.others)]
        if (named or self.alone_too) and self.name and self.robot is not None:
            named.insert(0, (self.name, self.model, self.robot, "blue"))
        written: list[Bounds] = []
        for name, model, pose, colour in named:
            for above in (False, True):
                x0, y0, x1, y1 = box = name_box(model, pose, name, scale, above=above)
                if all(x1 < a or c < x0 or y1 < b or d < y0 for a, b, c, d in written):
                    draw_name(axes, model, pose, name, colour, scale, above=above)
                    written.append(box)
                    break

    def _legend(self) -> list[Any]:
        from matplotlib.lines import Line2D

        def line(label: str, colour: str, **options: Any) -> Line2D:
            return Line2D([], [], color=LIGHT[colour], linewidth=TRAIL_WIDTH, label=label, **options)

        handles: list[Any] = []
        if self.trail is not None:
            handles.append(line("where it was", "blue"))
        if self.odom is not None:
            handles.append(line("where odometry believes it was", "orange", dashes=DASHES))
        if self.beams is not None:
            handles.append(line("laser hits", "vermilion", marker="o", markersize=3.2, linestyle=""))
        return handles

    def bounds(self) -> Bounds:
        """Return the visible rectangle: the world, the robot, its trails and the hits of its laser."""
        x0, y0, x1, y1 = self.world.bounds
        points = [np.array([(x0, y0), (x1, y1)])]
        for pose in (self.robot, self.ghost):
            if pose is not None:
                points += [np.array([pose[:2]]) - self.model.reach, np.array([pose[:2]]) + self.model.reach]
        points += [line[:, :2] for line in (self.trail, self.odom) if line is not None]
        for other in self.others:
            points += [np.array([other.pose[:2]]) + side * other.model.reach for side in (-1, 1)]
            points += [] if other.trail is None else [other.trail[:, :2]]
        if self.beams is not None and self.beams.hits.any():
            reach = self.beams.ranges[self.beams.hits]
            heading = self.beams.angles[self.beams.hits] + self.laser[2]
            points.append(self.laser[:2] + np.column_stack([reach * np.cos(heading), reach * np.sin(heading)]))
        every = np.vstack(points)
        # contents outside the world widen the view in steps of 10 cm, which rounding errors do not affect
        low = np.floor(every.min(axis=0) * 10 + 0.01237) / 10
        high = np.ceil(every.max(axis=0) * 10 - 0.01237) / 10
        return (float(min(low[0], x0)), float(min(low[1], y0)), float(max(high[0], x1)), float(max(high[1], y1)))

    def text(self, title: str | None) -> str:
        """Return a line for each thing that is drawn."""
        lines = [f"{title or f'world {self.world.name}'}: {contents(self.world)}"]
        if self.robot is not None:
            named = self.name and (self.others or self.alone_too)
            lines.append(f"{self.name if named else self.model.name}: pose {pose_text(self.robot)}")
        for other in self.others:
            kind = f" ({other.model.name})" if other.model.name != other.name else ""
            lines.append(f"{other.name}{kind}: pose {pose_text(other.pose)}")
        if self.beams is not None:
            lines.append(f"scan: {self.beams.text()}")
        return "\n".join(lines)

    def alt(self) -> str:
        """Return a sentence for each important thing."""
        said = [f"The world {self.world.name} from above: {contents(self.world, ' by ')}."]
        if self.robot is not None:
            x, y, heading = self.robot
            said.append(f"The robot is at x {fixed(x, 2)} m, y {fixed(y, 2)} m, heading {degrees(heading, 0)} degrees.")
        if self.others:
            said.append(_others_sentence(self.others))
        if self.beams is not None:
            said.append(_sentence(self.beams.clause()))
        return " ".join(said)


def _others_sentence(others: list[Other]) -> str:
    """Describe where the other robots are; of many, only their number."""
    if len(others) > 6:
        return f"There are {len(others)} more robots, each in a colour of its own."
    places = [f"{o.name} at x {fixed(o.pose[0], 2)} m, y {fixed(o.pose[1], 2)} m" for o in others]
    return f"Beside it there {'is' if len(places) == 1 else 'are'} {', '.join(places)}."


def laser_pose(robot: Pose, model: RobotModel) -> Pose:
    """Return the pose of the laser of a robot at the pose `robot`."""
    x, y, _ = model.laser.mount
    return compose(robot, (x, y, 0.0))


def map_axes(bounds: Bounds, size: tuple[float, float], legend_width: float) -> tuple[Figure, Axes, float]:
    """Return a figure with axes in metres, equal in x and y, a grid, and room for a legend; and pixels per metre."""
    for side in size:
        if not MIN_SIZE <= side <= MAX_SIZE:
            raise ViewError(f"the size of a picture must be {MIN_SIZE:g} to {MAX_SIZE:g} pixels, not {side}")
    x0, y0, x1, y1 = bounds
    extent = max(x1 - x0, y1 - y0, 1.0)
    x0, x1 = _axis_limits(x0, x1, extent)
    y0, y1 = _axis_limits(y0, y1, extent)
    top = TOP + (LEGEND if legend_width else 0.0)
    scale = min((size[0] - LEFT - RIGHT) / (x1 - x0), (size[1] - top - BOTTOM) / (y1 - y0))
    width, height = (x1 - x0) * scale, (y1 - y0) * scale
    figure = blank_figure(
        math.ceil(max(width + RIGHT, legend_width, MIN_SIZE - LEFT) + LEFT), math.ceil(height + top + BOTTOM)
    )
    axes = add_axes(figure, LEFT, top, width, height)
    axes.set(xlim=(x0, x1), ylim=(y0, y1), xlabel="x [m]", ylabel="y [m]")
    step = 1.0 if 2.0 <= extent <= 14.0 else step_of(extent, 10)
    for axis, low, high in ((axes.xaxis, x0, x1), (axes.yaxis, y0, y1)):
        set_ticks(axis, low, high, step)
    return figure, axes, scale


def _axis_limits(low: float, high: float, extent: float) -> tuple[float, float]:
    """Return the limits of an axis: its contents, with a margin, and not too narrow."""
    spare = max(0.0, MIN_ASPECT * extent - (high - low)) / 2 + 0.02 * extent
    return low - spare, high + spare


def contents(world: World, by: str = " x ") -> str:
    """Describe the size of a world and its contents."""
    x0, y0, x1, y1 = world.bounds
    size = f"{fixed(x1 - x0, 2)}{by}{fixed(y1 - y0, 2)} m"
    walls = sum(o.colour == "wall" for o in world.obstacles)
    movable = sum(o.movable for o in world.obstacles)
    moving = sum(o.motion is not None for o in world.obstacles)
    others = len(world.obstacles) - walls
    parts = [_count(len(world.walls), "wall segment"), _count(walls, "wall")]
    obstacles = _count(others, "obstacle")
    alone = "moves by itself" if moving == 1 else "move by themselves"
    said = [(count, verb) for count, verb in ((movable, "can be pushed"), (moving, alone)) if count]
    if said and others == 1:
        obstacles += f" ({said[0][1]})"
    elif said:
        obstacles += f" ({', '.join(f'{count} of them {verb}' for count, verb in said)})"
    parts = [part for part in (*parts, obstacles) if part]
    if not parts:
        return f"{size}, nothing in it"
    return f"{size}, {', '.join(parts[:-1])}{' and ' if len(parts) > 1 else ''}{parts[-1]}"


def _count(count: int, noun: str) -> str:
    return "" if not count else f"{count} {noun}{'' if count == 1 else 's'}"


def _sentence(clause: str) -> str:
    return clause[0].upper() + clause[1:] + "."


def pose_text(pose: Sequence[float]) -> str:
    """Return a pose as `(1.20, 0.40, 90.0 deg)`."""
    return f"({fixed(pose[0], 2)}, {fixed(pose[1], 2)}, {degrees(pose[2])} deg)"


def length_of(line: Floats) -> float:
    """Return the length [m] of a line (n, 2) or (n, 3)."""
    return float(norms(np.diff(line[:, :2], axis=0)).sum())
