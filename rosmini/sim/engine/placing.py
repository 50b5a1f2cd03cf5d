"""Check whether a robot has room at a pose."""

from __future__ import annotations

import math
from collections.abc import Callable

from rosmini.core.geometry.poses import Pose
from rosmini.sim.models import RobotModel
from rosmini.sim.world import World, WorldError


def free_pose(
    world: World,
    model: RobotModel,
    pose: Pose,
    obstruction: Callable[[Pose], str | None],
    taken: Callable[[Pose], str | None],
) -> Pose:
    """Return `pose` as floats if a robot of this model has room there.

    `obstruction(pose)` describes the object in the way, and `taken(pose)` does the same for movable bodies. Raises
    `WorldError` if there is no room, with the nearest free position, and if a number is not finite.
    """
    if not all(math.isfinite(part) for part in pose):
        raise WorldError(f"a robot cannot be placed at {pose}: x, y and heading must be finite numbers")
    x, y, theta = map(float, pose)
    found = obstruction(pose)
    if found is not None:
        free = world.free_place(pose, model.footprint, model.height, taken)
        hint = "" if free is None else f". There is room at ({free[0]:.2f}, {free[1]:.2f})"
        where = f"({x:.2f}, {y:.2f}) with heading {theta:.2f} in the world {world.name!r}"
        raise WorldError(f"no robot can be placed at {where}: {found} is in its way{hint}")
    return x, y, theta
