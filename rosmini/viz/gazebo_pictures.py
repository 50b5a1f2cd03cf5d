"""A running Gazebo world from above: robots are named and coloured, other models are drawn as objects."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

from numpy.typing import ArrayLike

from rosmini.sim.gazebo.snapshot import Robot, Snapshot
from rosmini.sim.models import RobotModel
from rosmini.sim.world import Pose
from rosmini.viz.figures import WIDTH
from rosmini.viz.rounding import fixed
from rosmini.viz.view import Picture
from rosmini.viz.world_pictures import HEIGHT, Other, Scene, contents, pose_of, pose_text

MAX_NAMED = 12
"""Maximum number of models that are named."""


def gazebo_picture(
    snapshot: Snapshot,
    *,
    robot: Sequence[float] | None = None,
    model: RobotModel | None = None,
    scan: Any = None,
    scan_from: Sequence[float] | None = None,
    trail: ArrayLike | None = None,
    odom: ArrayLike | None = None,
    others: Iterable[Other] = (),
    name: str = "",
    title: str | None = None,
    size: tuple[float, float] = (WIDTH, HEIGHT),
) -> Picture:
    """Draw a Gazebo world from above, in metres, x to the right and y up.

    Args:
        snapshot: the snapshot of a server or a client.
        robot: the pose to which `scan`, `trail` and `odom` belong: x [m], y [m], heading [rad]; by default the pose
            of `name`.
        model: the model of that robot.
        scan: a scan of its laser, in the forms that `world_picture` takes.
        scan_from: its pose when the scan was taken.
        trail: its past positions or poses, (n, 2) or (n, 3).
        odom: the same according to its odometry.
        others: further robots.
        name: the model that is drawn as the first robot, in blue; by default the first robot.
        title: a caption under the picture, and the first words of its text form.
        size: the largest width and height [CSS px].

    Raises:
        ViewError: a pose, a scan or a trail is invalid; the message says what is wrong with it.

    """
    driven = list(snapshot.robots)
    at = None if robot is None else pose_of(robot, "the robot's pose")
    first = _first(driven, at, name)
    if first is not None:
        driven.remove(first)
        at, model, name = at or first.pose, model or first.model, first.name
    beside = [Other(each.name, each.model, each.pose) for each in driven]
    scene = _Scene(snapshot)
    scene.fill(
        robot=at, model=model, scan=scan, scan_from=scan_from, trail=trail, odom=odom,
        others=[*beside, *others], name=name,
    )  # fmt: skip
    return scene.picture(title, size)


def _first(driven: list[Robot], pose: Pose | None, name: str) -> Robot | None:
    """Return the robot that is drawn first: the one with this name, the one at this pose, or the first in the list."""
    if pose is not None:
        return next((each for each in driven if each.name == name or math.dist(each.pose[:2], pose[:2]) < 1e-3), None)
    named = (each for each in driven if each.name == name)
    return next(named, driven[0] if driven else None)


class _Scene(Scene):
    """The contents of a Gazebo world."""

    def __init__(self, snapshot: Snapshot) -> None:
        super().__init__(snapshot.world(robots=False))
        self.snapshot = snapshot
        self.alone_too = True

    def text(self, title: str | None) -> str:
        """The time in the world, and the position of everything."""
        head = [f"{title or self.snapshot.title}: {time_text(self.snapshot)}", contents(self.world)]
        own = super().text(title).splitlines()[1:]
        return "\n".join([*head, *own, *pose_lines(self.snapshot)])

    def alt(self) -> str:
        """The same as sentences."""
        said = super().alt()
        return f"{said} It is {time_text(self.snapshot)}."


def time_text(snapshot: Snapshot) -> str:
    """Return the time in the world, and whether it is paused."""
    return f"{fixed(snapshot.time, 2)} s{', paused' * snapshot.paused}"


def pose_lines(snapshot: Snapshot) -> list[str]:
    """Return a line for each movable model, and one for the static ones."""
    lines = [f"{model.name}: pose {pose_text(model.place)}" for model in snapshot.things[:MAX_NAMED]]
    if len(snapshot.things) > MAX_NAMED:
        lines.append(f"and {len(snapshot.things) - MAX_NAMED} more that can be moved")
    names = [model.name for model in snapshot.standing]
    more = f" and {len(names) - MAX_NAMED} more" if len(names) > MAX_NAMED else ""
    return [*lines, f"static: {', '.join(names[:MAX_NAMED])}{more}"] if names else lines
