"""What is touched, where, and how hard; and what is seen of robots and things."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from rosmini.sim.engine import Engine, RobotGone
from rosmini.sim.models import BURGER, WAFFLE, RobotModel
from rosmini.sim.shapes import Part
from rosmini.sim.world import Box, Compound, Cylinder, Obstacle, Polygon, Sphere, World, WorldError

GRIP = 0.7 * 9.80665
"""How hard the Burger's wheels can push [N]."""


def make(world: World, **poses) -> Engine:
    engine = Engine(world, lambda name: np.random.default_rng(sum(name.encode())), noise=0.0)
    for name, pose in poses.items():
        engine.add(name, BURGER, pose)
    return engine


def wall(*rows) -> World:
    return World("walls", walls=np.array(rows, dtype=float))


# -- touching --------------------------------------------------------------------------------------------------------


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


def test_a_robot_that_only_stands_at_a_wall_does_not_push_it():
    engine = make(wall((1.0, -2.0, 1.0, 2.0)), burger=(1.0 - 0.041, 0.0, 0.0))
    assert [touch.force for touch in engine.touching("burger")] == [0.0, 0.0]


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


def test_robots_touch_each_other_by_name():
    engine = make(World("void"), one=(0.0, 0.0, 0.0), two=(0.082, 0.0, math.pi))
    assert {touch.other for touch in engine.touching("one")} == {"two"}
    assert {touch.other for touch in engine.touching("two")} == {"one"}
    engine.place("two", (0.5, 0.0, 0.0))
    assert engine.touching("one") == []


def test_who_cannot_be_asked_is_named():
    engine = make(World("w", (Obstacle("pillar", Cylinder(0.1), (2.0, 0.0, 0.0)),)), burger=(0.0, 0.0, 0.0))
    with pytest.raises(RobotGone, match="nothing 'nobody'"):
        engine.touching("nobody")
    with pytest.raises(RobotGone, match="'pillar' is fixed"):
        engine.touching("pillar")


# -- seen ------------------------------------------------------------------------------------------------------------


def test_each_laser_sees_the_parts_at_its_own_height():
    low = replace(BURGER.laser, mount=(0.0, 0.0, 0.1))
    engine = make(World("void"), burger=(0.0, 0.0, 0.0))
    engine.add("waffle", WAFFLE, (1.0, 0.0, math.pi))
    assert engine.scan("burger")[0] == math.inf  # its own laser, 0.182 m up, looks over the waffle
    # the waffle's base is a box of 0.266 m, 64 mm behind its axle
    assert engine.scan("burger", lidar=low)[0] == pytest.approx(1.064 - 0.133)
    assert engine.scan("waffle")[0] == pytest.approx(1.064 + 0.032 - 0.07 - 0.0, abs=1e-6)  # the burger's base


@given(st.floats(-3.0, 3.0), st.floats(-3.0, 3.0), st.floats(0.8, 2.5))
def test_a_box_on_a_robot_is_seen_exactly(bearing, turn, away):
    model = RobotModel(
        name="cart",
        mass=1.0,
        inertia=0.01,
        footprint=((-0.2, -0.1), (0.2, -0.1), (0.2, 0.1), (-0.2, 0.1)),
        height=0.3,
        parts=(Part(Box(0.4, 0.2), (0.0, 0.0, 0.0), 0.0, 0.3),),
    )
    x, y = away * math.cos(bearing) - 0.032, away * math.sin(bearing)
    moving, fixed = (
        make(World("void"), burger=(0.0, 0.0, 0.0)),
        make(World("box", (Obstacle("box", Box(0.4, 0.2), (x, y, turn)),)), burger=(0.0, 0.0, 0.0)),
    )
    moving.add("cart", model, (x, y, turn))
    np.testing.assert_allclose(moving.scan("burger"), fixed.scan("burger"), atol=1e-9)


def test_a_laser_that_looks_ahead_and_sits_askew_sees_what_is_there():
    half = replace(
        BURGER.laser, beams=181, angle_min=-math.pi / 2, angle_max=math.pi / 2, mount=(0.1, 0.05, 0.1), yaw=math.pi / 2
    )
    engine = make(wall((-3.0, 2.0, 3.0, 2.0)), burger=(0.0, 0.0, 0.0))
    ranges = engine.scan("burger", lidar=half)
    assert len(ranges) == 181
    assert ranges[90] == pytest.approx(1.95)  # straight to the left
    assert ranges[90 - 30] == pytest.approx(1.95 / math.cos(math.radians(30)))
    assert ranges[0] == ranges[180] == math.inf  # along the wall


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

    def seen(height: float) -> float:
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


@pytest.mark.parametrize(
    ("change", "what"),
    [
        ({"bottom": 0.5}, "top must be above the bottom"),
        ({"bottom": math.nan}, "bottom is nan"),
        ({"shape": Sphere(0.0)}, "shape.radius is 0.0"),
        ({"shape": Compound(())}, "a compound has one part at least"),
        ({"shape": Compound(((Cylinder(-1.0), (0, 0, 0)),))}, r"shape.parts\[0\]: shape.radius is -1.0"),
        ({"colour": "#12345"}, "six digits"),
        ({"colour": "#gg0000"}, "six digits"),
        ({"colour": "bleu"}, "did you mean blue"),
        ({"restitution": 1.5}, "restitution is 1.5; it must be a finite number from 0 to 1"),
        ({"drag": -0.1}, "drag is -0.1"),
        ({"motion": "walk"}, "it must be a Walk or a Door"),
    ],
)
def test_an_impossible_thing_names_what_is_at_fault(change, what):
    with pytest.raises(WorldError, match=f"the obstacle 'thing' is not possible: .*{what}"):
        Obstacle(**{"name": "thing", "shape": Box(1.0, 1.0), **change})


def test_a_polygon_that_is_not_convex_is_seen_as_it_is():
    angle = Polygon(((0.0, 0.0), (0.4, 0.0), (0.4, 0.1), (0.1, 0.1), (0.1, 0.4), (0.0, 0.4)))
    engine = make(World("angle", (Obstacle("angle", angle, (1.0, 0.0, math.pi)),)), burger=(0.0, -0.25, 0.0))
    # from below and behind: into the open corner
    assert engine.scan("burger")[0] == pytest.approx(1.0 - 0.1 + 0.032)
