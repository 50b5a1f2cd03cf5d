"""Rigid transforms: seven floats, x, y, z [m] and the quaternion x, y, z, w, ordered as in `geometry_msgs/Transform`.

The transform of frame `b` in frame `a` is the pose of `b` in `a`: it maps the coordinates of a point in `b` to those
in `a`. Transforms are tuples, not arrays: for a single transform Python's floats are ten times as fast as numpy.
Points are arrays (..., 3).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, TypeAlias

from rosmini.core.geometry.products import matrix_product
from rosmini.core.lazy import np

from .errors import InvalidArgumentException
from .kernel import IDENTITY, Rigid, compose, interpolate, inverse

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = [
    "IDENTITY",
    "Floats",
    "Rigid",
    "compose",
    "from_rpy",
    "from_yaw",
    "interpolate",
    "inverse",
    "matrix",
    "rigid",
    "rotate",
    "rpy",
    "transform_points",
]

Floats: TypeAlias = "NDArray[np.float64]"


def rigid(translation: Sequence[float] = (0.0, 0.0, 0.0), rotation: Sequence[float] = (0.0, 0.0, 0.0, 1.0)) -> Rigid:
    """Return a translation (3) [m] and a quaternion (4: x, y, z, w) as a transform, with the quaternion normalised.

    Raises `InvalidArgumentException` for a quaternion whose length is 0 or not finite.
    """
    x, y, z = (float(value) for value in translation)
    qx, qy, qz, qw = (float(value) for value in rotation)
    length = math.sqrt(qx * qx + qy * qy + qz * qz + qw * qw)
    if not 0 < length < math.inf:
        raise InvalidArgumentException(
            f"the quaternion x={qx:g}, y={qy:g}, z={qz:g}, w={qw:g} is not a rotation: for no rotation, use "
            "x=y=z=0, w=1 (a new geometry_msgs/Quaternion has w=0)"
        )
    return (x, y, z, qx / length, qy / length, qz / length, qw / length)


def from_yaw(x: float, y: float, yaw: float, z: float = 0.0) -> Rigid:
    """Return a pose in the plane, x, y [m] and yaw [rad], as a transform."""
    return (x, y, z, 0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2))


def from_rpy(translation: Sequence[float], roll: float, pitch: float, yaw: float) -> Rigid:
    """Return a transform from a translation [m], and roll, pitch and yaw [rad] about the fixed axes (REP 103)."""
    x, y, z = (float(value) for value in translation)
    cr, sr = math.cos(roll / 2), math.sin(roll / 2)
    cp, sp = math.cos(pitch / 2), math.sin(pitch / 2)
    cy, sy = math.cos(yaw / 2), math.sin(yaw / 2)
    return (
        x,
        y,
        z,
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )


def rpy(transform: Rigid) -> tuple[float, float, float]:
    """Return roll, pitch and yaw [rad] about the fixed axes x, y, z (REP 103).

    If pitch is 90 degrees up or down, yaw is 0.
    """
    _, _, _, x, y, z, w = transform
    sine = 2 * (w * y - z * x)
    if abs(sine) > 1 - 1e-12:
        return (math.remainder(2 * math.atan2(x, w), math.tau), math.copysign(math.pi / 2, sine), 0.0)
    roll = math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    yaw = math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    return (roll, math.asin(sine), yaw)


def matrix(transform: Rigid) -> Floats:
    """Return the homogeneous matrix (4, 4) of a transform."""
    x, y, z, i, j, k, w = transform
    return np.array(
        [
            [1 - 2 * (j * j + k * k), 2 * (i * j - k * w), 2 * (i * k + j * w), x],
            [2 * (i * j + k * w), 1 - 2 * (i * i + k * k), 2 * (j * k - i * w), y],
            [2 * (i * k - j * w), 2 * (j * k + i * w), 1 - 2 * (i * i + j * j), z],
            [0.0, 0.0, 0.0, 1.0],
        ]
    )


def transform_points(transform: Rigid, points: ArrayLike) -> Floats:
    """Return the points (..., 3) [m] in the parent frame; `transform` is the pose of the frame they are given in."""
    whole = matrix(transform)
    result: Floats = matrix_product(points, whole[:3, :3].T) + whole[:3, 3]
    return result


def rotate(transform: Rigid, vectors: ArrayLike) -> Floats:
    """Return vectors (..., 3) rotated, but not moved, by a transform."""
    return matrix_product(vectors, matrix(transform)[:3, :3].T)
