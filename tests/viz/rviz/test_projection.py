"""What an eye sees."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.viz.rviz.projection import HORIZON, NOWHERE, Perspective, parallel_projection
from rosmini.viz.rviz.views import Viewpoint

SIGHTS = st.builds(
    lambda x, y, yaw, pitch, width: Viewpoint(np.array([x, y, 0.0]), yaw, pitch, width, is_flat=False),
    st.floats(-20, 20), st.floats(-20, 20), st.floats(-math.pi, math.pi), st.floats(0.2, 1.5), st.floats(0.5, 40),
)  # fmt: skip


AHEAD = np.array([(0.0, -1.0, 0.0), (0.0, 0.0, 1.0), (-1.0, 0.0, 0.0)])


@given(SIGHTS, st.floats(-0.45, 0.45), st.floats(-0.45, 0.1))
def test_a_point_of_the_ground_is_found_again_where_it_is_seen(viewpoint, right, up):
    look = Perspective.of(viewpoint, 640.0, 400.0)
    assert look.pixels(viewpoint.target[None])[0] == pytest.approx([320.0, 200.0], abs=1e-6)
    assert np.linalg.norm(look.eye - viewpoint.target) == pytest.approx(viewpoint.distance)
    pixel = (320 + 640 * right, 200 - 400 * up)
    if up < -0.4 or look.ray(*pixel)[1][2] < -0.05:
        at = np.array(look.metres(*pixel))
        assert at[2] == 0.0
        assert look.pixels(at[None])[0] == pytest.approx(pixel, abs=1e-5)
        eye, ahead = look.ray(*pixel)
        assert np.cross(at - eye, ahead) == pytest.approx(0.0, abs=1e-6 * (1 + np.linalg.norm(at - eye)))


def test_a_camera_sees_its_field_of_view_from_bottom_to_top():
    look = Perspective(np.array([-2.0, 0.0, 0.0]), AHEAD, 2.0, 100.0, (150.0, 100.0), 300.0, 200.0)
    corners = np.array([(0.0, 0.0, 2.0), (0.0, 0.0, -2.0), (0.0, 3.0, 0.0), (-3.0, 0.0, 0.0)])
    assert look.pixels(corners)[:3] == pytest.approx(np.array([(150, 0), (150, 200), (0, 100)]))
    assert look.pixels(corners)[3].tolist() == [NOWHERE, NOWHERE]


def test_above_the_horizon_a_hand_is_far_away_in_that_direction():
    look = Perspective(np.array([0.0, 0.0, 1.0]), AHEAD, 5.0, 241.4, (150.0, 100.0), 300.0, 200.0)
    assert look.metres(150.0, 20.0) == pytest.approx((HORIZON, 0.0, 0.0))
    x, y, _ = look.metres(0.0, 20.0)
    assert (math.hypot(x, y), y > 0) == (pytest.approx(HORIZON), True)


def test_without_perspective_lines_of_sight_are_parallel():
    look = parallel_projection(Viewpoint(np.zeros(3), 0.3, 0.8, 4.0), [], 400.0, 200.0)
    for pixel in ((0.0, 0.0), (200.0, 100.0), (399.0, 150.0)):
        start, ahead = look.ray(*pixel)
        at = np.array(look.metres(*pixel))
        assert np.cross(at - start, ahead) == pytest.approx(0.0, abs=1e-6)
        assert ahead == pytest.approx(-look.axes[2])
