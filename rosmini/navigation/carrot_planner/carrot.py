"""The carrot: the pose nearest to the goal where the footprint fits (http://wiki.ros.org/carrot_planner)."""

from __future__ import annotations

from collections.abc import Callable

from rosmini.core.geometry.angles import normalize_angle
from rosmini.core.geometry.poses import Pose

STEPS = 100
"""Number of steps from the goal back to the start."""


def nearest_legal_pose(start: Pose, goal: Pose, is_legal: Callable[[Pose], bool]) -> Pose | None:
    """Return the legal pose nearest to the goal, out of `STEPS` on the line back to the start, or None.

    The heading changes evenly along the line.
    """
    turn = normalize_angle(goal[2] - start[2])
    for step in range(STEPS + 1):
        share = 1 - step / STEPS
        pose = (
            start[0] + share * (goal[0] - start[0]),
            start[1] + share * (goal[1] - start[1]),
            normalize_angle(start[2] + share * turn),
        )
        if is_legal(pose):
            return pose
    return None
