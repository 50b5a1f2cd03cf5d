"""Robots that go to any side, limits of acceleration, and robots without wheels or laser."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.errors import RosminiError
from rosmini.sim.engine import Engine
from rosmini.sim.engine.free_motion import glide, ramps
from rosmini.sim.models import BURGER, ModelError, RobotModel
from rosmini.sim.world import Box, Obstacle, World

OMNI = RobotModel(
    name="omni", drive="holonomic", mass=2.0, inertia=0.02,
    footprint=((-0.1, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1)), height=0.3, max_linear=1.0, max_angular=3.0,
)  # fmt: skip
SLOW = replace(OMNI, name="slow", linear_acceleration=0.5, angular_acceleration=2.0)


def make(model, pose=(0.0, 0.0, 0.0), *, noise=0.0, world=None):
    engine = Engine(
        World("void") if world is None else world, lambda name: np.random.default_rng(sum(name.encode())), noise=noise
    )
    engine.add("robot", model, pose)
    return engine


def integrated(pose, speeds, rates, dt, steps=4000):
    """The same motion by many small steps (the rule of midpoints)."""
    x, y, theta = pose
    h = dt / steps
    for k in range(steps):
        t = (k + 0.5) * h
        v, vy = (speeds[i] + rates[i] * t for i in (0, 1))
        heading = theta + speeds[2] * t + rates[2] * t * t / 2
        x += (v * math.cos(heading) - vy * math.sin(heading)) * h
        y += (v * math.sin(heading) + vy * math.cos(heading)) * h
    return (x, y, theta + speeds[2] * dt + rates[2] * dt * dt / 2)


speed = st.floats(-1.0, 1.0)


@given(speed, speed, st.floats(-3.0, 3.0), speed, speed, st.floats(-2.0, 2.0))
def test_a_glide_is_what_many_small_steps_come_to(v, vy, w, dv, dvy, dw):
    start = (0.3, -0.2, 0.7)
    found = glide(start, (v, vy, w), (dv, dvy, dw), 1.0)
    assert found == pytest.approx(integrated(start, (v, vy, w), (dv, dvy, dw), 1.0, 400), abs=1e-5)


def test_sideways_is_to_the_left():
    engine = make(OMNI, (1.0, 1.0, math.pi / 2))
    engine.command("robot", 0.0, 0.0, vy=0.5)
    engine.advance(2.0)
    assert engine.pose("robot") == pytest.approx((0.0, 1.0, math.pi / 2))
    assert engine.velocity("robot") == pytest.approx((-0.5, 0.0, 0.0))
    assert engine.robots["robot"].velocity == pytest.approx((0.0, 0.5, 0.0))


@pytest.mark.parametrize("step", [0.0013, 0.0333, 0.7, 100.0])
def test_a_holonomic_circle_closes_whatever_the_step(step):
    engine = make(OMNI)
    engine.command("robot", 0.3, 0.5, vy=0.4)
    turn = 2 * math.pi / 0.5
    while engine.now < turn - 1e-12:
        engine.advance(min(engine.now + step, turn))
    assert engine.pose("robot")[:2] == pytest.approx((0.0, 0.0), abs=1e-9)


def test_a_robot_on_two_wheels_takes_no_notice_of_a_speed_to_the_side():
    engine = make(BURGER)
    engine.command("robot", 0.0, 0.0, vy=0.5)
    engine.advance(2.0)
    assert engine.pose("robot") == (0.0, 0.0, 0.0)


def test_each_speed_reaches_its_target_by_itself():
    engine = make(SLOW)
    engine.command("robot", 0.5, 1.0, vy=0.25)
    engine.advance(0.5)
    assert engine.robots["robot"].velocity == pytest.approx((0.25, 0.25, 1.0))
    engine.advance(1.0)
    assert engine.robots["robot"].velocity == pytest.approx((0.5, 0.25, 1.0))
    phases = ramps((0.0, 0.0, 0.0), (0.5, 0.25, 1.0), (0.5, 0.5, 2.0), 2.0)
    assert [length for length, _ in phases] == pytest.approx([0.5, 0.5, 1.0])


def test_a_holonomic_robot_against_a_wall_slides_along_it():
    wall = World("wall", walls=np.array([(1.0, -9.0, 1.0, 9.0)]))
    engine = make(OMNI, world=wall)
    engine.command("robot", 0.5, 0.0, vy=0.2)
    engine.advance(10.0)
    x, y, theta = engine.pose("robot")
    assert (x, theta) == pytest.approx((0.9, 0.0), abs=1e-6)
    assert y == pytest.approx(2.0, abs=0.05)
    # its wheels have gone on
    assert engine.robots["robot"].reckoned[0] == pytest.approx(5.0)


def test_what_a_holonomic_robot_believes_drifts_from_the_truth_only_with_noise():
    for noise in (0.0, 1.0):
        engine = make(OMNI, noise=noise)
        engine.command("robot", 0.3, 0.2, vy=0.1)
        engine.advance(20.0)
        robot = engine.robots["robot"]
        apart = math.dist(robot.pose[:2], robot.reckoned[:2])
        assert apart < 1e-9 if noise == 0 else 1e-4 < apart < 0.3


GENTLE = replace(BURGER, linear_acceleration=0.2, angular_acceleration=1.0)


def test_linear_and_angular_limits_hold_by_themselves():
    engine = make(GENTLE)
    engine.command("robot", 0.2, 0.0)
    engine.advance(3.0)
    # 0.2 m/s after 1 s, and 0.1 m less than with no ramp
    assert engine.pose("robot")[0] == pytest.approx(0.6 - 0.1, abs=1e-9)
    assert engine.robots["robot"].motion().v == pytest.approx(0.2)
    engine = make(GENTLE)
    engine.command("robot", 0.0, 2.0)
    engine.advance(3.0)
    assert engine.pose("robot") == pytest.approx((0.0, 0.0, 6.0 - 2.0), abs=1e-9)


TROLLEY = replace(OMNI, name="trolley", drive=None, mass=0.4, body_radius=0.05)


def test_a_thing_without_a_drive_is_pushed_and_seen():
    engine = make(BURGER, (-0.5, 0.0, 0.0))
    thing = engine.add("trolley", TROLLEY, (0.0, 0.0, 0.0))
    engine.command("robot", 0.2, 0.0)
    engine.advance(5.0)
    assert thing.pose[0] == pytest.approx(engine.pose("robot")[0] + 0.041 + 0.1, abs=1e-3)
    assert engine.velocity("trolley")[0] == pytest.approx(0.2, abs=0.01)
    assert engine.scan("robot")[0] == pytest.approx(0.041 + 0.1 + 0.032 - 0.05, abs=0.002)
    assert engine.obstacles() == ()
    engine.reset()
    assert thing.pose == (0.0, 0.0, 0.0)


def test_a_thing_without_a_drive_cannot_be_driven():
    engine = make(TROLLEY)
    with pytest.raises(RosminiError, match=r"'robot' cannot go 0\.1 m/s.*it has no drive"):
        engine.command("robot", 0.1, 0.0)
    with pytest.raises(ModelError, match="'trolley' has no lidar"):
        engine.scan("robot")


def test_a_laser_on_a_post_sees_a_robot_go_by():
    post = replace(TROLLEY, name="post", mass=math.inf, inertia=math.inf, lidar=BURGER.laser, body_radius=0.05)
    engine = make(BURGER, (-0.5, 1.0, 0.0))
    engine.add("post", post, (0.0, 0.0, 0.0))
    engine.command("robot", 0.2, 0.0)
    engine.advance(2.5)
    before = engine.scan("post")
    assert np.isfinite(before).any()
    engine.put("post", (5.0, 0.0, 0.0))
    assert not np.isfinite(engine.scan("post")).any()
    engine.put("robot", (4.5, 0.0, 0.0))
    engine.command("robot", 0.2, 0.0)
    engine.advance(20.0)
    assert engine.pose("post") == (5.0, 0.0, 0.0)
    assert engine.pose("robot")[0] == pytest.approx(4.9 - 0.041, abs=1e-3)
    engine.remove("post")
    engine.advance(22.0)
    assert engine.pose("robot")[0] > 5.0


def test_a_robot_that_is_low_passes_under_a_table_and_one_that_is_high_does_not():
    table = World("table", (Obstacle("top", Box(1.0, 1.0), (1.0, 0.0, 0.0), height=0.75, bottom=0.25),))
    low, high = make(BURGER, world=table), make(OMNI, world=table)
    for engine in (low, high):
        engine.command("robot", 0.2, 0.0)
        engine.advance(10.0)
    assert low.pose("robot")[0] == pytest.approx(2.0 - 0.02, abs=1e-6)
    assert high.pose("robot")[0] == pytest.approx(0.5 - 0.1, abs=1e-6)
    assert not np.isfinite(low.scan("robot")).any()
    low.place("robot", (1.0, 0.0, 0.0))
