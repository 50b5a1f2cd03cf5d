"""A carrot on a stick: from the goal back towards the robot, to where its footprint fits (http://wiki.ros.org/carrot_planner)."""

from __future__ import annotations

from collections.abc import Callable

from rosmini.geometry.angles import normalize_angle
from rosmini.geometry.poses import Pose


def carrot(
    start: Pose, goal: Pose, is_legal: Callable[[Pose], bool], step: float = 0.01
) -> tuple[Pose, bool]:
    """The pose nearest to the goal, on the line from there to the start, that is legal; and whether there is one.

    Each step takes `step` of the whole way back, in x, y and heading. If none is legal the pose is the start.
    """
    turn = normalize_angle(goal[2] - start[2])
    scale = 1.0
    while scale >= 0:
        pose = (
            start[0] + scale * (goal[0] - start[0]),
            start[1] + scale * (goal[1] - start[1]),
            normalize_angle(start[2] + scale * turn),
        )
        if is_legal(pose):
            return pose, True
        scale -= step
    return start, False
