"""Poses in space: six numbers as SDF writes them, and 4 x 4 matrices to compute with."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.products import matrix_product
from rosmini.core.tf.rigid import from_rpy

from .document import ORIGIN, Pose6, SdfLink, SdfModel

Matrix = NDArray[np.float64]


def matrix(pose: Pose6) -> Matrix:
    """Return the matrix (4, 4) that transforms points from the frame at a pose to the frame of the pose."""
    x, y, z, roll, pitch, yaw = pose
    cr, sr, cp, sp, cy, sy = (f(angle) for angle in (roll, pitch, yaw) for f in (math.cos, math.sin))
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr, x],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr, y],
            [-sp, cp * sr, cp * cr, z],
            [0.0, 0.0, 0.0, 1.0],
        ]
    )


def pose6(transform: Matrix) -> Pose6:
    """Return the pose of a matrix (4, 4). If x points straight up or down, roll is 0 and yaw is the whole rotation."""
    x, y, z = transform[:3, 3]
    flat = math.hypot(transform[0, 0], transform[1, 0])
    pitch = math.atan2(-transform[2, 0], flat)
    if flat > 1e-9:
        roll = math.atan2(transform[2, 1], transform[2, 2])
        yaw = math.atan2(transform[1, 0], transform[0, 0])
    else:
        roll, yaw = 0.0, math.atan2(-transform[0, 1], transform[1, 1])
    return (float(x), float(y), float(z), roll, pitch, yaw)


def compose(first: Pose6, second: Pose6) -> Pose6:
    """Return the pose `second`, given in `first`, in the frame of `first`; exact if one of the two is the origin."""
    if first == ORIGIN:
        return second
    if second == ORIGIN:
        return first
    if not any(first[3:5]) and not any(second[3:5]):  # both upright: the yaws add up
        c, s = math.cos(first[5]), math.sin(first[5])
        x, y, z, _, _, yaw = second
        return (first[0] + c * x - s * y, first[1] + s * x + c * y, first[2] + z, 0.0, 0.0, first[5] + yaw)
    return pose6(matrix_product(matrix(first), matrix(second)))


def inverse(pose: Pose6) -> Pose6:
    """Return the inverse of a pose."""
    if pose == ORIGIN:
        return pose
    turn = matrix(pose)[:3, :3].T
    back = np.eye(4)
    back[:3, :3] = turn
    back[:3, 3] = -matrix_product(turn, pose[:3])
    return pose6(back)


def placed_links(model: SdfModel, pose: Pose6 = ORIGIN, inside: str = "") -> Iterator[tuple[str, SdfLink, Pose6]]:
    """Yield each link of a model and its nested models: its name, the link, and its pose with the model at `pose`."""
    for link in model.links:
        yield inside + link.name, link, compose(pose, link.pose)
    for each in model.models:
        yield from placed_links(each, compose(pose, each.pose), f"{inside}{each.name}::")


def upright(pose: Pose6, tolerance: float = 1e-6) -> bool:
    """Return True if the z axis of a pose points straight up."""
    return math.cos(pose[3]) * math.cos(pose[4]) >= 1 - tolerance**2 / 2 and abs(math.sin(pose[4])) <= tolerance


def quaternion(roll: float, pitch: float, yaw: float) -> tuple[float, float, float, float]:
    """Return x, y, z and w of a rotation by yaw after pitch after roll about fixed axes."""
    return from_rpy((0.0, 0.0, 0.0), roll, pitch, yaw)[3:]


def from_quaternion(x: float, y: float, z: float, w: float) -> tuple[float, float, float]:
    """Return roll, pitch and yaw of a quaternion, which need not be normalised but must not be zero."""
    length = math.sqrt(x * x + y * y + z * z + w * w)
    x, y, z, w = x / length, y / length, z / length, w / length
    turn = np.eye(4)
    turn[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    return pose6(turn)[3:]
