"""Rigid transforms form a group; numbers from closed forms and from matrices."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.tf.errors import InvalidArgumentException
from rosmini.core.tf.rigid import (
    compose,
    from_rpy,
    from_yaw,
    interpolate,
    inverse,
    matrix,
    rigid,
    rotate,
    rpy,
    transform_points,
)

metres = st.floats(-100, 100)
angles = st.floats(-math.pi, math.pi)
transforms = st.builds(lambda x, y, z, r, p, w: from_rpy((x, y, z), r, p, w), *[metres] * 3, *[angles] * 3)


def same(a, b, tolerance=1e-9):
    """The same transform; a quaternion and its negative are one rotation."""
    return np.allclose(matrix(a), matrix(b), atol=tolerance)


@given(transforms, transforms)
def test_composition_is_the_product_of_matrices(a, b):
    assert np.allclose(matrix(compose(a, b)), matrix(a) @ matrix(b), atol=1e-9)
    assert np.allclose(matrix(inverse(a)), np.linalg.inv(matrix(a)), atol=1e-9)


def angle_between(a, b):
    """By how much one rotation is turned against another: the angle of a^-1 b."""
    *_, i, j, k, w = compose(inverse(a), b)
    return 2 * math.atan2(math.sqrt(i * i + j * j + k * k), abs(w))


@given(transforms, transforms, st.floats(0, 1))
def test_interpolation_stays_between_its_bounds(a, b, fraction):
    middle = interpolate(a, b, fraction)
    for low, high, value in zip(a[:3], b[:3], middle[:3], strict=True):
        assert min(low, high) - 1e-9 <= value <= max(low, high) + 1e-9
    assert math.dist(middle[3:], (0, 0, 0, 0)) == pytest.approx(1)
    whole = angle_between(a, b)
    assert angle_between(a, middle) == pytest.approx(fraction * whole, abs=1e-6)
    assert angle_between(middle, b) == pytest.approx((1 - fraction) * whole, abs=1e-6)


@given(transforms, transforms)
def test_interpolation_begins_and_ends_at_its_bounds(a, b):
    assert same(interpolate(a, b, 0), a)
    assert same(interpolate(a, b, 1), b, 1e-8)


@given(angles, st.floats(-1.5, 1.5), angles)
def test_roll_pitch_yaw_and_back(roll, pitch, yaw):
    assert same(from_rpy((1, 2, 3), *rpy(from_rpy((0, 0, 0), roll, pitch, yaw))), from_rpy((1, 2, 3), roll, pitch, yaw))


@pytest.mark.parametrize("pitch", [math.pi / 2, -math.pi / 2])
def test_straight_up_and_down(pitch):
    whole = from_rpy((0, 0, 0), 0.3, pitch, 0.8)
    assert rpy(whole)[2] == 0
    assert same(from_rpy((0, 0, 0), *rpy(whole)), whole, 1e-6)


def test_numbers_by_hand():
    quarter = from_yaw(1, 2, math.pi / 2)
    assert transform_points(quarter, [[1, 0, 0], [0, 0, 5]]) == pytest.approx(np.array([[1, 3, 0], [1, 2, 5]]))
    assert rotate(quarter, [1, 0, 0]) == pytest.approx(np.array([0, 1, 0]))
    assert compose(quarter, quarter)[:3] == pytest.approx((-1, 3, 0))
    # Yaw about the fixed z comes last: x, rolled, pitched down by 90 degrees, points down, and yaw leaves it there.
    assert rotate(from_rpy((0, 0, 0), 0.4, math.pi / 2, 1.0), [1, 0, 0]) == pytest.approx(np.array([0, 0, -1]))


def test_a_quaternion_is_brought_to_length_one_or_refused():
    assert rigid((1, 2, 3), (0, 0, 2, 0)) == (1, 2, 3, 0, 0, 1, 0)
    with pytest.raises(InvalidArgumentException, match="w=0"):
        rigid((0, 0, 0), (0, 0, 0, 0))
    with pytest.raises(InvalidArgumentException, match="z=nan"):
        rigid((0, 0, 0), (0, 0, math.nan, 1))
