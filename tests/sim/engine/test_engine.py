"""Motion through the engine: exact where nothing is in the way, and stopped, slid or pushed where something is."""

import math

import numpy as np
import pytest

from rosmini.core.errors import RosminiError
from rosmini.sim.engine import Engine, RobotGone
from rosmini.sim.models import BURGER
from rosmini.sim.world import Box, Cylinder, Obstacle, Polygon, World, WorldError
from rosmini.sim.worlds import world

from .pens import generator

FRONT = 0.041
"""How far the Burger's footprint reaches ahead of its axle."""
RAMP = 0.2**2 / 2
"""What a start to 0.2 m/s at 1 m/s2 is behind one that needs no time."""


def make(where="empty", pose=(0.0, 0.0, 0.0), *, noise=0.0):
    engine = Engine(world(where) if isinstance(where, str) else where, generator, noise=noise)
    engine.add("burger", BURGER, pose)
    return engine


def walls(*segments):
    return World("walls", walls=np.array(segments, dtype=float))


BEHIND = walls((1.0, -3.0, 1.0, 3.0))
"""A wall across x = 1."""


# -- free motion -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("step", [0.0013, 0.005, 0.0333, 0.7, 100.0])
def test_a_straight_way_is_exact_whatever_the_step(step):
    engine = make()
    engine.command("burger", 0.2, 0.0)
    while engine.now < 10.0:
        engine.advance(min(engine.now + step, 10.0))
    assert engine.robots["burger"].pose == pytest.approx((0.2 * 10 - RAMP, 0.0, 0.0), abs=1e-9)


@pytest.mark.parametrize("step", [0.0013, 0.005, 0.0333, 0.7, 100.0])
@pytest.mark.parametrize("place", ["empty", "arena"])
def test_a_circle_closes_whatever_the_step(step, place):
    engine = make(place)
    robot = engine.robots["burger"]
    engine.command("burger", 0.2, 0.5)
    engine.advance(1.0)
    begin, turn = robot.pose, 2 * math.pi / 0.5
    while engine.now < 1.0 + turn - 1e-12:
        engine.advance(min(engine.now + step, 1.0 + turn))
    assert robot.pose[:2] == pytest.approx(begin[:2], abs=1e-9)
    assert robot.pose[2] == pytest.approx(begin[2] + 2 * math.pi, abs=1e-9)


def test_braking_takes_the_way_v_squared_by_two_a():
    engine = make()
    robot = engine.robots["burger"]
    engine.command("burger", 0.22, 0.0)
    engine.advance(1.0)
    before = robot.pose[0]
    engine.command("burger", 0.0, 0.0)
    engine.advance(5.0)
    assert robot.pose[0] - before == pytest.approx(0.22**2 / 2, abs=1e-9)
    assert robot.left == robot.right == 0.0


def test_commands_are_cut_to_what_the_robot_can_do():
    engine = make()
    engine.command("burger", 5.0, 0.0)
    engine.advance(2.0)
    assert engine.robots["burger"].motion() == (0.22, 0.0, 0.0, 0.0)
    engine.command("burger", 0.0, -50.0)
    engine.advance(6.0)
    assert engine.robots["burger"].motion().w == pytest.approx(-2.84)


def test_a_command_that_is_too_old_stops_the_robot():
    engine = make()
    engine.command("burger", 0.2, 0.0, timeout=0.5)
    engine.advance(9.0)
    assert engine.robots["burger"].pose[0] == pytest.approx(0.2 * 0.5 - RAMP + RAMP, abs=1e-9)
    engine.command("burger", 0.2, 0.0)
    engine.advance(19.0)
    assert engine.robots["burger"].pose[0] > 2.0


# -- walls -----------------------------------------------------------------------------------------------------------


def test_a_wall_stops_the_robot_exactly_at_contact_and_the_wheels_slip():
    engine = make(BEHIND)
    robot = engine.robots["burger"]
    engine.command("burger", 0.2, 0.0)
    engine.advance(20.0)
    assert robot.pose == pytest.approx((1.0 - FRONT, 0.0, 0.0), abs=1e-8)
    assert robot.touching
    assert robot.motion().v == pytest.approx(0.0, abs=1e-6)
    assert robot.ticks[0] == math.floor((0.2 * 20 - RAMP) / 0.033 / (2 * math.pi) * 4096 + 1e-6)


def test_a_robot_that_meets_a_wall_aslant_turns_along_it():
    engine = make(BEHIND)
    robot = engine.robots["burger"]
    engine.place("burger", (0.6, 0.0, 0.9))
    engine.command("burger", 0.2, 0.0)
    engine.advance(10.0)
    assert robot.corners()[:, 0].max() < 1.0 + 1e-6
    assert robot.pose[1] > 0.2


def test_no_wall_is_too_thin_and_no_way_too_long():
    # whatever it does for an hour, it stays within four walls without thickness
    engine = make(walls((-1, -1, 1, -1), (1, -1, 1, 1), (1, 1, -1, 1), (-1, 1, -1, -1)))
    robot, rng = engine.robots["burger"], np.random.default_rng(4)
    for _ in range(120):
        engine.command("burger", *rng.uniform((-0.22, -2.84), (0.22, 2.84)).tolist())
        engine.advance(engine.now + 1.0)
        assert abs(robot.corners()).max() < 1.0 + 1e-5


def test_a_sofa_with_an_inner_corner_is_solid_there_and_hollow_where_it_is_open():
    outline = ((0.0, 0.0), (1.0, 0.0), (1.0, 0.3), (0.3, 0.3), (0.3, 1.0), (0.0, 1.0))
    engine = make(World("sofa", (Obstacle("sofa", Polygon(outline)),)), (0.7, 0.7, math.pi))
    engine.command("burger", 0.2, 0.0)
    engine.advance(10.0)
    assert engine.robots["burger"].pose == pytest.approx((0.3 + FRONT, 0.7, math.pi), abs=1e-6)
    with pytest.raises(WorldError, match="'sofa'"):
        engine.place("burger", (0.15, 0.15, 0.0))


# -- things that give way --------------------------------------------------------------------------------------------


def crate(mass):
    return World("crate", (Obstacle("crate", Box(0.2, 0.2), (0.5, 0.0, 0.0), mass=mass),))


def test_a_light_crate_is_pushed_at_the_robots_speed_and_stays_where_it_is_left():
    engine = make(crate(0.5))
    robot = engine.robots["burger"]
    engine.command("burger", 0.2, 0.0)
    engine.advance(10.0)
    x, y, theta = engine.obstacles()[0].pose
    assert robot.pose[0] == pytest.approx(0.2 * 10 - RAMP, abs=0.005)
    assert x == pytest.approx(robot.pose[0] + FRONT + 0.1, abs=1e-3)
    assert (y, theta) == pytest.approx((0.0, 0.0), abs=1e-3)
    engine.command("burger", 0.0, 0.0)
    engine.advance(11.0)
    rest = engine.obstacles()[0].pose
    assert rest[0] - x == pytest.approx(RAMP, abs=5e-3)
    engine.advance(20.0)
    assert engine.obstacles()[0].pose == rest


def test_a_crate_against_a_wall_stops_the_robot():
    things = World(
        "crate and wall",
        (Obstacle("crate", Box(0.2, 0.2), (0.5, 0.0, 0.0), mass=0.3),),
        np.array([(1.0, -1.0, 1.0, 1.0)]),
    )
    engine = make(things)
    engine.command("burger", 0.2, 0.0)
    engine.advance(30.0)
    assert engine.obstacles()[0].pose[0] == pytest.approx(0.9, abs=2e-3)
    assert engine.robots["burger"].pose[0] == pytest.approx(0.8 - FRONT, abs=4e-3)


def test_a_round_thing_is_pushed_aside():
    engine = make(World("bin", (Obstacle("bin", Cylinder(0.1), (0.5, 0.17, 0.0), mass=0.3),)))
    engine.command("burger", 0.2, 0.0)
    engine.advance(6.0)
    x, y, _ = engine.obstacles()[0].pose
    assert 0.2 < y < 0.22  # it has rolled off the corner, 0.105 m aside
    assert x < engine.robots["burger"].pose[0]


def test_reset_puts_everything_back():
    engine = make(crate(0.3))
    engine.command("burger", 0.2, 0.0)
    engine.advance(5.0)
    engine.reset()
    engine.advance(6.0)
    assert engine.robots["burger"].pose == (0.0, 0.0, 0.0)
    assert engine.robots["burger"].ticks == (0, 0)
    assert engine.obstacles()[0].pose == (0.5, 0.0, 0.0)


# -- the same again --------------------------------------------------------------------------------------------------


def test_a_peek_tells_the_future_and_changes_nothing():
    engine, other = make("room", noise=1.0), make("room", noise=1.0)
    for each in (engine, other):
        each.command("burger", 0.2, 0.4)
        each.advance(1.5)
    seen = engine.predict_pose("burger", 1.52)
    engine.advance(1.52)
    assert engine.robots["burger"].pose == seen
    other.advance(1.52)
    assert other.robots["burger"].pose == seen


# -- what is refused -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("where", "pose", "culprit"),
    [
        (BEHIND, (0.97, 0.0, 0.0), r"the wall from \(1.00, -3.00\) to \(1.00, 3.00\)"),
        (World("p", (Obstacle("pillar", Cylinder(0.1), (2.0, 0.0, 0.0)),)), (1.9, 0.0, 0.0), "the obstacle 'pillar'"),
        (World("h", (Obstacle("house", Box(4.0, 4.0)),)), (0.3, 0.0, 0.0), "the obstacle 'house'"),
        (crate(1.0), (0.5, 0.0, 0.0), "the obstacle 'crate'"),
    ],
)
def test_a_robot_is_not_placed_in_something(where, pose, culprit):
    engine = Engine(where, generator)
    with pytest.raises(WorldError, match=culprit):
        engine.add("burger", BURGER, pose)
    assert engine.robots == {}
    engine.add("burger", BURGER, (-3.0, 0.0, 0.0))
    with pytest.raises(WorldError, match=culprit):
        engine.place("burger", pose)
    assert engine.robots["burger"].pose == (-3.0, 0.0, 0.0)


def test_who_is_refused_hears_where_there_is_room():
    with pytest.raises(WorldError, match=r"There is room at \(1\.93, 0\.00\)"):
        make("arena", (1.98, 0.0, 0.0))


def test_a_robot_may_be_placed_where_it_stands_and_where_it_just_touches():
    engine = make(BEHIND)
    engine.place("burger", (0.02, 0.0, 0.1))
    engine.place("burger", (1.0 - FRONT, 0.0, 0.0))
    engine.place("burger", (0.5, 0.0, 0.7))
    engine.command("burger", 0.2, 0.0)
    engine.advance(10.0)
    assert engine.robots["burger"].touching
    engine.place("burger", engine.robots["burger"].pose)


@pytest.mark.parametrize("wrong", [math.nan, math.inf, -math.inf])
def test_what_is_no_pose_or_velocity_is_refused(wrong):
    engine = make()
    for pose in ((wrong, 0.0, 0.0), (0.0, wrong, 0.0), (0.0, 0.0, wrong)):
        with pytest.raises(WorldError, match="finite"):
            engine.place("burger", pose)
    for velocity in ((wrong, 0.0), (0.0, wrong)):
        with pytest.raises(RosminiError, match="finite"):
            engine.command("burger", *velocity)
    engine.advance(1.0)
    assert engine.robots["burger"].pose == (0.0, 0.0, 0.0)


def test_robots_are_known_by_name():
    engine = make()
    with pytest.raises(RosminiError, match="already"):
        engine.add("burger", BURGER, (3.0, 0.0, 0.0))
    with pytest.raises(RobotGone, match="did you mean burger"):
        engine.command("burgr", 0.1, 0.0)
    engine.remove("burger")
    with pytest.raises(RobotGone, match="robots: none"):
        engine.command("burger", 0.1, 0.0)
    engine.advance(10.0)
    engine.add("burger", BURGER, (0.0, 0.0, 0.0))


def test_without_a_pose_robots_take_the_worlds_starts_in_order():
    engine = Engine(world("arena"), generator)
    first, second = engine.add("one", BURGER), engine.add("two", BURGER)
    assert (first.pose, second.pose) == engine.world.starts[:2]
