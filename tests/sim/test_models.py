"""The numbers of the robots, and finding a robot by its name."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.sim.models import BURGER, WAFFLE, WAFFLE_PI, ModelError, UnknownModel, hull, model
from rosmini.sim.shapes import Box


def test_the_burger_is_the_published_one():
    assert (BURGER.mass, BURGER.height) == (1.0, 0.192)
    assert (BURGER.max_linear, BURGER.max_angular) == (0.22, 2.84)
    assert (BURGER.wheel_radius, BURGER.wheel_separation) == (0.033, 0.160)
    assert BURGER.lidar.mount == (-0.032, 0.0, 0.182)
    assert (BURGER.lidar.beams, BURGER.lidar.rate) == (360, 5.0)
    assert (BURGER.lidar.range_min, BURGER.lidar.range_max) == (0.12, 3.5)
    assert (BURGER.rate, BURGER.imu.rate, BURGER.ticks_per_turn) == (30.0, 200.0, 4096)


def test_the_footprint_is_counter_clockwise_and_reaches_as_far_as_it_says():
    corners = BURGER.footprint
    area = sum(ax * by - bx * ay for (ax, ay), (bx, by) in zip(corners, corners[1:] + corners[:1], strict=True)) / 2
    assert area == pytest.approx(0.146 * 0.21)
    assert BURGER.reach == pytest.approx(0.105 * 2**0.5)


def test_a_model_by_name_by_environment_and_by_default(monkeypatch):
    monkeypatch.delenv("TURTLEBOT3_MODEL", raising=False)
    assert model() is model("burger") is BURGER
    monkeypatch.setenv("TURTLEBOT3_MODEL", "burger")
    assert model() is BURGER


@pytest.mark.parametrize("name", ["waffle", "waffle_pi"])
def test_the_environment_chooses_a_waffle(monkeypatch, name):
    monkeypatch.setenv("TURTLEBOT3_MODEL", name)
    assert model().name == name
    monkeypatch.setenv("TURTLEBOT3_MODEL", "wafle")
    with pytest.raises(
        UnknownModel, match=r"'wafle' .from the environment variable TURTLEBOT3_MODEL.*did you mean waffle"
    ):
        model()


@pytest.mark.parametrize("waffle", [WAFFLE, WAFFLE_PI])
def test_the_waffles_numbers_are_the_published_ones(waffle):
    assert (waffle.max_linear, waffle.max_angular) == (0.26, 1.82)
    assert (waffle.wheel_radius, waffle.wheel_separation, waffle.mass) == (0.033, 0.287, 1.8)
    # 77 turns of the wheel a minute, and the same on the circle on which the wheels go
    assert 0.033 * 2 * math.pi * 77 / 60 == pytest.approx(waffle.max_linear, abs=0.01)
    assert waffle.max_linear / (waffle.wheel_separation / 2) == pytest.approx(waffle.max_angular, abs=0.01)
    assert waffle.laser.mount == (-0.064, 0.0, 0.132)
    assert waffle.laser.beams == 360
    assert waffle.unit.mount == (0.0, 0.0, 0.078)


def test_the_waffles_have_cameras_and_the_burger_has_none():
    assert BURGER.cameras == ()
    (r200,), (pi,) = WAFFLE.cameras, WAFFLE_PI.cameras
    assert (r200.width, r200.height, r200.depth) == (1920, 1080, True)
    assert (pi.width, pi.height, pi.depth) == (640, 480, False)
    # sensor_msgs/CameraInfo of Gazebo's Pi camera has fx = 530.467
    assert pi.focal_length == pytest.approx(530.467, abs=0.01)


@pytest.mark.parametrize("robot", [BURGER, WAFFLE, WAFFLE_PI])
def test_the_parts_are_inside_of_the_height_and_of_the_footprint(robot):
    low, high = np.min(robot.footprint, axis=0), np.max(robot.footprint, axis=0)
    for part in robot.parts:
        assert 0 <= part.bottom < part.top <= robot.height + 0.001
        if isinstance(part.shape, Box):
            ends = [(part.pose[0] - part.shape.length / 2, part.pose[1] - part.shape.width / 2)]
            ends.append((part.pose[0] + part.shape.length / 2, part.pose[1] + part.shape.width / 2))
            assert (np.array(ends) >= low - 0.03).all()
            assert (np.array(ends) <= high + 0.03).all()


@pytest.mark.parametrize(
    ("change", "what"),
    [
        ({"drive": "holonomc"}, "did you mean holonomic"),
        ({"mass": 0.0}, "mass is 0.0"),
        ({"mass": math.inf}, "mass is inf"),
        ({"wheel_separation": math.nan}, "wheel_separation is nan"),
        ({"linear_acceleration": 0.0}, "linear_acceleration is 0.0"),
        ({"max_linear": -1.0}, "max_linear is -1.0"),
        ({"footprint": ((0.0, 0.0), (1.0, 0.0))}, "footprint"),
        ({"footprint": ((0.0, 0.0), (0.0, 1.0), (1.0, 0.0))}, "counter-clockwise"),
        ({"footprint": ((0.0, 0.0), (2.0, 0.0), (1.0, 0.5), (1.0, 2.0))}, "convex"),
    ],
)
def test_an_impossible_robot_names_the_number_at_fault(change, what):
    with pytest.raises(ModelError, match=f"the robot model 'burger' is not possible.*{what}"):
        replace(BURGER, **change)


@pytest.mark.parametrize(
    "change", [{"beams": 0}, {"beams": 10**9}, {"range_min": 4.0}, {"angle_max": math.inf}, {"yaw": math.nan}]
)
def test_an_impossible_laser_is_named(change):
    with pytest.raises(ModelError, match="the laser 'LDS-01' is not possible"):
        replace(BURGER.laser, **change)


@pytest.mark.parametrize(
    "change", [{"width": 0}, {"width": 10**5, "height": 10**5}, {"near": 0.0}, {"far": 0.01}, {"horizontal_fov": 4.0}]
)
def test_an_impossible_camera_is_named(change):
    with pytest.raises(ModelError, match="the camera 'camera' is not possible"):
        replace(WAFFLE.cameras[0], **change)


def test_what_a_robot_does_not_have_is_told_by_name():
    blind = replace(BURGER, lidar=None, imu=None)
    with pytest.raises(ModelError, match="'burger' has no lidar"):
        _ = blind.laser
    with pytest.raises(ModelError, match="'burger' has no imu"):
        _ = blind.unit


def test_a_laser_that_looks_ahead_has_its_first_and_its_last_beam_where_it_says():
    ahead = replace(BURGER.laser, beams=181, angle_min=-math.pi / 2, angle_max=math.pi / 2)
    assert ahead.increment == pytest.approx(math.radians(1))
    assert ahead.last_angle == math.pi / 2
    assert BURGER.laser.increment == 2 * math.pi / 360
    assert BURGER.laser.last_angle == pytest.approx(math.radians(359))


@given(st.lists(st.tuples(st.integers(-9, 9), st.integers(-9, 9)), min_size=3, max_size=12))
def test_a_hull_is_convex_and_goes_around_all_points(points):
    corners = hull([(float(x), float(y)) for x, y in points])
    if len(corners) < 3:  # all on one line
        return
    sides = list(zip(corners, corners[1:] + corners[:1], strict=True))
    for x, y in points:
        assert all((bx - ax) * (y - ay) - (by - ay) * (x - ax) >= 0 for (ax, ay), (bx, by) in sides)
    assert set(corners) <= {(float(x), float(y)) for x, y in points}
    assert replace(BURGER, footprint=corners).reach > 0
