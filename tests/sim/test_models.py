"""The numbers of the robots, and finding a robot by its name."""

from __future__ import annotations

import pytest

from rosmini.sim.models import BURGER, UnknownModel, model


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
    area = (
        sum(ax * by - bx * ay for (ax, ay), (bx, by) in zip(corners, corners[1:] + corners[:1], strict=True))
        / 2
    )
    assert area == pytest.approx(0.146 * 0.21)
    assert BURGER.reach == pytest.approx(0.105 * 2**0.5)


def test_a_model_by_name_by_environment_and_by_default(monkeypatch):
    monkeypatch.delenv("TURTLEBOT3_MODEL", raising=False)
    assert model() is model("burger") is BURGER
    monkeypatch.setenv("TURTLEBOT3_MODEL", "burger")
    assert model() is BURGER


def test_an_unknown_model_suggests_the_nearest():
    with pytest.raises(UnknownModel, match="did you mean burger"):
        model("burgr")


@pytest.mark.parametrize("name", ["waffle", "waffle_pi"])
def test_a_model_that_is_not_there_yet_says_so(monkeypatch, name):
    monkeypatch.setenv("TURTLEBOT3_MODEL", name)
    with pytest.raises(UnknownModel, match=f"{name}.*TURTLEBOT3_MODEL.*not in this version"):
        model()
