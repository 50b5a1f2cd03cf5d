"""Composition of homogeneous matrices from scale, shear, rotation, translation and perspective, and decomposition."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

from rosmini.core.geometry.products import determinant, inverse_matrix, matrix_product, norm, scalar_product
from rosmini.core.lazy import np

from .euler import euler_from_matrix, euler_matrix
from .matrices import EPS, translation_matrix

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

Floats: TypeAlias = "NDArray[np.float64]"


def compose_matrix(
    scale: ArrayLike | None = None,
    shear: ArrayLike | None = None,
    angles: ArrayLike | None = None,
    translate: ArrayLike | None = None,
    perspective: ArrayLike | None = None,
) -> Floats:
    """Return a matrix (4, 4) that applies scale (3), shear (xy, xz, yz), rotation, translation (3) and perspective (4).

    The angles are roll, pitch and yaw [rad]. Parts that are None have no effect.
    """
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


def decompose_matrix(matrix: ArrayLike) -> tuple[Floats, list[float], list[float], Floats, Floats]:
    """Return scale, shear, angles, translation and perspective of a matrix (4, 4), as for `compose_matrix`.

    Raises `ValueError` if the matrix is singular.
    """
    whole = np.array(matrix, dtype=np.float64)
    if abs(whole[3, 3]) < EPS:
        raise ValueError("M[3, 3] is zero")
    whole = whole / whole[3, 3]
    affine = whole.copy()
    affine[3, :] = 0, 0, 0, 1
    if abs(determinant(affine[:3, :3])) < EPS:
        raise ValueError("matrix is singular: it cannot be decomposed")
    perspective = matrix_product(whole[3, :], inverse_matrix(affine))
    rotation, upper = _orthogonal(affine[:3, :3])
    if determinant(rotation) < 0:
        rotation, upper = -rotation, -upper
    scale = np.diag(upper).copy()
    shear = [float(upper[0, 1] / scale[1]), float(upper[0, 2] / scale[2]), float(upper[1, 2] / scale[2])]
    return scale, shear, list(euler_from_matrix(rotation)), affine[:3, 3].copy(), perspective


def _orthogonal(linear: Floats) -> tuple[Floats, Floats]:
    """Factor a matrix (3, 3) into an orthogonal and an upper triangular one with a positive diagonal.

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
