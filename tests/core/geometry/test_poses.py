"""Poses against homogeneous matrices and against many small steps."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.geometry.poses import arc, compose, inverse, transform_points

numbers = st.floats(-100, 100)
poses = st.tuples(numbers, numbers, st.floats(-10, 10))


def matrix(pose):
    x, y, theta = pose
    c, s = math.cos(theta), math.sin(theta)
    return np.array([[c, -s, x], [s, c, y], [0, 0, 1]])


@given(poses, poses)
def test_composing_is_multiplying_matrices(a, b):
    np.testing.assert_allclose(matrix(compose(a, b)), matrix(a) @ matrix(b), rtol=0, atol=1e-12)
    assert compose(a, b)[2] == a[2] + b[2]


@given(poses)
def test_a_pose_and_its_inverse_cancel(pose):
    np.testing.assert_allclose(compose(pose, inverse(pose)), (0, 0, 0), atol=1e-12)
    np.testing.assert_allclose(compose(inverse(pose), pose), (0, 0, 0), atol=1e-12)


@given(st.lists(st.tuples(poses, poses), min_size=1, max_size=5))
def test_arrays_are_composed_and_inverted_as_tuples_are(pairs):
    first, second = np.array([a for a, _ in pairs]), np.array([b for _, b in pairs])
    np.testing.assert_allclose(compose(first, second), [compose(a, b) for a, b in pairs], rtol=1e-15, atol=1e-13)
    np.testing.assert_allclose(compose(pairs[0][0], second), [compose(pairs[0][0], b) for _, b in pairs], atol=1e-13)
    np.testing.assert_allclose(inverse(first), [inverse(a) for a, _ in pairs], atol=1e-13)


@given(poses, st.lists(st.tuples(numbers, numbers), max_size=5))
def test_points_are_moved_as_matrices_move_them(pose, points):
    array = np.array(points).reshape(-1, 2)
    expected = (matrix(pose) @ np.column_stack([array, np.ones(len(array))]).T)[:2].T
    np.testing.assert_allclose(transform_points(pose, array), expected, rtol=0, atol=1e-12)


def test_a_quarter_of_a_circle():
    v, w = 0.22, 0.44
    pose = arc((0.0, 0.0, 0.0), v, w, math.pi / 2 / w)
    np.testing.assert_allclose(pose, (v / w, v / w, math.pi / 2), rtol=1e-15)


@given(poses, st.floats(-2, 2), st.floats(-3, 3), st.floats(0, 5), st.integers(1, 7))
def test_one_long_arc_is_many_short_ones(pose, v, w, dt, parts):
    end = pose
    for _ in range(parts):
        end = arc(end, v, w, dt / parts)
    np.testing.assert_allclose(end, arc(pose, v, w, dt), rtol=0, atol=1e-12)


@given(st.floats(0.01, 2), st.floats(-1e-7, 1e-7), st.floats(0, 5))
def test_an_arc_that_is_almost_straight_loses_no_digits(v, w, dt):
    x, y, theta = arc((0.0, 0.0, 0.0), v, w, dt)
    assert x == pytest.approx(v * dt, rel=1e-12)
    assert y == pytest.approx(v * dt * w * dt / 2, rel=1e-12, abs=1e-300)
    assert theta == w * dt


@given(poses, st.lists(st.tuples(st.floats(-2, 2), st.floats(-3, 3)), min_size=1, max_size=5))
def test_arrays_move_as_tuples_do(pose, speeds):
    v, w = np.array(speeds).T
    expected = [arc(pose, one, other, 0.3) for one, other in speeds]
    np.testing.assert_allclose(arc(pose, v, w, 0.3), expected, rtol=0, atol=1e-13)
    np.testing.assert_allclose(arc(np.tile(pose, (len(v), 1)), v, w, 0.3), expected, rtol=0, atol=1e-13)
