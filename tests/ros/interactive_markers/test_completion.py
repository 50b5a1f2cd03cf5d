"""What RViz fills in: handles, sizes, orientations, names."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.msgs import message_class
from rosmini.ros.interactive_markers import auto_complete, title_control

from .conftest import marker

Control = message_class("visualization_msgs/InteractiveMarkerControl")
Marker = message_class("visualization_msgs/Marker")
Quaternion = message_class("geometry_msgs/Quaternion")


def points(shape: Any) -> np.ndarray[Any, Any]:
    return np.array([(one.x, one.y, one.z) for one in shape.points])


def test_an_axis_gets_two_arrows_as_wide_as_the_marker():
    made = marker("box", Control.MOVE_AXIS)
    made.scale = 2.0
    made.controls[0].orientation = Quaternion(0.0, 0.0, 1.0, 1.0)
    auto_complete(made)
    shapes = made.controls[0].markers
    assert [shape.type for shape in shapes] == [Marker.ARROW, Marker.ARROW]
    assert [points(shape)[:, 0].tolist() for shape in shapes] == [[1.0, 1.8], [-1.0, -1.8]]
    color = shapes[0].color
    assert (color.r, color.g, color.b, color.a) == pytest.approx((0, 1, 0, 0.5))
    q = shapes[0].pose.orientation
    assert (q.z, q.w) == pytest.approx((math.sqrt(0.5),) * 2)


@pytest.mark.parametrize(
    ("mode", "colors"), [(Control.MOVE_PLANE, 0), (Control.ROTATE_AXIS, 72), (Control.MOVE_ROTATE, 72)]
)
def test_planes_and_rotations_get_a_ring_around_x(mode, colors):
    made = marker("box", mode)
    auto_complete(made)
    (ring,) = made.controls[0].markers
    radii = np.linalg.norm(points(ring)[:, 1:], axis=1)
    assert (ring.type, len(ring.points), len(ring.colors)) == (Marker.TRIANGLE_LIST, 216, colors)
    assert not points(ring)[:, 0].any()
    assert {round(float(radius), 6) for radius in radii} == {0.5, 0.65}
    corners = points(ring).reshape(-1, 3, 3)[:, :, 1:]
    edges = corners[:, 1:] - corners[:, :1]
    areas = np.abs(edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 0, 1] * edges[:, 1, 0]) / 2
    assert areas.sum() == pytest.approx(math.pi * (0.65**2 - 0.5**2), rel=0.02)


def test_a_menu_without_markers_is_a_text_and_a_button_nothing():
    made = marker("box", Control.MENU, Control.BUTTON, Control.NONE)
    made.controls[0].description = "Options"
    auto_complete(made)
    menu, *rest = made.controls
    assert (menu.orientation_mode, menu.markers[0].text) == (Control.VIEW_FACING, "Options")
    assert [one.markers for one in rest] == [[], []]


def test_names_become_unique_and_zeros_become_one():
    made = marker("box", Control.BUTTON, Control.BUTTON, Control.BUTTON)
    for control in made.controls:
        control.name, control.markers = "same", [Marker(type=Marker.CUBE)]
    auto_complete(made)
    assert len({control.name for control in made.controls}) == 3
    assert made.scale == 1.0
    assert made.pose.orientation.w == 1.0
    assert [control.markers[0].scale.x for control in made.controls] == [1.0] * 3
    assert [control.markers[0].id for control in made.controls] == [0, 1, 2]
    assert {control.markers[0].ns for control in made.controls} == {"box"}


def test_a_marker_without_controls_is_left_alone():
    made = marker("box")
    auto_complete(made)
    assert (made.scale, made.pose.orientation.w) == (0.0, 0.0)


def test_the_title_stands_above():
    made = marker("box", Control.MOVE_3D)
    made.scale = 2.0
    (text,) = title_control(made).markers
    assert (text.text, text.pose.position.z, text.scale.z) == ("the box", 2.8, 0.3)


numbers = st.floats(-1e6, 1e6, allow_subnormal=False)


@given(st.lists(st.tuples(st.integers(0, 9), st.lists(numbers, min_size=4, max_size=4)), max_size=4), numbers)
def test_whatever_comes_is_completed_once(controls, scale):
    made = marker("box", *(mode for mode, _ in controls))
    made.scale = scale
    for control, (_, turned) in zip(made.controls, controls, strict=True):
        control.orientation = Quaternion(*turned)
    auto_complete(made)
    for shape in (shape for control in made.controls for shape in control.markers):
        q = shape.pose.orientation
        assert math.hypot(q.x, q.y, q.z, q.w) == pytest.approx(1)
        assert all(np.isfinite([shape.color.r, shape.color.g, shape.color.b]))
    before = [(control.name, [shape.type for shape in control.markers]) for control in made.controls]
    auto_complete(made)
    assert [(control.name, [shape.type for shape in control.markers]) for control in made.controls] == before
