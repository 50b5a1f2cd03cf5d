"""Headings for the points of a plan (http://wiki.ros.org/global_planner, `orientation_mode`)."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.angles import normalize_angle

NONE, FORWARD, INTERPOLATE, FORWARD_THEN_INTERPOLATE, BACKWARD, LEFTWARD, RIGHTWARD = range(7)

ROTATIONS = {FORWARD: 0.0, BACKWARD: math.pi, LEFTWARD: -math.pi / 2, RIGHTWARD: math.pi / 2}
"""Rotation of the heading relative to the path's direction."""

Poses = NDArray[np.float64]


def orient(poses: Poses, mode: int, start_yaw: float, window: int = 1) -> Poses:
    """Return the poses (n, 3) with new headings; the last one, the goal's, is kept.

    `mode` is one of the constants above; `window` is the number of points on both sides that give the path's direction.
    `INTERPOLATE` blends from `start_yaw` to the goal's heading, and `FORWARD_THEN_INTERPOLATE` does so on the last
    straight part. (The original counts from the plan's first point in this mode, so that headings jump.)
    """
    made = np.array(poses, dtype=np.float64)
    last = len(made) - 1
    if last < 1 or mode == NONE:
        return made
    if mode in ROTATIONS:
        made[:-1, 2] = normalize_angle(_path_directions(made, window)[:-1] + ROTATIONS[mode])
        return made
    begin = 0
    if mode == FORWARD_THEN_INTERPOLATE:
        made[:-1, 2] = _path_directions(made, window)[:-1]
        begin = _straight_from(made)
    made[0, 2] = start_yaw
    total = normalize_angle(made[last, 2] - made[begin, 2])
    shares = np.arange(last - begin) / (last - begin)
    made[begin:-1, 2] = normalize_angle(made[begin, 2] + total * shares)
    return made


def _path_directions(poses: Poses, window: int) -> NDArray[np.float64]:
    """Return the path's direction (n,) [rad] at each point: from the point `window` before to that `window` after."""
    index = np.arange(len(poses))
    before = np.maximum(0, index - window)
    behind = np.minimum(len(poses) - 1, index + window)
    steps = poses[behind, :2] - poses[before, :2]
    return np.asarray(np.arctan2(steps[:, 1], steps[:, 0]))


def _straight_from(poses: Poses) -> int:
    """Return the index at which the path's last straight part begins: headings within 0.35 rad of the last."""
    index = len(poses) - 3
    if index <= 0:
        return 0
    last = poses[index, 2]
    while index > 0 and abs(normalize_angle(float(poses[index - 1, 2] - last))) <= 0.35:
        index -= 1
    return index
