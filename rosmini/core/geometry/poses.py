"""Poses in the plane: x [m], y [m] and heading [rad, counter-clockwise from the x axis].

A pose is a tuple of three floats or an array (..., 3); functions return the same kind. Arrays are
broadcast against each other and against single poses. Headings are never wrapped, so turns can be counted;
`normalize_angle` wraps them. An array of another shape raises `GeometryError`.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, TypeAlias, overload

from rosmini.core.lazy import np

from .errors import GeometryError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

Pose = tuple[float, float, float]
Floats: TypeAlias = "NDArray[np.float64]"


@overload
def compose(a: Pose, b: Pose) -> Pose: ...
@overload
def compose(a: Floats, b: Pose | Floats) -> Floats: ...
@overload
def compose(a: Pose, b: Floats) -> Floats: ...
def compose(a: Pose | Floats, b: Pose | Floats) -> Pose | Floats:
    """Return the pose `b`, given in the frame of `a`, in the parent frame of `a`: a is world -> a, b is a -> b.

    >>> compose((1.0, 0.0, math.pi), (2.0, 0.0, 0.0))[0]
    -1.0
    """
    if isinstance(a, tuple) and isinstance(b, tuple):
        (ax, ay, ath), (bx, by, bth) = a, b
        c, s = math.cos(ath), math.sin(ath)
        return (ax + c * bx - s * by, ay + s * bx + c * by, ath + bth)
    first, second = _poses(a), _poses(b)
    cos, sin = np.cos(first[..., 2]), np.sin(first[..., 2])
    x = first[..., 0] + cos * second[..., 0] - sin * second[..., 1]
    y = first[..., 1] + sin * second[..., 0] + cos * second[..., 1]
    return np.stack([x, y, first[..., 2] + second[..., 2]], axis=-1)


@overload
def inverse(pose: Pose) -> Pose: ...
@overload
def inverse(pose: Floats) -> Floats: ...
def inverse(pose: Pose | Floats) -> Pose | Floats:
    """Return the inverse: the parent frame's pose in the frame of `pose`. Composed with `pose` it is (0, 0, 0)."""
    if isinstance(pose, tuple):
        x, y, theta = pose
        c, s = math.cos(theta), math.sin(theta)
        return (-c * x - s * y, s * x - c * y, -theta)
    xs, ys, headings = np.moveaxis(_poses(pose), -1, 0)
    cos, sin = np.cos(headings), np.sin(headings)
    return np.stack([-cos * xs - sin * ys, sin * xs - cos * ys, -headings], axis=-1)


def transform_points(pose: Pose | Floats, points: ArrayLike) -> Floats:
    """Return the points (..., 2), given in the frame of `pose` or of each pose (..., 3), in its parent frame [m].

    Raises `GeometryError` if the points or poses have other shapes.
    """
    array = np.asarray(points, dtype=np.float64)
    if array.ndim == 0 or array.shape[-1] != 2:
        msg = f"points are an array (..., 2) of x and y, not {array.shape}"
        raise GeometryError(msg)
    poses = _poses(pose)
    cos, sin = np.cos(poses[..., 2]), np.sin(poses[..., 2])
    x, y = array[..., 0], array[..., 1]
    return np.stack([poses[..., 0] + cos * x - sin * y, poses[..., 1] + sin * x + cos * y], axis=-1)


@overload
def arc(pose: Pose, v: float, w: float, dt: float) -> Pose: ...
@overload
def arc(pose: Floats, v: float | Floats, w: float | Floats, dt: float | Floats) -> Floats: ...
@overload
def arc(pose: Pose, v: Floats, w: float | Floats, dt: float | Floats) -> Floats: ...
@overload
def arc(pose: Pose, v: float, w: Floats, dt: float | Floats) -> Floats: ...
@overload
def arc(pose: Pose, v: float, w: float, dt: Floats) -> Floats: ...
def arc(pose: Pose | Floats, v: float | Floats, w: float | Floats, dt: float | Floats) -> Pose | Floats:
    """Return the pose of a unicycle after `dt` seconds at constant speeds `v` [m/s] and `w` [rad/s, to the left].

    Exact for any `dt`: the path is an arc, whose chord is `v dt sin(h) / h` long and points to `theta + h`, where h is
    `w dt / 2` (Thrun, Burgard and Fox, Probabilistic Robotics, 2005, section 5.3, describes the same arc by its centre,
    which does not exist for a straight line).
    """
    if not (isinstance(v, np.ndarray) or isinstance(w, np.ndarray) or isinstance(dt, np.ndarray)) and isinstance(
        pose, tuple
    ):
        x, y, theta = pose
        half = w * dt / 2
        chord = v * dt * (math.sin(half) / half if half else 1.0)
        return (x + chord * math.cos(theta + half), y + chord * math.sin(theta + half), theta + w * dt)
    starts = _poses(pose)
    halves = np.asarray(w * dt / 2, dtype=np.float64)
    chords = v * dt * np.sinc(halves / np.pi)
    towards = starts[..., 2] + halves
    ends = (starts[..., 0] + chords * np.cos(towards), starts[..., 1] + chords * np.sin(towards), towards + halves)
    return np.stack(np.broadcast_arrays(*ends), axis=-1)


def _poses(poses: Pose | Floats) -> Floats:
    array = np.asarray(poses, dtype=np.float64)
    if array.ndim == 0 or array.shape[-1] != 3:
        msg = f"poses are an array (..., 3) of x, y and heading, not {array.shape}"
        raise GeometryError(msg)
    return array
