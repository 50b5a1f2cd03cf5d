"""Products of matrices and vectors, with the same last bit on every processor.

`@`, `numpy.dot` and `numpy.linalg` call BLAS and LAPACK, whose kernels differ between processors in the order of
additions and in rounding. A robot that chooses between commands of equal cost would then drive
differently. The functions here multiply, add, divide and take square roots element by element, in a fixed order, for
which IEEE 754 defines every bit, and numpy's sums use a fixed order.

Use them for small matrices and for many points.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, TypeAlias

from rosmini.core.lazy import np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

Floats: TypeAlias = "NDArray[np.float64]"

MAX_SWEEPS = 50
"""Maximum number of sweeps; Jacobi's method converges in fewer than ten."""


def scalar_product(first: ArrayLike, second: ArrayLike) -> float:
    """Return the scalar product of two vectors (n,)."""
    one, other = np.asarray(first, dtype=np.float64), np.asarray(second, dtype=np.float64)
    return float((one * other).sum())


def matrix_product(first: ArrayLike, second: ArrayLike) -> Floats:
    """Return the product of an array of row vectors (..., k) and a matrix (k, m) or a vector (k,).

    The result is (..., m) or (...). Raises `ValueError` if the shapes do not match.
    """
    left, right = np.asarray(first, dtype=np.float64), np.asarray(second, dtype=np.float64)
    if left.shape[-1] != len(right):
        raise ValueError(f"matrices of shapes {left.shape} and {right.shape} have no product")
    rows = left.reshape(-1, left.shape[-1]).T
    columns = right[:, :, None] if right.ndim == 2 else right[:, None]
    result = columns[0] * rows[0]
    for column, row in zip(columns[1:], rows[1:], strict=True):
        result += column * row
    return np.ascontiguousarray(result.T).reshape(*left.shape[:-1], *right.shape[1:])


def norm(vector: ArrayLike) -> float:
    """Return the Euclidean length of a vector (n,)."""
    return math.sqrt(scalar_product(vector, vector))


def norms(vectors: ArrayLike) -> Floats:
    """Return the Euclidean lengths (...) of vectors (..., n)."""
    array = np.asarray(vectors, dtype=np.float64)
    lengths: Floats = np.sqrt((array * array).sum(axis=-1))
    return lengths


def determinant(matrix: ArrayLike) -> float:
    """Return the determinant of a matrix (3, 3)."""
    (a, b, c), (d, e, f), (g, h, i) = np.asarray(matrix, dtype=np.float64).tolist()
    return float(a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g))


def inverse_matrix(matrix: ArrayLike) -> Floats:
    """Return the inverse of a matrix (n, n), by Gauss-Jordan elimination with pivoting.

    Raises `numpy.linalg.LinAlgError` if the matrix is singular or not square.
    """
    given = np.asarray(matrix, dtype=np.float64)
    if given.ndim != 2 or given.shape[0] != given.shape[1]:
        raise np.linalg.LinAlgError(f"a matrix of shape {given.shape} has no inverse: it is not square")
    size = len(given)
    rows = np.hstack([given, np.identity(size)])
    for k in range(size):
        pivot = k + int(np.abs(rows[k:, k]).argmax())
        if rows[pivot, k] == 0.0:
            raise np.linalg.LinAlgError("Singular matrix")
        rows[[k, pivot]] = rows[[pivot, k]]
        rows[k] /= rows[k, k]
        factors = rows[:, k].copy()
        factors[k] = 0.0
        rows -= factors[:, None] * rows[k]
    return rows[:, size:].copy()


def eigen(matrix: ArrayLike) -> tuple[Floats, Floats]:
    """Return eigenvalues (n,) of a symmetric matrix (n, n), ascending, and its eigenvectors as columns (n, n).

    Uses Jacobi's method (Golub and Van Loan, Matrix Computations, section 8.5): each rotation makes one element 0.
    """
    table = np.array(matrix, dtype=np.float64)
    size = len(table)
    vectors = np.identity(size)
    for _ in range(MAX_SWEEPS):
        if not (table - np.diag(np.diag(table))).any():
            break
        for p in range(size - 1):
            for q in range(p + 1, size):
                _rotate(table, vectors, p, q)
    values, order = np.diag(table).tolist(), list(range(size))
    for i in range(size):  # equal eigenvalues are ordered as LAPACK's selection sort leaves them
        least = min(range(i, size), key=lambda k: values[order[k]])
        order[i], order[least] = order[least], order[i]
    return np.diag(table)[order], vectors[:, order]


def _rotate(table: Floats, vectors: Floats, p: int, q: int) -> None:
    """Apply one Jacobi rotation in place: make the elements (p, q) and (q, p) of the symmetric `table` 0.

    The eigenvectors in `vectors` rotate with it. Negligible elements are set to 0 without a rotation.
    """
    off, first, second = float(table[p, q]), float(table[p, p]), float(table[q, q])
    if off == 0.0:
        return
    if abs(off) <= 1e-17 * math.sqrt(abs(first) * abs(second)):
        table[p, q] = table[q, p] = 0.0
        return
    theta = (second - first) / (2.0 * off)
    tangent = math.copysign(1.0, theta) / (abs(theta) + math.sqrt(theta * theta + 1.0))
    cosine = 1.0 / math.sqrt(tangent * tangent + 1.0)
    sine = tangent * cosine
    for rows in (table, table.T, vectors.T):
        one, other = rows[p].copy(), rows[q].copy()
        rows[p], rows[q] = cosine * one - sine * other, sine * one + cosine * other
    table[p, q] = table[q, p] = 0.0
