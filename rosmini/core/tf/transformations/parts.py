"""Composition and decomposition of matrices, projections, and crystallographic bases."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rosmini.core.geometry.products import determinant, inverse_matrix, matrix_product, norm, scalar_product

from .euler import euler_from_matrix, euler_matrix
from .matrices import EPS, about, translation_matrix, unit

Floats = NDArray[np.float64]


def compose_matrix(
    scale: ArrayLike | None = None,
    shear: ArrayLike | None = None,
    angles: ArrayLike | None = None,
    translate: ArrayLike | None = None,
    perspective: ArrayLike | None = None,
) -> Floats:
    """Return the product of perspective (4), translation (3), rotation (sxyz), shear (xy, xz, yz) and scale (3)."""
    result = np.identity(4)
    if perspective is not None:
        result[3, :] = np.asarray(perspective, dtype=np.float64)[:4]
    if translate is not None:
        result = matrix_product(result, translation_matrix(translate))
    if angles is not None:
        roll, pitch, yaw = np.asarray(angles, dtype=np.float64)
        result = matrix_product(result, euler_matrix(float(roll), float(pitch), float(yaw), "sxyz"))
    if shear is not None:
        sheared = np.identity(4)
        sheared[0, 1], sheared[0, 2], sheared[1, 2] = np.asarray(shear, dtype=np.float64)
        result = matrix_product(result, sheared)
    if scale is not None:
        result = result * [*np.asarray(scale, dtype=np.float64), 1.0]
    whole: Floats = result / result[3, 3]
    return whole


def decompose_matrix(
    matrix: ArrayLike,
) -> tuple[Floats, list[float], list[float], Floats, Floats]:
    """Return scale, shear, angles, translation and perspective, as for `compose_matrix`.

    Raises `ValueError` if the matrix is singular.
    """
    whole = np.array(matrix, dtype=np.float64)
    if abs(whole[3, 3]) < EPS:
        raise ValueError("M[3, 3] is zero")
    whole = whole / whole[3, 3]
    affine = whole.copy()
    affine[3, :] = 0, 0, 0, 1
    if abs(determinant(affine[:3, :3])) < EPS:
        raise ValueError("matrix is singular: it cannot be taken apart")
    perspective = matrix_product(whole[3, :], inverse_matrix(affine))
    rotation, upper = _orthogonal(affine[:3, :3])
    if determinant(rotation) < 0:
        rotation, upper = -rotation, -upper
    scale = np.diag(upper).copy()
    shear = [float(upper[0, 1] / scale[1]), float(upper[0, 2] / scale[2]), float(upper[1, 2] / scale[2])]
    return scale, shear, list(euler_from_matrix(rotation)), affine[:3, 3].copy(), perspective


def _orthogonal(linear: Floats) -> tuple[Floats, Floats]:
    """Return a matrix (3, 3) as product of an orthogonal and an upper triangular one with positive diagonal.

    Uses Gram-Schmidt twice: the second pass removes rounding errors.
    """
    rotation, upper = linear.copy(), np.identity(3)
    for _ in range(2):
        step = np.zeros((3, 3))
        for k in range(3):
            for i in range(k):
                step[i, k] = scalar_product(rotation[:, i], rotation[:, k])
                rotation[:, k] -= step[i, k] * rotation[:, i]
            step[k, k] = norm(rotation[:, k])
            rotation[:, k] /= step[k, k]
        upper = matrix_product(step, upper)
    return rotation, upper


def projection_matrix(
    point: ArrayLike,
    normal: ArrayLike,
    direction: ArrayLike | None = None,
    perspective: ArrayLike | None = None,
    pseudo: bool = False,
) -> Floats:
    """Return a projection on the plane through `point`: orthogonal, along `direction`, or to the eye `perspective`.

    With `pseudo`, a perspective projection keeps the depth, so that objects in front and behind can be
    distinguished.
    """
    place, axis = np.asarray(point, dtype=np.float64)[:3], unit(normal)
    if perspective is None:
        along = axis if direction is None else np.asarray(direction, dtype=np.float64)[:3]
        return about(np.identity(3) - along[:, None] * axis / scalar_product(along, axis), place)
    eye = np.asarray(perspective, dtype=np.float64)[:3]
    depth = scalar_product(eye - place, axis)
    result = np.empty((4, 4))
    result[:3, :3] = depth * np.identity(3) - eye[:, None] * axis
    result[:3, 3] = scalar_product(place, axis) * eye
    if pseudo:
        result[:3, :3] -= axis[:, None] * axis
        result[:3, 3] += scalar_product(place, axis) * axis
    result[3, :3] = -axis
    result[3, 3] = scalar_product(eye, axis)
    return result


def clip_matrix(
    left: float, right: float, bottom: float, top: float, near: float, far: float, perspective: bool = False
) -> Floats:
    """Return the matrix from a view's box, or with `perspective` from its frustum, to the cube from -1 to 1.

    Raises `ValueError` for an empty volume.
    """
    if left >= right or bottom >= top or near >= far:
        raise ValueError("invalid frustum: left < right, bottom < top and near < far are needed")
    width, height, depth = right - left, top - bottom, far - near
    result = np.zeros((4, 4))
    if perspective:
        if near <= EPS:
            raise ValueError(f"invalid frustum: near = {near} has to be positive")
        result[0, 0], result[1, 1] = -2 * near / width, -2 * near / height
        result[:3, 2] = (right + left) / width, (top + bottom) / height, -(far + near) / depth
        result[2, 3], result[3, 2] = 2 * far * near / depth, -1.0
        return result
    result[0, 0], result[1, 1], result[2, 2] = 2 / width, 2 / height, 2 / depth
    result[:3, 3] = -(right + left) / width, -(top + bottom) / height, -(far + near) / depth
    result[3, 3] = 1.0
    return result


def orthogonalization_matrix(lengths: ArrayLike, angles: ArrayLike) -> Floats:
    """Return the matrix from a crystal's coordinates, with axes of lengths (3) and angles (3) [deg], to Cartesian."""
    a, b, c = np.asarray(lengths, dtype=np.float64)
    alpha, beta, gamma = np.radians(np.asarray(angles, dtype=np.float64))
    sine = math.sin(beta)
    co = (math.cos(alpha) * math.cos(beta) - math.cos(gamma)) / (math.sin(alpha) * sine)
    return np.array(
        [
            [a * sine * math.sqrt(1 - co * co), 0, 0, 0],
            [-a * sine * co, b * math.sin(alpha), 0, 0],
            [a * math.cos(beta), b * math.cos(alpha), c, 0],
            [0, 0, 0, 1],
        ]
    )
