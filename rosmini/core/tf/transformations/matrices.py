"""Homogeneous matrices (4, 4) of translations, rotations, scalings, reflections and shears, and their parameters."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rosmini.core.geometry.products import eigen, matrix_product, norm, norms, scalar_product

Floats = NDArray[np.float64]

EPS = 8.881784197001252e-16
"""Four times the machine epsilon, as in ROS's module."""

UNIT_TOLERANCE = 1e-8
"""Tolerance of a test for an eigenvalue."""


def vector_norm(data: ArrayLike, axis: int | None = None, out: Floats | None = None) -> float | Floats | None:
    """Return the Euclidean length along `axis`: a float for a vector without an axis; None if written to `out`."""
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
    """Return the identity matrix."""
    return np.identity(4)


def translation_matrix(direction: ArrayLike) -> Floats:
    """Return the matrix of a translation by a vector (3)."""
    result = np.identity(4)
    result[:3, 3] = np.asarray(direction, dtype=np.float64)[:3]
    return result


def translation_from_matrix(matrix: ArrayLike) -> Floats:
    """Return the translation (3) of a matrix."""
    return np.array(matrix, dtype=np.float64)[:3, 3].copy()


def about(linear: Floats, point: ArrayLike | None) -> Floats:
    """Return a linear map (3, 3) as a matrix with `point`, or the origin, as fixed point."""
    result = np.identity(4)
    result[:3, :3] = linear
    if point is not None:
        fixed = np.asarray(point, dtype=np.float64)[:3]
        result[:3, 3] = fixed - matrix_product(linear, fixed)
    return result


def rotation_matrix(angle: float, direction: ArrayLike, point: ArrayLike | None = None) -> Floats:
    """Return the rotation by an angle [rad] about the axis through `point` (the origin) along `direction`."""
    x, y, z = axis = unit(direction)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    cosine, sine = math.cos(angle), math.sin(angle)
    return about(cosine * np.identity(3) + sine * cross + (1 - cosine) * axis[:, None] * axis, point)


def eigenvector(matrix: Floats, value: float) -> Floats:
    """Return an eigenvector of length 1 for an eigenvalue of a matrix (3, 3).

    Raises `ValueError` if that is not one of its eigenvalues.
    """
    rows = matrix - value * np.identity(3)
    # It is perpendicular to all rows: along the longest cross product of two of them, unless all are parallel.
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
    """Return a fixed point (4, the last element 1) of a matrix. Raises `ValueError` if there is none."""
    linear, moved = matrix[:3, :3], matrix[:3, 3]
    rows = np.identity(3) - linear
    values, axes = eigen(matrix_product(rows.T, rows))
    known = values > 1e-14 * max(values[-1], EPS)  # along the other axes use 0: the shortest solution
    parts = matrix_product(axes.T, matrix_product(rows.T, moved)) * known / np.where(known, values, 1.0)
    point = matrix_product(axes, parts)
    if not np.allclose(
        matrix_product(linear, point) + moved, point, atol=1e-6 * max(1.0, float(np.abs(moved).max()))
    ):
        raise ValueError(
            "no unit eigenvector corresponding to eigenvalue 1: the matrix leaves no point where it is"
        )
    return np.append(point, 1.0)


def rotation_from_matrix(matrix: ArrayLike) -> tuple[float, Floats, Floats]:
    """Return angle [rad], axis (3) and a point (4) on it. Raises `ValueError` if the matrix is not a rotation."""
    whole = np.asarray(matrix, dtype=np.float64)
    linear = whole[:3, :3]
    axis = eigenvector(linear.T, 1.0)
    point = fixed_point(whole)
    cosine = (np.trace(linear) - 1.0) / 2.0
    turns = linear[2, 1] - linear[1, 2], linear[0, 2] - linear[2, 0], linear[1, 0] - linear[0, 1]
    sine = 0.5 * scalar_product(axis, turns)
    return math.atan2(sine, cosine), axis, point


def scale_matrix(
    factor: float, origin: ArrayLike | None = None, direction: ArrayLike | None = None
) -> Floats:
    """Return a scaling by `factor` about `origin`, in all directions or along `direction` only.

    A factor of -1 is a point reflection.
    """
    if direction is None:
        return about(factor * np.identity(3), origin)
    axis = unit(direction)
    return about(np.identity(3) - (1.0 - factor) * axis[:, None] * axis, origin)


def scale_from_matrix(matrix: ArrayLike) -> tuple[float, Floats, Floats | None]:
    """Return factor, fixed point (4) and direction (3; None: all) of a scaling.

    Raises `ValueError` if the matrix is not a scaling.
    """
    whole = np.asarray(matrix, dtype=np.float64)
    linear = whole[:3, :3]
    along = float(np.trace(linear)) - 2.0
    try:
        direction: Floats | None = eigenvector(linear, along)
        factor = along
    except ValueError:
        factor, direction = (along + 2.0) / 3.0, None
    return factor, fixed_point(whole), direction


def reflection_matrix(point: ArrayLike, normal: ArrayLike) -> Floats:
    """Return the reflection at the plane through `point` with this normal (Householder)."""
    axis = unit(normal)
    return about(np.identity(3) - 2.0 * axis[:, None] * axis, point)


def reflection_from_matrix(matrix: ArrayLike) -> tuple[Floats, Floats]:
    """Return a point (4) on the mirror plane and its normal (3). Raises `ValueError` if it is not a reflection."""
    whole = np.asarray(matrix, dtype=np.float64)
    return fixed_point(whole), eigenvector(whole[:3, :3], -1.0)


def shear_matrix(angle: float, direction: ArrayLike, point: ArrayLike, normal: ArrayLike) -> Floats:
    """Return a shear by an angle [rad] along `direction`, in the plane through `point` with this normal.

    Raises `ValueError` if the direction is not in the plane.
    """
    axis, across = unit(direction), unit(normal)
    if abs(scalar_product(axis, across)) > 1e-6:
        raise ValueError(
            f"direction and normal vectors are not orthogonal: their product is {scalar_product(axis, across):.3g}"
        )
    return about(np.identity(3) + math.tan(angle) * axis[:, None] * across, point)


def superimposition_matrix(
    v0: ArrayLike, v1: ArrayLike, scaling: bool = False, usesvd: bool = True
) -> Floats:
    """Return the motion that brings the points `v0` (3, n) closest to `v1` (3, n), by least squares.

    With `scaling`, also scale. Always uses quaternions (Horn, 1987), whatever `usesvd` is. Raises
    `ValueError` for fewer than three points.
    """
    del usesvd
    first = np.array(v0, dtype=np.float64)[:3]
    second = np.array(v1, dtype=np.float64)[:3]
    if first.shape != second.shape or first.shape[1] < 3:
        raise ValueError(
            f"two sets of the same three or more points are needed, not {first.shape} and {second.shape}"
        )
    middle, target = first.mean(axis=1), second.mean(axis=1)
    centred, wanted = first - middle[:, None], second - target[:, None]
    linear = _nearest_rotation(matrix_product(centred, wanted.T))
    if scaling:
        linear = linear * math.sqrt(float(np.sum(wanted**2) / np.sum(centred**2)))
    result = np.identity(4)
    result[:3, :3] = linear
    result[:3, 3] = target - matrix_product(linear, middle)
    return result


def _nearest_rotation(spread: Floats) -> Floats:
    """Return the best rotation (3, 3) between two sets of points, from the sums (3, 3) of products of coordinates.

    It is the eigenvector of the largest eigenvalue (Horn, Closed-form solution of absolute orientation using
    unit quaternions, 1987).
    """
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = spread.tolist()
    _, axes = eigen(
        [
            [xx + yy + zz, yz - zy, zx - xz, xy - yx],
            [yz - zy, xx - yy - zz, xy + yx, zx + xz],
            [zx - xz, xy + yx, yy - xx - zz, yz + zy],
            [xy - yx, zx + xz, yz + zy, zz - xx - yy],
        ]
    )
    w, x, y, z = axes[:, -1].tolist()
    return np.array(
        [
            [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
        ]
    )


def concatenate_matrices(*matrices: ArrayLike) -> Floats:
    """Return the product of matrices, in this order: the last one is applied first."""
    result = np.identity(4)
    for matrix in matrices:
        result = matrix_product(result, matrix)
    return result


def is_same_transform(matrix0: ArrayLike, matrix1: ArrayLike) -> bool:
    """Return whether two matrices are equal up to a factor."""
    first = np.array(matrix0, dtype=np.float64)
    second = np.array(matrix1, dtype=np.float64)
    return bool(np.allclose(first / first[3, 3], second / second[3, 3]))
