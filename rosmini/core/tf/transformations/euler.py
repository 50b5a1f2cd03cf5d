"""Euler angles in all 24 conventions: `sxyz` is about the static axes x, y, z, `rzyx` about the rotating axes.

For static axes i, j, k the rotation is R_k R_j R_i. Rotating axes are equivalent to static ones in reverse order, with
the angles reversed too (Shoemake, "Euler angle conversion", Graphics Gems IV, 1994).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

from rosmini.core.lazy import np

from .matrices import EPS
from .quaternions import quaternion_matrix, quaternion_multiply

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

Floats: TypeAlias = "NDArray[np.float64]"
Axes = str | tuple[int, int, int, int]


class Order(NamedTuple):
    """A convention: the static axes, first to last; the axis that is neither first nor second; handedness 1 or -1.

    `reversed` is True if the angles are in reverse order.
    """

    axes: tuple[int, int, int]
    other: int
    sign: int
    reversed: bool


def order_of(axes: Axes) -> Order:
    """Return the convention for a name such as `sxyz`, or for tf's tuple (first axis, parity, repetition, frame).

    Raises `KeyError` for an unknown name.
    """
    if isinstance(axes, str):
        letters = ["xyz".find(letter) for letter in axes[1:]]
        if len(letters) != 3 or axes[0] not in "sr" or -1 in letters or letters[1] in (letters[0], letters[2]):
            raise KeyError(axes)
        first, second, last = letters if axes[0] == "s" else letters[::-1]
        turning = axes[0] == "r"
    else:
        first, odd, again, frame = axes
        second = (first + (2 if odd else 1)) % 3
        last = first if again else 3 - first - second
        turning = bool(frame)
    return Order((first, second, last), 3 - first - second, 1 if (second - first) % 3 == 1 else -1, turning)


def quaternion_from_euler(ai: float, aj: float, ak: float, axes: Axes = "sxyz") -> Floats:
    """Return the quaternion (x, y, z, w) of three Euler angles [rad]; `sxyz` is roll, pitch, yaw (REP 103)."""
    order = order_of(axes)
    result = np.array([0.0, 0.0, 0.0, 1.0])
    for axis, angle in zip(order.axes, (ak, aj, ai) if order.reversed else (ai, aj, ak), strict=True):
        turn = np.zeros(4)
        turn[axis], turn[3] = math.sin(angle / 2), math.cos(angle / 2)
        result = quaternion_multiply(turn, result)
    return result


def euler_matrix(ai: float, aj: float, ak: float, axes: Axes = "sxyz") -> Floats:
    """Return the homogeneous rotation matrix (4, 4) of three Euler angles [rad]."""
    return quaternion_matrix(quaternion_from_euler(ai, aj, ak, axes))


def euler_from_matrix(matrix: ArrayLike, axes: Axes = "sxyz") -> tuple[float, float, float]:
    """Return the Euler angles [rad] of a rotation matrix; in gimbal lock the angle about the last static axis is 0."""
    (i, j, k), other, sign, turned = order_of(axes)
    m = np.asarray(matrix, dtype=np.float64)[:3, :3]
    if i == k:
        sine, angles = math.hypot(m[i, j], m[i, other]), None
        middle = math.atan2(sign * sine, m[i, i])  # the one of the two solutions that tf returns
        if sine > EPS:
            angles = math.atan2(sign * m[i, j], m[i, other]), math.atan2(sign * m[j, i], -m[other, i])
    else:
        cosine, angles = math.hypot(m[i, i], m[j, i]), None
        middle = math.atan2(-sign * m[k, i], cosine)
        if cosine > EPS:
            angles = math.atan2(sign * m[k, j], m[k, k]), math.atan2(sign * m[j, i], m[i, i])
    first, last = angles or (math.atan2(-sign * m[j, other], m[j, j]), 0.0)
    return (last, middle, first) if turned else (first, middle, last)


def euler_from_quaternion(quaternion: ArrayLike, axes: Axes = "sxyz") -> tuple[float, float, float]:
    """Return the Euler angles [rad] of a quaternion (x, y, z, w)."""
    return euler_from_matrix(quaternion_matrix(quaternion), axes)
