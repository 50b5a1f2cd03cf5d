"""Transforms of joints, as plain numbers and arrays."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.products import matrix_product

Floats = NDArray[np.float64]


def rotation(rpy: Sequence[float]) -> Floats:
    """Return the rotation (3, 3) by roll, pitch and yaw [rad] about the fixed axes x, y and z in order (REP 103)."""
    (cr, cp, cy), (sr, sp, sy) = ([f(angle) for angle in rpy] for f in (math.cos, math.sin))
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


def turn(axis: Sequence[float], angle: float) -> Floats:
    """Return the rotation (3, 3) by `angle` [rad] about an axis of length 1 (Rodrigues' formula)."""
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    result: Floats = np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * matrix_product(cross, cross)
    return result


def origin(xyz: Sequence[float], rpy: Sequence[float]) -> Floats:
    """Return the transform (4, 4) of URDF's ``<origin xyz= rpy=>``."""
    result = np.eye(4)
    result[:3, :3] = rotation(rpy)
    result[:3, 3] = xyz
    return result


def motion(axis: Sequence[float], position: float, *, slides: bool) -> Floats:
    """Return a joint's motion (4, 4): rotation about its axis by `position` [rad], or translation along it [m]."""
    result = np.eye(4)
    if slides:
        result[:3, 3] = np.asarray(axis) * position
    else:
        result[:3, :3] = turn(axis, position)
    return result
