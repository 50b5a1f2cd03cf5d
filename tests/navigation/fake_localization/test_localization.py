import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.tf.rigid import compose, from_yaw, matrix
from rosmini.navigation.fake_localization.localization import moved_offset, odom_in_map, offset

poses = st.builds(from_yaw, *[st.floats(-50, 50)] * 2, st.floats(-math.pi, math.pi))


def same(a, b):
    return np.allclose(matrix(a), matrix(b), atol=1e-9)


@given(poses, poses)
def test_both_are_true(base_in_map, base_in_odom):
    assert same(compose(odom_in_map(base_in_map, base_in_odom), base_in_odom), base_in_map)


@given(poses, poses, poses)
def test_a_moved_map_has_the_robot_where_it_was_wanted(true, before, wanted):
    assert same(compose(moved_offset(before, wanted, compose(before, true)), true), wanted)


def test_the_deltas_are_taken_off():
    assert same(compose(offset(1.0, 2.0, 0.0), from_yaw(3.0, 3.0, 0.5)), from_yaw(2.0, 1.0, 0.5))
    assert same(compose(offset(0.0, 0.0, math.pi / 2), from_yaw(1.0, 0.0, 0.0)), from_yaw(0.0, -1.0, -math.pi / 2))
