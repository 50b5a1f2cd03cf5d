"""Quaternions as arrays (4) of x, y, z, w: conversion, products, interpolation and random rotations."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, TypeAlias

from rosmini.core.geometry.products import scalar_product
from rosmini.core.lazy import np

from .matrices import EPS, unit

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

Floats: TypeAlias = "NDArray[np.float64]"


def _four(quaternion: ArrayLike) -> Floats:
    return np.array(quaternion, dtype=np.float64)[:4]


def quaternion_multiply(quaternion1: ArrayLike, quaternion0: ArrayLike) -> Floats:
    """Return the Hamilton product of two quaternions (4,): the rotation `quaternion0`, then `quaternion1`."""
    x1, y1, z1, w1 = _four(quaternion1)
    x0, y0, z0, w0 = _four(quaternion0)
    return np.array(
        [
            w1 * x0 + x1 * w0 + y1 * z0 - z1 * y0,
            w1 * y0 - x1 * z0 + y1 * w0 + z1 * x0,
            w1 * z0 + x1 * y0 - y1 * x0 + z1 * w0,
            w1 * w0 - x1 * x0 - y1 * y0 - z1 * z0,
        ]
    )


def quaternion_conjugate(quaternion: ArrayLike) -> Floats:
    """Return the conjugate of a quaternion (4,), which is the inverse rotation if the quaternion has length 1."""
    x, y, z, w = _four(quaternion)
    return np.array([-x, -y, -z, w])


def quaternion_inverse(quaternion: ArrayLike) -> Floats:
    """Return the inverse of a quaternion (4,) of any length but 0."""
    four = _four(quaternion)
    result: Floats = quaternion_conjugate(four) / scalar_product(four, four)
    return result


def quaternion_about_axis(angle: float, axis: ArrayLike) -> Floats:
    """Return the quaternion of a rotation by an angle [rad] about an axis (3) of any length."""
    direction = np.asarray(axis, dtype=np.float64)[:3]
    result = np.zeros(4)
    if scalar_product(direction, direction) > EPS**2:
        result[:3] = unit(direction) * math.sin(angle / 2)
    result[3] = math.cos(angle / 2)
    return result


def quaternion_matrix(quaternion: ArrayLike) -> Floats:
    """Return the matrix (4, 4) of a rotation.

    The quaternion need not be normalised; one of length 0 counts as no rotation.
    """
    four = _four(quaternion)
    square = scalar_product(four, four)
    result = np.identity(4)
    if square < EPS:
        return result
    x, y, z, w = four
    s = 2.0 / square
    result[:3, :3] = [
        [1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)],
        [s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w)],
        [s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y)],
    ]
    return result


def quaternion_from_matrix(matrix: ArrayLike) -> Floats:
    """Return the quaternion of a rotation matrix (4, 4), by its largest component (Shepperd, 1978)."""
    whole = np.array(matrix, dtype=np.float64)[:4, :4]
    m = whole[:3, :3] / whole[3, 3]
    trace = float(np.trace(m))
    result = np.empty(4)
    if trace > 0:
        result[:] = m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], trace + 1
    else:
        i = 0
        if m[1, 1] > m[0, 0]:
            i = 1
        if m[2, 2] > m[i, i]:
            i = 2
        j, k = (i + 1) % 3, (i + 2) % 3
        result[i] = m[i, i] - m[j, j] - m[k, k] + 1
        result[j] = m[i, j] + m[j, i]
        result[k] = m[k, i] + m[i, k]
        result[3] = m[k, j] - m[j, k]
    largest = result[3] if trace > 0 else result[i]
    return result * (0.5 / math.sqrt(largest))


def quaternion_slerp(
    quat0: ArrayLike, quat1: ArrayLike, fraction: float, spin: int = 0, shortestpath: bool = True
) -> Floats:
    """Return the rotation at `fraction` (0 to 1) between two rotations, at constant speed (Shoemake, 1985).

    `spin` is a number of half turns to add. Without `shortestpath`, the rotation may go the long way round.
    """
    first, second = (four / math.sqrt(scalar_product(four, four)) for four in (_four(quat0), _four(quat1)))
    if fraction in (0.0, 1.0):
        return second if fraction else first
    cosine = scalar_product(first, second)
    if abs(abs(cosine) - 1.0) < EPS:
        return first
    if shortestpath and cosine < 0:
        second, cosine = -second, -cosine
    angle = math.acos(cosine) + spin * math.pi
    if abs(angle) < EPS:
        return first
    result: Floats = (math.sin((1 - fraction) * angle) * first + math.sin(fraction * angle) * second) / math.sin(angle)
    return result


def random_quaternion(rand: ArrayLike | None = None) -> Floats:
    """Return a uniformly distributed random quaternion (4,) (Shoemake, 1992), made from three numbers in [0, 1).

    These are `rand`; by default they are random, and differ from run to run.
    """
    u, v, w = np.random.default_rng().random(3) if rand is None else np.asarray(rand, dtype=np.float64)
    a, b = math.sqrt(1 - u), math.sqrt(u)
    return np.array(
        [
            math.sin(2 * math.pi * v) * a,
            math.cos(2 * math.pi * v) * a,
            math.sin(2 * math.pi * w) * b,
            math.cos(2 * math.pi * w) * b,
        ]
    )


def random_rotation_matrix(rand: ArrayLike | None = None) -> Floats:
    """Return the matrix (4, 4) of `random_quaternion(rand)`."""
    return quaternion_matrix(random_quaternion(rand))


def random_vector(size: int) -> Floats:
    """Return an array of `size` random numbers in [0, 1), which differ from run to run."""
    return np.random.default_rng().random(size)
