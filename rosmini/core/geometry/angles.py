"""Angles, and conversion to and from quaternions.

`normalize_angle` and `shortest_angular_distance` are those of the ROS package `angles` (http://wiki.ros.org/angles).
An infinite angle becomes nan.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, TypeAlias, overload

from rosmini.core.lazy import np

from .errors import GeometryError

if TYPE_CHECKING:
    from numpy.typing import NDArray

Floats: TypeAlias = "NDArray[np.float64]"

TURN = 2 * math.pi


def cos_sin(angles: Floats) -> tuple[Floats, Floats]:
    """Return cosines and sines (n,) of angles (n,), computed by the C library.

    numba computes the same bits; numpy's own functions differ in the last bit.
    """
    given = angles.tolist()
    return np.array([math.cos(angle) for angle in given]), np.array([math.sin(angle) for angle in given])


@overload
def normalize_angle(angle: float) -> float: ...
@overload
def normalize_angle(angle: Floats) -> Floats: ...
def normalize_angle(angle: float | Floats) -> float | Floats:
    """Return the equivalent angle [rad] in (-pi, pi]: a number for a number, an array for an array.

    The result is exact for the given `TURN`: `fmod` is exact, and so is adding or subtracting one turn afterwards.

    >>> normalize_angle(1.5 * math.pi) == -math.pi / 2
    True
    """
    if not isinstance(angle, (float, int)) and isinstance(angle, np.ndarray):
        with np.errstate(invalid="ignore"):
            rest = np.asarray(np.fmod(angle, TURN))
        rest[rest > math.pi] -= TURN
        rest[rest <= -math.pi] += TURN
        return rest
    if math.isinf(angle):
        return math.nan
    left = math.fmod(angle, TURN)
    if left > math.pi:
        return left - TURN
    return left + TURN if left <= -math.pi else left


@overload
def shortest_angular_distance(start: float, end: float) -> float: ...
@overload
def shortest_angular_distance(start: Floats, end: float | Floats) -> Floats: ...
@overload
def shortest_angular_distance(start: float, end: Floats) -> Floats: ...
def shortest_angular_distance(start: float | Floats, end: float | Floats) -> float | Floats:
    """Return the rotation [rad] from `start` to `end`, in (-pi, pi], for numbers or arrays that numpy can broadcast.

    >>> round(shortest_angular_distance(3.0, -3.0), 3)
    0.283
    """
    return normalize_angle(end - start)


def quaternion_from_yaw(yaw: float) -> tuple[float, float, float, float]:
    """Return the rotation by `yaw` [rad] about z as x, y, z, w, the order of `geometry_msgs/Quaternion`."""
    return (0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2))


def yaw_from_quaternion(x: float, y: float, z: float, w: float) -> float:
    """Return the yaw [rad] of a rotation, in [-pi, pi], as in its decomposition into yaw, then pitch, then roll.

    The quaternion need not be normalised. Raises `GeometryError` if its length is 0, as in an empty message, or is not
    finite.
    """
    square = x * x + y * y + z * z + w * w
    if not 0 < square < math.inf:
        msg = (
            f"x={x}, y={y}, z={z}, w={w} is not a rotation: its length is 0 or not finite; for no rotation, use "
            "x=y=z=0, w=1 (a new geometry_msgs/Quaternion has w=0)"
        )
        raise GeometryError(msg)
    return math.atan2(2 * (w * z + x * y), w * w + x * x - y * y - z * z)
