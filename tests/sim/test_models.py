"""The numbers of the robots, and finding a robot by its name."""

import math
from dataclasses import replace

import pytest

from rosmini.sim.models import BURGER, WAFFLE, WAFFLE_PI, ModelError, UnknownModel, model


def test_the_burger_is_the_published_one():
    assert (BURGER.mass, BURGER.height) == (1.0, 0.192)
    assert (BURGER.max_linear, BURGER.max_angular) == (0.22, 2.84)
    assert (BURGER.wheel_radius, BURGER.wheel_separation) == (0.033, 0.160)
    assert BURGER.lidar.mount == (-0.032, 0.0, 0.182)
    assert (BURGER.lidar.beams, BURGER.lidar.rate) == (360, 5.0)
    assert (BURGER.lidar.range_min, BURGER.lidar.range_max) == (0.12, 3.5)
    assert (BURGER.rate, BURGER.imu.rate, BURGER.ticks_per_turn) == (30.0, 200.0, 4096)


@pytest.mark.parametrize(("name", "found"), [("burger", BURGER), ("waffle", WAFFLE), ("waffle_pi", WAFFLE_PI)])
def test_a_model_is_found_by_name_and_in_the_environment(monkeypatch, name, found):
    assert model(name) is found
    monkeypatch.delenv("TURTLEBOT3_MODEL", raising=False)
    assert model() is BURGER
    monkeypatch.setenv("TURTLEBOT3_MODEL", name)
    assert model() is found
    monkeypatch.setenv("TURTLEBOT3_MODEL", "wafle")
    with pytest.raises(UnknownModel, match=r"'wafle'.*TURTLEBOT3_MODEL.*did you mean waffle"):
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


@pytest.mark.parametrize(
    ("what", "change", "said"),
    [
        (BURGER, {"drive": "holonomc"}, "'burger'.*did you mean holonomic"),
        (BURGER, {"mass": 0.0}, "mass is 0.0"),
        (BURGER, {"mass": math.inf}, "mass is inf"),
        (BURGER, {"wheel_separation": math.nan}, "wheel_separation is nan"),
        (BURGER, {"linear_acceleration": 0.0}, "linear_acceleration is 0.0"),
        (BURGER, {"max_linear": -1.0}, "max_linear is -1.0"),
        (BURGER, {"footprint": ((0.0, 0.0), (1.0, 0.0))}, "footprint"),
        (BURGER, {"footprint": ((0.0, 0.0), (0.0, 1.0), (1.0, 0.0))}, "counter-clockwise"),
        (BURGER, {"footprint": ((0.0, 0.0), (2.0, 0.0), (1.0, 0.5), (1.0, 2.0))}, "convex"),
        (BURGER.laser, {"beams": 0}, "the laser 'LDS-01'"),
        (BURGER.laser, {"beams": 10**9}, "the laser 'LDS-01'"),
        (BURGER.laser, {"range_min": 4.0}, "the laser 'LDS-01'"),
        (BURGER.laser, {"angle_max": math.inf}, "the laser 'LDS-01'"),
        (WAFFLE.cameras[0], {"width": 0}, "the camera 'camera'"),
        (WAFFLE.cameras[0], {"width": 10**5, "height": 10**5}, "the camera 'camera'"),
        (WAFFLE.cameras[0], {"near": 0.0}, "the camera 'camera'"),
        (WAFFLE.cameras[0], {"horizontal_fov": 4.0}, "the camera 'camera'"),
    ],
)
def test_an_impossible_robot_names_what_is_at_fault(what, change, said):
    with pytest.raises(ModelError, match=said):
        replace(what, **change)
