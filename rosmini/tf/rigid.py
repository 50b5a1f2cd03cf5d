"""Rigid transforms: seven floats, x, y, z [m] and the rotation's quaternion x, y, z, w, in the order of `geometry_msgs/Transform`.

The transform of frame `b` in frame `a` is where `b` stands in `a`: it takes the coordinates of a point in `b` to those in `a`. Tuples, not
arrays: for one transform Python's floats are an order of magnitude faster than numpy. Points come as arrays (..., 3).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import InvalidArgumentException

Floats = NDArray[np.float64]
Rigid = tuple[float, float, float, float, float, float, float]

IDENTITY: Rigid = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)


def rigid(
    translation: Sequence[float] = (0.0, 0.0, 0.0), rotation: Sequence[float] = (0.0, 0.0, 0.0, 1.0)
) -> Rigid:
    """A translation (3) [m] and a quaternion (4: x, y, z, w) as one transform; the quaternion is brought to length 1.

    Raises `InvalidArgumentException` for a quaternion of length 0, which is no rotation.
    """
    x, y, z = (float(value) for value in translation)
    qx, qy, qz, qw = (float(value) for value in rotation)
    length = math.sqrt(qx * qx + qy * qy + qz * qz + qw * qw)
    if not 0 < length < math.inf:
        raise InvalidArgumentException(
            f"the quaternion x={qx:g}, y={qy:g}, z={qz:g}, w={qw:g} is no rotation: no rotation at all is x=y=z=0, w=1 "
            "(a new geometry_msgs/Quaternion has w=0)"
        )
    return (x, y, z, qx / length, qy / length, qz / length, qw / length)


def from_yaw(x: float, y: float, yaw: float, z: float = 0.0) -> Rigid:
    """A pose in the plane, x, y [m] and yaw [rad], as a transform."""
    return (x, y, z, 0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2))


def from_rpy(translation: Sequence[float], roll: float, pitch: float, yaw: float) -> Rigid:
    """A translation [m], and roll, pitch and yaw [rad] about the fixed axes x, y and z (REP 103)."""
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
    """Roll, pitch and yaw [rad] about the fixed axes x, y, z (REP 103); where pitch is 90 degrees up or down, yaw is 0."""
    _, _, _, x, y, z, w = transform
    sine = 2 * (w * y - z * x)
    if abs(sine) > 1 - 1e-12:
        return (math.remainder(2 * math.atan2(x, w), math.tau), math.copysign(math.pi / 2, sine), 0.0)
    roll = math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    yaw = math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    return (roll, math.asin(sine), yaw)


def compose(a: Rigid, b: Rigid) -> Rigid:
    """`b` after `a`: where c stands in a's frame, if `a` says where b stands there, and `b` where c stands in b."""
    ax, ay, az, ai, aj, ak, aw = a
    bx, by, bz, bi, bj, bk, bw = b
    # v + 2 w (q x v) + 2 q x (q x v)
    tx = 2 * (aj * bz - ak * by)
    ty = 2 * (ak * bx - ai * bz)
    tz = 2 * (ai * by - aj * bx)
    return (
        ax + bx + aw * tx + aj * tz - ak * ty,
        ay + by + aw * ty + ak * tx - ai * tz,
        az + bz + aw * tz + ai * ty - aj * tx,
        aw * bi + ai * bw + aj * bk - ak * bj,
        aw * bj - ai * bk + aj * bw + ak * bi,
        aw * bk + ai * bj - aj * bi + ak * bw,
        aw * bw - ai * bi - aj * bj - ak * bk,
    )


def inverse(a: Rigid) -> Rigid:
    """The way back: composed with `a`, on either side, it is the identity."""
    x, y, z, i, j, k, w = a
    tx = 2 * (k * y - j * z)
    ty = 2 * (i * z - k * x)
    tz = 2 * (j * x - i * y)
    # The rotation by (-i, -j, -k, w) of (x, y, z), negated.
    return (
        -(x + w * tx - j * tz + k * ty),
        -(y + w * ty - k * tx + i * tz),
        -(z + w * tz - i * ty + j * tx),
        -i,
        -j,
        -k,
        w,
    )


def interpolate(a: Rigid, b: Rigid, fraction: float) -> Rigid:
    """Between `a` (0) and `b` (1): the position on the straight line, the rotation on the shortest arc (slerp: Shoemake, 1985)."""
    ax, ay, az, ai, aj, ak, aw = a
    bx, by, bz, bi, bj, bk, bw = b
    rest = 1.0 - fraction
    cosine = ai * bi + aj * bj + ak * bk + aw * bw
    if cosine < 0:
        bi, bj, bk, bw, cosine = -bi, -bj, -bk, -bw, -cosine
    if cosine > 0.9999:  # so near that the arc is a line; the length is put right below
        p, q = rest, fraction
    else:
        angle = math.acos(cosine)
        sine = math.sin(angle)
        p, q = math.sin(rest * angle) / sine, math.sin(fraction * angle) / sine
    i, j, k, w = p * ai + q * bi, p * aj + q * bj, p * ak + q * bk, p * aw + q * bw
    scale = 1 / math.sqrt(i * i + j * j + k * k + w * w)
    return (
        rest * ax + fraction * bx,
        rest * ay + fraction * by,
        rest * az + fraction * bz,
        i * scale,
        j * scale,
        k * scale,
        w * scale,
    )


def matrix(transform: Rigid) -> Floats:
    """The homogeneous matrix (4, 4)."""
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
    """Points (..., 3) [m] of the frame that `transform` places, in the frame in which it places it (..., 3)."""
    whole = matrix(transform)
    result: Floats = np.asarray(points, dtype=np.float64) @ whole[:3, :3].T + whole[:3, 3]
    return result


def rotate(transform: Rigid, vectors: ArrayLike) -> Floats:
    """Vectors (..., 3), which have a direction and no place: turned and not moved."""
    result: Floats = np.asarray(vectors, dtype=np.float64) @ matrix(transform)[:3, :3].T
    return result
