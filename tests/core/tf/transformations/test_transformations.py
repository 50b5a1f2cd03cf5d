"""tf.transformations by closed forms; `tests/interop` compares every function with the real one."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.tf import transformations as t

angles = st.floats(-math.pi, math.pi)
ORDERS = [frame + a + b + c for frame in "sr" for a in "xyz" for b in "xyz" for c in "xyz" if b not in (a, c)]


def turn(axis, angle):
    return t.rotation_matrix(angle, np.eye(3)["xyz".index(axis)])


@given(st.sampled_from(ORDERS), angles, angles, angles)
def test_euler_angles_are_three_turns(axes, a, b, c):
    turns = [turn(axis, angle) for axis, angle in zip(axes[1:], (a, b, c), strict=True)]
    whole = t.concatenate_matrices(*(turns if axes[0] == "r" else turns[::-1]))
    assert np.allclose(t.euler_matrix(a, b, c, axes), whole, atol=1e-9)
    assert np.allclose(t.euler_matrix(*t.euler_from_matrix(whole, axes), axes), whole, atol=1e-7)


@given(angles, angles, angles, st.floats(0, 1))
def test_quaternions_are_rotations(a, b, c, fraction):
    one, other = t.quaternion_from_euler(a, b, c), t.quaternion_about_axis(c, [1, 2, 3])
    product = t.quaternion_matrix(t.quaternion_multiply(one, other))
    assert np.allclose(product, t.quaternion_matrix(one) @ t.quaternion_matrix(other), atol=1e-9)
    assert np.allclose(t.quaternion_matrix(t.quaternion_from_matrix(product)), product, atol=1e-7)
    assert np.allclose(t.quaternion_multiply(one, t.quaternion_inverse(one)), [0, 0, 0, 1], atol=1e-9)
    assert t.vector_norm(t.quaternion_slerp(one, other, fraction)) == pytest.approx(1)


def test_a_quarter_turn():
    assert t.quaternion_from_euler(0, 0, math.pi / 2) == pytest.approx([0, 0, math.sqrt(0.5), math.sqrt(0.5)])
    angle, axis, point = t.rotation_from_matrix(t.rotation_matrix(0.5, [0, 0, 2], [1, 2, 0]))
    assert angle * axis[2] == pytest.approx(0.5)
    assert point[:2] == pytest.approx([1, 2])


@pytest.mark.parametrize(
    ("call", "error"),
    [
        (lambda: t.rotation_from_matrix(np.diag([2, 3, 4, 1.0])), "eigenvalue 1"),
        (lambda: t.rotation_from_matrix(t.translation_matrix([1, 0, 0])), "leaves no point"),
        (lambda: t.decompose_matrix(np.zeros((4, 4))), "zero"),
        (lambda: t.decompose_matrix(np.diag([0, 1, 1, 1.0])), "singular"),
    ],
)
def test_what_cannot_be_done(call, error):
    with pytest.raises(ValueError, match=error):
        call()
