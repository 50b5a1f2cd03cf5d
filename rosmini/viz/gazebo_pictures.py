"""A running Gazebo world from above: models that drive as named, coloured robots, the others as things."""

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

MANY = 12
"""Of more models than this only the first are named."""


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
    """Draw a world of Gazebo from above, in metres, x to the right and y up.

    Args:
        snapshot: what a server's or a client's `snapshot()` gives.
        robot: the pose that `scan`, `trail` and `odom` belong to: x [m], y [m], heading [rad]; by default that of
            `name`.
        model: what it is.
        scan: what its laser measured, as `world_picture` takes it.
        scan_from: where it was then.
        trail: where it was, (n, 2) or (n, 3).
        odom: where its odometry believes that it was, likewise.
        others: more robots.
        name: of the model that is drawn as the first robot, in blue; by default the first that drives.
        title: a caption under the picture, and the first words of its text form.
        size: the largest width and height [CSS px].

    Raises:
        ViewError: a pose, a scan or a trail is not one; the message says what is wrong with it.

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
    """The robot that is drawn first: that of the name, that at the pose, or the first there is."""
    if pose is not None:
        return next(
            (each for each in driven if each.name == name or math.dist(each.pose[:2], pose[:2]) < 1e-3), None
        )
    named = (each for each in driven if each.name == name)
    return next(named, driven[0] if driven else None)


class _Scene(Scene):
    """What there is to see in a world of Gazebo."""

    def __init__(self, snapshot: Snapshot) -> None:
        super().__init__(snapshot.world(robots=False))
        self.snapshot = snapshot
        self.alone_too = True

    def text(self, title: str | None) -> str:
        """What time it is there, and where everything is."""
        head = [f"{title or self.snapshot.title}: {when(self.snapshot)}", contents(self.world)]
        own = super().text(title).splitlines()[1:]
        return "\n".join([*head, *own, *places(self.snapshot)])

    def alt(self) -> str:
        """The same in sentences."""
        said = super().alt()
        return f"{said} It is {when(self.snapshot)}."


def when(snapshot: Snapshot) -> str:
    """What time it is there, and whether it stands."""
    return f"{fixed(snapshot.time, 2)} s{', paused' * snapshot.paused}"


def places(snapshot: Snapshot) -> list[str]:
    """A line for each model that can be moved, and one for those that stand fast."""
    lines = [f"{model.name}: pose {pose_text(model.place)}" for model in snapshot.things[:MANY]]
    if len(snapshot.things) > MANY:
        lines.append(f"and {len(snapshot.things) - MANY} more that can be moved")
    names = [model.name for model in snapshot.standing]
    more = f" and {len(names) - MANY} more" if len(names) > MANY else ""
    return [*lines, f"static: {', '.join(names[:MANY])}{more}"] if names else lines
