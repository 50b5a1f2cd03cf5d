"""Angles against complex numbers and against the standard library's exact remainder."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.geometry.angles import (
    normalize_angle,
    quaternion_from_yaw,
    shortest_angular_distance,
    yaw_from_quaternion,
)
from rosmini.core.geometry.errors import GeometryError

angles = st.floats(-1e6, 1e6)
inside = st.floats(-math.pi, math.pi, exclude_min=True)


@pytest.mark.parametrize(
    ("angle", "wrapped"),
    [
        (0.0, 0.0),
        (math.pi, math.pi),
        (-math.pi, math.pi),
        (math.nextafter(-math.pi, 0), math.nextafter(-math.pi, 0)),
        (3 * math.pi, math.pi),
        (-3 * math.pi, math.pi),
        (2 * math.pi, 0.0),
        (7.0, 7.0 - 2 * math.pi),
        (-1e-20, -1e-20),
    ],
)
def test_angles_are_wrapped_to_a_half_open_turn(angle, wrapped):
    assert normalize_angle(angle) == wrapped
    assert normalize_angle(np.array([angle]))[0] == wrapped


@given(angles)
def test_wrapping_is_the_exact_remainder(angle):
    exact = math.remainder(angle, 2 * math.pi)
    assert normalize_angle(angle) == (math.pi if exact == -math.pi else exact)


@given(st.lists(st.floats(), max_size=8))
def test_an_array_is_wrapped_as_its_numbers_are(numbers):
    given_array = np.array(numbers)
    before = given_array.copy()
    wrapped = normalize_angle(given_array)
    np.testing.assert_array_equal(wrapped, [normalize_angle(number) for number in numbers])
    np.testing.assert_array_equal(given_array, before)


def test_no_direction_has_no_wrapped_form():
    assert math.isnan(normalize_angle(math.inf))
    assert math.isnan(normalize_angle(math.nan))


@given(inside, inside)
def test_the_distance_leads_from_start_to_end_by_at_most_half_a_turn(start, end):
    distance = shortest_angular_distance(start, end)
    assert -math.pi < distance <= math.pi
    assert abs(cmath.rect(1, start + distance) - cmath.rect(1, end)) < 1e-14


@given(inside)
def test_a_yaw_survives_its_quaternion(yaw):
    quaternion = quaternion_from_yaw(yaw)
    assert math.hypot(*quaternion) == pytest.approx(1, abs=1e-15)
    assert abs(shortest_angular_distance(yaw_from_quaternion(*quaternion), yaw)) < 1e-15


@given(st.floats(-3, 3), st.floats(-1.5, 1.5), st.floats(-3, 3), st.floats(0.1, 10))
def test_yaw_is_the_angle_about_z_of_yaw_pitch_roll(yaw, pitch, roll, length):
    cy, sy, cp, sp = math.cos(yaw / 2), math.sin(yaw / 2), math.cos(pitch / 2), math.sin(pitch / 2)
    cr, sr = math.cos(roll / 2), math.sin(roll / 2)
    x, y = sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy
    z, w = cr * cp * sy - sr * sp * cy, cr * cp * cy + sr * sp * sy
    found = yaw_from_quaternion(length * x, length * y, length * z, length * w)
    assert abs(shortest_angular_distance(found, yaw)) < 1e-12


@pytest.mark.parametrize("numbers", [(0, 0, 0, 0), (math.nan, 0, 0, 1), (0, 0, math.inf, 1)])
def test_what_is_no_rotation_is_refused(numbers):
    with pytest.raises(GeometryError, match=r"is not a rotation.*w=1"):
        yaw_from_quaternion(*numbers)
