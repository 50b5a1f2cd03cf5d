"""Products and decompositions agree with numpy's, and their last bits do not depend on BLAS."""

import os
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from rosmini.core.geometry import products as p

from ...processes import run

numbers = st.floats(-1e3, 1e3, allow_subnormal=False)
SHAPES = [((4, 4), (4, 4)), ((5, 3), (3, 3)), ((2, 5, 3), (3, 4)), ((3,), (3, 3)), ((6, 7), (7,)), ((0, 3), (3, 3))]

KERNELS = """
import numpy as np
from rosmini.core.geometry import products as p
table = np.random.default_rng(1).normal(size=(200, 3, 3))
found = [p.matrix_product(table.reshape(-1, 3), table[0])]
for one in table:
    found += [p.matrix_product(one, one), p.inverse_matrix(one)]
    found += [p.norm(one[0]), p.determinant(one), *p.eigen(one + one.T)]
print(b"".join(np.asarray(value).tobytes() for value in found).hex())
"""


@pytest.mark.parametrize(("first", "second"), SHAPES)
def test_matrix_product(first, second):
    random = np.random.default_rng(0)
    one, other = random.normal(size=first), random.normal(size=second)
    assert p.matrix_product(one, other).shape == (one @ other).shape
    assert p.matrix_product(one, other) == pytest.approx(one @ other)


def test_shapes_that_do_not_fit_are_refused():
    with pytest.raises(ValueError, match=r"\(2, 3\).*\(2, 2\)"):
        p.matrix_product(np.ones((2, 3)), np.ones((2, 2)))


@given(arrays(float, (3, 3), elements=numbers))
def test_an_inverse_undoes(matrix):
    matrix = matrix + 1e4 * np.identity(3)
    assert p.matrix_product(p.inverse_matrix(matrix), matrix) == pytest.approx(np.identity(3), abs=1e-9)


@pytest.mark.parametrize("matrix", [np.zeros((3, 3)), np.ones((2, 2)), np.ones((2, 3))])
def test_no_inverse(matrix):
    with pytest.raises(np.linalg.LinAlgError):
        p.inverse_matrix(matrix)


@given(arrays(float, (4, 4), elements=numbers))
def test_eigenvectors_are_orthogonal_and_give_the_matrix_back(half):
    matrix = half + half.T
    values, vectors = p.eigen(matrix)
    assert (np.diff(values) >= 0).all()
    assert vectors.T @ vectors == pytest.approx(np.identity(4), abs=1e-9)
    assert vectors @ np.diag(values) @ vectors.T == pytest.approx(matrix, abs=1e-9 * (1 + np.abs(matrix).max()))


def test_lengths_and_determinants():
    assert p.norm([2, 3, 6]) == 7
    assert p.norms([[3, 4], [0, 0]]).tolist() == [5, 0]
    assert p.determinant([[2, 0, 1], [0, 3, 0], [0, 0, 4]]) == 24
    assert p.scalar_product([1, 2], [3, 4]) == 11


@pytest.mark.skipif("OPENBLAS_CORETYPE" in os.environ, reason="the machine chooses its BLAS kernels itself")
def test_every_blas_kernel_gives_the_same_bits():
    found = {
        run([sys.executable, "-c", KERNELS], env={**os.environ, "OPENBLAS_CORETYPE": kernel}, check=True).stdout
        for kernel in ("Prescott", "Nehalem", "Haswell")
    }
    assert len(found) == 1
