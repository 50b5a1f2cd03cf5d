"""What is touched, where, and how hard; and what is seen of robots and things."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from rosmini.sim.engine import Engine
from rosmini.sim.models import BURGER, WAFFLE
from rosmini.sim.world import Box, Compound, Cylinder, Obstacle, Polygon, Sphere, World, WorldError

GRIP = 0.7 * 9.80665
"""How hard the Burger's wheels can push [N]."""


def make(world, **poses):
    engine = Engine(world, lambda name: np.random.default_rng(sum(name.encode())), noise=0.0)
    for name, pose in poses.items():
        engine.add(name, BURGER, pose)
    return engine


def wall(*rows):
    return World("walls", walls=np.array(rows, dtype=float))


def test_a_robot_against_a_wall_touches_it_with_both_corners_and_all_its_grip():
    engine = make(wall((1.0, -2.0, 1.0, 2.0)), burger=(0.5, 0.0, 0.0))
    assert engine.touching("burger") == []
    engine.command("burger", 0.2, 0.0)
    engine.advance(5.0)
    touches = engine.touching("burger")
    assert [touch.other for touch in touches] == ["wall", "wall"]
    assert sorted((touch.x, touch.y) for touch in touches) == [
        pytest.approx((1.0, -0.105), abs=1e-6),
        pytest.approx((1.0, 0.105), abs=1e-6),
    ]
    assert all((touch.nx, touch.ny) == pytest.approx((-1.0, 0.0)) for touch in touches)
    assert sum(touch.force for touch in touches) == pytest.approx(GRIP)
    engine.command("burger", -0.2, 0.0)
    engine.advance(6.0)
    assert engine.touching("burger") == []


def test_a_crate_is_pushed_as_hard_as_it_drags():
    crate = Obstacle("crate", Box(0.2, 0.2), (0.3, 0.0, 0.0), mass=0.8)
    engine = make(World("crate", (crate,)), burger=(0.0, 0.0, 0.0))
    engine.command("burger", 0.2, 0.0)
    engine.advance(4.0)
    touches = engine.touching("burger")
    assert {touch.other for touch in touches} == {"crate"}
    assert sum(touch.force for touch in touches) == pytest.approx(0.5 * 0.8 * 9.80665, rel=0.05)
    back = engine.touching("crate")
    assert {touch.other for touch in back} == {"burger"}
    assert sum(touch.nx * touch.force for touch in back) == pytest.approx(0.5 * 0.8 * 9.80665, rel=0.05)


def test_each_laser_sees_the_parts_at_its_own_height():
    low = replace(BURGER.laser, mount=(0.0, 0.0, 0.1))
    engine = make(World("void"), burger=(0.0, 0.0, 0.0))
    engine.add("waffle", WAFFLE, (1.0, 0.0, math.pi))
    assert engine.scan("burger")[0] == math.inf  # its own laser, 0.182 m up, looks over the waffle
    # the waffle's base is a box of 0.266 m, 64 mm behind its axle
    assert engine.scan("burger", lidar=low)[0] == pytest.approx(1.064 - 0.133)
    assert engine.scan("waffle")[0] == pytest.approx(1.064 + 0.032 - 0.07 - 0.0, abs=1e-6)  # the burger's base


@given(st.floats(0.01, 0.45))
def test_a_laser_sees_the_circle_of_a_ball_at_its_own_height(height):
    assume(abs(height - 0.4) > 1e-9)  # at its very top the circle is a point
    ball = Obstacle("ball", Sphere(0.2), (1.0, 0.0, 0.0))
    assert ball.height == 0.4
    engine = make(World("ball", (ball,)), burger=(0.0, 0.0, 0.0))
    seen = engine.scan("burger", lidar=replace(BURGER.laser, mount=(0.0, 0.0, height)))[0]
    if height > 0.4:
        assert seen == math.inf
    else:
        assert seen == pytest.approx(1.0 - math.sqrt(0.2**2 - (height - 0.2) ** 2))


def test_a_compound_is_seen_pushed_and_in_the_way_with_all_its_parts():
    table = Compound(tuple((Cylinder(0.03), (x, y, 0.0)) for x in (-0.4, 0.4) for y in (-0.3, 0.3)))
    there = World("table", (Obstacle("legs", table, (1.0, 0.0, 0.0)),))
    engine = make(there, burger=(0.0, 0.3, 0.0))
    assert engine.scan("burger")[0] == pytest.approx(0.6 - 0.03 + 0.032)
    with pytest.raises(WorldError, match="'legs'"):
        engine.place("burger", (0.6, 0.3, 0.0))
    engine.place("burger", (1.0, 0.0, 0.0))  # between the legs there is room
    light = replace(there.obstacles[0], mass=0.4)
    engine = make(World("light", (light,)), burger=(0.0, 0.3, 0.0))
    engine.command("burger", 0.2, 0.0)
    engine.advance(6.0)
    assert engine.pose("legs")[0] == pytest.approx(engine.pose("burger")[0] + 0.041 + 0.03 + 0.4, abs=2e-3)


def test_what_floats_is_seen_between_its_bottom_and_its_top():
    board = Obstacle("board", Box(0.1, 1.0), (1.0, 0.0, 0.0), height=0.3, bottom=0.15, colour="#c05020")
    engine = make(World("board", (board,)), burger=(0.0, 0.0, 0.0))

    def seen(height):
        return float(engine.scan("burger", lidar=replace(BURGER.laser, mount=(0.0, 0.0, height)))[0])

    assert seen(0.1) == seen(0.31) == math.inf
    assert seen(0.15) == seen(0.3) == pytest.approx(0.95)


def test_all_that_is_visible_is_told_with_its_place_and_colour():
    things = (
        Obstacle("pillar", Cylinder(0.1), (2.0, 0.0, 0.0), colour="blue"),
        Obstacle("crate", Box(0.2, 0.2), (0.5, 0.0, 0.0), mass=0.3, colour="#123456"),
    )
    engine = make(World("things", things), one=(0.0, 0.0, 0.0), two=(0.0, 2.0, 0.0))
    engine.command("one", 0.2, 0.0)
    engine.advance(4.0)
    seen = engine.visible("one")
    assert {part.name for part in seen} == {"pillar", "crate", "two"}
    crate = next(part for part in seen if part.name == "crate")
    assert (crate.colour, crate.bottom, crate.top) == ("#123456", 0.0, 0.5)
    assert crate.pose == engine.pose("crate")
    assert len([part for part in seen if part.name == "two"]) == len(BURGER.parts)
    assert {part.name for part in engine.visible()} == {"pillar", "crate", "one", "two"}


def test_a_polygon_that_is_not_convex_is_seen_as_it_is():
    angle = Polygon(((0.0, 0.0), (0.4, 0.0), (0.4, 0.1), (0.1, 0.1), (0.1, 0.4), (0.0, 0.4)))
    engine = make(World("angle", (Obstacle("angle", angle, (1.0, 0.0, math.pi)),)), burger=(0.0, -0.25, 0.0))
    # from below and behind: into the open corner
    assert engine.scan("burger")[0] == pytest.approx(1.0 - 0.1 + 0.032)
