"""Homogeneous matrices (4, 4): made from translations and rotations, and converted back to them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, TypeAlias

from rosmini.core.geometry.products import eigen, matrix_product, norm, norms, scalar_product
from rosmini.core.lazy import np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

Floats: TypeAlias = "NDArray[np.float64]"

EPS = 8.881784197001252e-16
"""Four times the machine epsilon, as in ROS's module."""

UNIT_TOLERANCE = 1e-8
"""Tolerance in the check that a number is an eigenvalue."""


def vector_norm(data: ArrayLike, axis: int | None = None, out: Floats | None = None) -> float | Floats | None:
    """Return the Euclidean length along `axis`: a float if `axis` is None, and None if it is written to `out`."""
    squares = np.asarray(data, dtype=np.float64) ** 2
    if out is not None:
        np.sqrt(np.sum(squares, axis=axis), out=out)
        return None
    if axis is None:
        return math.sqrt(float(np.sum(squares)))
    result: Floats = np.sqrt(np.sum(squares, axis=axis))
    return result


def unit_vector(data: ArrayLike, axis: int | None = None, out: Floats | None = None) -> Floats | None:
    """Return the data normalised to length 1 along `axis`; None if written to `out`."""
    vectors = np.asarray(data, dtype=np.float64)
    length = np.sqrt(np.sum(vectors**2, axis=axis, keepdims=axis is not None))
    with np.errstate(invalid="ignore"):
        result: Floats = vectors / length
    if out is not None:
        out[...] = result
        return None
    return result


def unit(data: ArrayLike) -> Floats:
    """Return a vector (3) normalised to length 1."""
    vector = np.asarray(data, dtype=np.float64)[:3]
    result: Floats = vector / norm(vector)
    return result


def identity_matrix() -> Floats:
    """Return the identity matrix (4, 4)."""
    return np.identity(4)


def translation_matrix(direction: ArrayLike) -> Floats:
    """Return the matrix (4, 4) of a translation by a vector (3)."""
    result = np.identity(4)
    result[:3, 3] = np.asarray(direction, dtype=np.float64)[:3]
    return result


def translation_from_matrix(matrix: ArrayLike) -> Floats:
    """Return the translation (3) of a matrix (4, 4)."""
    return np.array(matrix, dtype=np.float64)[:3, 3].copy()


def about(linear: Floats, point: ArrayLike | None) -> Floats:
    """Return the matrix (4, 4) of a linear map (3, 3) that leaves `point` (by default the origin) unmoved."""
    result = np.identity(4)
    result[:3, :3] = linear
    if point is not None:
        fixed = np.asarray(point, dtype=np.float64)[:3]
        result[:3, 3] = fixed - matrix_product(linear, fixed)
    return result


def rotation_matrix(angle: float, direction: ArrayLike, point: ArrayLike | None = None) -> Floats:
    """Return the matrix (4, 4) of a rotation by an angle [rad] about the axis `direction` through `point`.

    By default, `point` is the origin.
    """
    x, y, z = axis = unit(direction)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    cosine, sine = math.cos(angle), math.sin(angle)
    return about(cosine * np.identity(3) + sine * cross + (1 - cosine) * axis[:, None] * axis, point)


def eigenvector(matrix: Floats, value: float) -> Floats:
    """Return an eigenvector of length 1 for an eigenvalue of a matrix (3, 3).

    Raises `ValueError` if `value` is not one of its eigenvalues.
    """
    rows = matrix - value * np.identity(3)
    # The eigenvector is perpendicular to all rows: parallel to the longest cross product of two, unless all are
    # parallel.
    row = rows[int(norms(rows).argmax())]
    size = norm(row)
    products = np.cross(rows, np.roll(rows, -1, axis=0))
    longest = products[int(norms(products).argmax())]
    if size < EPS:
        longest = np.array([0.0, 0.0, 1.0])
    elif norm(longest) < UNIT_TOLERANCE * size * size:
        longest = np.cross(row, np.identity(3)[int(np.abs(row).argmin())])
    result: Floats = longest / norm(longest)
    if norm(matrix_product(rows, result)) > UNIT_TOLERANCE:
        raise ValueError(
            f"no unit eigenvector corresponding to eigenvalue {value:g}: the matrix is not what it should be"
        )
    return result


def fixed_point(matrix: Floats) -> Floats:
    """Return a fixed point (x, y, z, 1) of a matrix (4, 4). Raises `ValueError` if there is none."""
    linear, moved = matrix[:3, :3], matrix[:3, 3]
    rows = np.identity(3) - linear
    values, axes = eigen(matrix_product(rows.T, rows))
    known = values > 1e-14 * max(values[-1], EPS)  # along the other axes use 0: the shortest solution
    parts = matrix_product(axes.T, matrix_product(rows.T, moved)) * known / np.where(known, values, 1.0)
    point = matrix_product(axes, parts)
    if not np.allclose(matrix_product(linear, point) + moved, point, atol=1e-6 * max(1.0, float(np.abs(moved).max()))):
        raise ValueError("no unit eigenvector corresponding to eigenvalue 1: the matrix leaves no point where it is")
    return np.append(point, 1.0)


def rotation_from_matrix(matrix: ArrayLike) -> tuple[float, Floats, Floats]:
    """Return angle [rad], axis (3) and a point (4) on the axis of a rotation matrix (4, 4).

    Raises `ValueError` if the matrix is not a rotation.
    """
    whole = np.asarray(matrix, dtype=np.float64)
    linear = whole[:3, :3]
    axis = eigenvector(linear.T, 1.0)
    point = fixed_point(whole)
    cosine = (np.trace(linear) - 1.0) / 2.0
    turns = linear[2, 1] - linear[1, 2], linear[0, 2] - linear[2, 0], linear[1, 0] - linear[0, 1]
    sine = 0.5 * scalar_product(axis, turns)
    return math.atan2(sine, cosine), axis, point


def concatenate_matrices(*matrices: ArrayLike) -> Floats:
    """Return the product of matrices (4, 4) in the given order: the last one is applied first."""
    result = np.identity(4)
    for matrix in matrices:
        result = matrix_product(result, matrix)
    return result


def is_same_transform(matrix0: ArrayLike, matrix1: ArrayLike) -> bool:
    """Return whether two matrices (4, 4) are equal up to a factor."""
    first = np.array(matrix0, dtype=np.float64)
    second = np.array(matrix1, dtype=np.float64)
    return bool(np.allclose(first / first[3, 3], second / second[3, 3]))
