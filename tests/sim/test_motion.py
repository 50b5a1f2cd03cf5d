"""Walkers and doors: where they would be, and how they wait for what is in their way."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from rosmini.sim.engine import Engine
from rosmini.sim.models import BURGER
from rosmini.sim.motion import Door, Walk
from rosmini.sim.world import Box, Cylinder, Obstacle, World, WorldError

from ..conftest import nightly

SQUARE = Walk(((0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)), speed=0.5, wait=1.0)


def make(*obstacles):
    return Engine(World("test", obstacles), lambda name: np.random.default_rng(sum(name.encode())), noise=0.0)


def test_a_round_takes_the_way_the_waits_and_the_turns():
    # 8 m at 0.5 m/s, four waits of 1 s, four quarter turns at pi rad/s
    assert SQUARE.period == pytest.approx(16 + 4 + 4 * 0.5)
    assert SQUARE.pose_at(1.0) == pytest.approx((0.5, 0.0, 0.0))
    assert SQUARE.pose_at(4.5) == pytest.approx((2.0, 0.0, 0.0))  # it waits
    assert SQUARE.pose_at(5.25) == pytest.approx((2.0, 0.0, math.pi / 4))  # it turns
    assert SQUARE.pose_at(6.5) == pytest.approx((2.0, 0.5, math.pi / 2))


def test_a_walk_without_a_loop_ends_at_its_last_waypoint():
    walk = Walk(((0.0, 0.0), (1.0, 0.0), (1.0, 1.0)), speed=1.0, loop=False)
    assert walk.pose_at(walk.period) == walk.pose_at(1e6) == pytest.approx((1.0, 1.0, math.pi / 2))
    assert walk.pose_at(-5.0) == (0.0, 0.0, 0.0)


def test_a_leaf_turns_about_its_hinge():
    door = Door(hinge=(-0.45, 0.0), closed=1.0, moving=2.0, open=3.0)
    assert door.period == 8.0
    start = (1.0, 2.0, 0.0)
    assert door.pose_at(0.5, start) == pytest.approx(start)
    assert door.pose_at(4.0, start) == pytest.approx((1.0 - 0.45, 2.0 + 0.45, math.pi / 2))
    x, y, theta = door.pose_at(2.0, start)
    assert theta == pytest.approx(math.pi / 4)
    assert math.hypot(x - 0.55, y - 2.0) == pytest.approx(0.45)  # as far from the hinge as ever


def test_a_sliding_door_goes_to_its_side():
    door = Door(opening=0.8, slide=math.pi, closed=0.0, moving=1.0, open=1.0)
    assert door.pose_at(1.5, (1.0, 0.0, math.pi / 2)) == pytest.approx((1.0, -0.8, math.pi / 2))


@pytest.mark.parametrize(
    ("make", "arguments", "what"),
    [
        (Walk, {"waypoints": ((0, 0),)}, "two finite waypoints"),
        (Walk, {"waypoints": ((0, 0), (0, 0))}, "all the same"),
        (Walk, {"waypoints": ((0, 0), (math.nan, 0))}, "two finite waypoints"),
        (Walk, {"waypoints": (1.0, 2.0)}, "pairs of x and y"),
        (Walk, {"waypoints": ((0, 0), (1, 0)), "speed": 0.0}, "speed of a walk is 0.0"),
        (Walk, {"waypoints": ((0, 0), (1, 0)), "wait": -1.0}, "wait of a walk is -1.0"),
        (Door, {"moving": 0.0}, "moving of a door"),
        (Door, {"open": -1.0}, "open of a door"),
        (Door, {"opening": math.inf}, "opening of a door"),
        (Door, {"hinge": 3.0}, "hinge of a door"),
        (Obstacle, {"name": "both", "shape": Cylinder(0.2), "mass": 1.0, "motion": SQUARE}, "'both'.*a mass.*a motion"),
    ],
)
def test_an_impossible_motion_says_why(make, arguments, what):
    with pytest.raises(WorldError, match=what):
        make(**arguments)


WALKER = Obstacle("walker", Cylinder(0.2), height=1.7, motion=Walk(((0.0, 0.0), (6.0, 0.0)), speed=0.5))


def test_a_walker_in_an_empty_world_is_where_its_motion_says():
    engine = make(WALKER)
    engine.add("burger", BURGER, (0.0, 3.0, 0.0))
    for t in (1.0, 3.3, 11.0, 40.0):
        engine.advance(t)
        assert engine.pose("walker") == pytest.approx(WALKER.motion.pose_at(t), abs=1e-9)
    engine.advance(50.0)
    assert engine.velocity("walker")[:2] == pytest.approx((-0.5, 0.0), abs=1e-6)  # on its way back


def test_a_walker_waits_for_a_robot_in_its_way_and_then_goes_on():
    engine = make(replace(WALKER, motion=replace(WALKER.motion, patience=60.0)))
    robot = engine.add("burger", BURGER, (3.0, 0.0, math.pi / 2))
    engine.advance(20.0)
    assert engine.movers["walker"].waiting
    assert robot.pose == (3.0, 0.0, math.pi / 2)
    # 0.105 m to the robot's side, the walker's radius, and the 0.3 m that it keeps
    assert engine.pose("walker")[0] == pytest.approx(3.0 - 0.105 - 0.2 - 0.3, abs=0.005)
    assert engine.velocity("walker") == (0.0, 0.0, 0.0)
    waited = 20.0 - engine.movers["walker"].clock
    engine.command("burger", 0.22, 0.0)
    engine.advance(24.0)
    assert not engine.movers["walker"].waiting
    engine.advance(25.0)
    assert engine.pose("walker")[0] > 3.0
    assert 25.0 - engine.movers["walker"].clock > waited


@pytest.mark.parametrize("keep", [0.45, *nightly(0.1, 0.7)])
def test_a_walker_keeps_its_distance_however_it_meets_a_robot(keep):
    engine = make(replace(WALKER, motion=replace(WALKER.motion, keep=keep, patience=60.0)))
    engine.add("burger", BURGER, (3.0, 0.0, 0.0))  # its tail reaches 0.105 m back
    engine.advance(20.0)
    assert engine.pose("walker")[0] == pytest.approx(3.0 - 0.105 - 0.2 - keep, abs=0.005)


@pytest.mark.nightly
def test_a_walker_keeps_its_distance_beside_a_robot_too():
    engine = make(replace(WALKER, motion=replace(WALKER.motion, patience=60.0)))
    engine.add("burger", BURGER, (3.0, 0.45, math.pi))  # its side is 4.5 cm from where the walker would pass
    engine.advance(20.0)
    gap = math.hypot(3.0 - 0.041 - engine.pose("walker")[0], 0.45 - 0.105) - 0.2
    assert gap == pytest.approx(0.3, abs=0.005)
    passed = make(WALKER)
    passed.add("burger", BURGER, (3.0, 0.7, math.pi))
    passed.advance(11.0)
    assert passed.pose("walker")[0] == pytest.approx(5.5)


@pytest.mark.nightly
def test_a_walker_who_has_waited_for_long_goes_round_the_other_way_until_it_has_to_wait_again():
    square = Walk(((0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)), speed=0.5, patience=5.0)
    engine = make(replace(WALKER, motion=square))
    engine.add("burger", BURGER, (3.0, 0.0, math.pi / 2))
    walker = engine.movers["walker"]
    engine.advance(9.0)
    assert walker.waiting  # since it came to 2.4 m, 4.8 s after it began
    engine.advance(11.8)
    assert not walker.waiting
    assert engine.velocity("walker")[:2] == pytest.approx((-0.5, 0.0), abs=1e-6)
    assert engine.pose("walker")[0] == pytest.approx(2.395 - 0.5 * (11.8 - 9.79), abs=0.02)
    engine.advance(20.0)
    assert engine.pose("walker")[1] > 1.0  # past where it began, up the side where its round ends
    kept = engine.state()
    engine.advance(60.0)
    assert engine.velocity("walker")[:2] != (-0.5, 0.0)
    there = engine.pose("walker")
    engine.restore(kept)
    engine.advance(60.0)
    assert engine.pose("walker") == pytest.approx(there, abs=1e-9)


def test_a_robot_that_drives_into_a_walker_stops_there_and_moves_it_nowhere():
    engine = make(replace(WALKER, motion=Walk(((0.0, 0.0), (0.0, 6.0)), speed=0.01)))
    robot = engine.add("burger", BURGER, (-1.0, 0.1, 0.0))
    engine.command("burger", 0.2, 0.0)
    engine.advance(10.0)
    assert robot.touching
    assert robot.pose[0] + 0.041 <= -0.19 + 1e-3
    assert engine.pose("walker")[0] == 0.0


@pytest.mark.nightly
def test_a_walker_whose_way_is_free_is_not_held_by_who_pushes_it_from_behind():
    engine = make(replace(WALKER, motion=Walk(((0.0, 0.0), (6.0, 0.0)), speed=0.1)))
    engine.add("burger", BURGER, (-0.3, 0.0, 0.0))
    engine.command("burger", 0.22, 0.0)
    engine.advance(20.0)
    assert engine.pose("walker")[0] == pytest.approx(2.0, abs=0.05)
    assert engine.robots["burger"].pose[0] == pytest.approx(2.0 - 0.2 - 0.041, abs=0.05)


LEAF = Obstacle("door", Box(0.9, 0.05), motion=Door(hinge=(-0.45, 0.0), closed=1.0, moving=2.0, open=2.0), height=2.0)


def test_a_door_does_not_close_on_a_robot_but_opens_again():
    engine = make(LEAF)
    robot = engine.add("burger", BURGER, (0.2, 0.0 - 1.0, math.pi / 2))
    engine.advance(3.5)  # it is open
    engine.place("burger", (0.2, 0.0, math.pi / 2))
    angles = [angle for _, angle in watched(engine, 60.0)]
    assert robot.pose == (0.2, 0.0, math.pi / 2)
    assert min(angles) > 0.1  # it came no nearer than it keeps
    assert max(angles[-80:]) == pytest.approx(math.pi / 2)
    engine.place("burger", (0.2, -1.0, math.pi / 2))
    assert min(angle for _, angle in watched(engine, LEAF.motion.period)) == pytest.approx(0.0, abs=1e-3)


@pytest.mark.nightly
def test_a_door_that_opens_onto_a_robot_goes_back_and_leaves_it_room():
    engine = make(LEAF)
    robot = engine.add("burger", BURGER, (0.1, 0.35, 0.0))
    seen = watched(engine, 30.0)
    assert 0.05 < max(angle for _, angle in seen) < 0.7
    assert min(gap for gap, _ in seen) > 0.05  # the robot is wider at its corners
    assert not robot.touching
    shut = [angle < 1e-3 for _, angle in seen]
    assert 3 <= sum(now and not before for before, now in pairwise(shut)) <= 20  # it tried again, and again
    engine.command("burger", 0.2, 0.0)
    assert max(angle for _, angle in watched(engine, 15.0)) == pytest.approx(math.pi / 2)


def watched(engine, seconds):
    """How far the leaf is from the burger's middle, less what the burger has to its side [m], and its angle [rad]."""
    found = []
    begin = engine.now
    for i in range(int(seconds / 0.05)):
        engine.advance(begin + (i + 1) * 0.05)
        x, y, theta = engine.pose("door")
        px, py, _ = engine.pose("burger")
        dx, dy = px - x, py - y
        along = math.cos(theta) * dx + math.sin(theta) * dy
        across = math.cos(theta) * dy - math.sin(theta) * dx
        gap = math.hypot(max(abs(along) - 0.45, 0.0), max(abs(across) - 0.025, 0.0))
        found.append((gap - 0.105, theta))
    return found


def test_two_walkers_do_not_walk_into_each_other():
    other = Obstacle("other", Cylinder(0.2), motion=Walk(((6.0, 0.0), (0.0, 0.0)), speed=0.5))
    engine = make(WALKER, other)
    for t in np.arange(0.5, 15.0, 0.5):
        engine.advance(float(t))
        gap = math.dist(engine.pose("walker")[:2], engine.pose("other")[:2])
        assert gap > 0.4 - 1e-3
    assert gap > 2.0  # they do not wait for ever


def test_a_laser_sees_a_walker_where_it_is():
    engine = make(replace(WALKER, motion=Walk(((1.0, -1.0), (1.0, 1.0)), speed=0.5, loop=False)))
    engine.add("burger", BURGER, (0.0, 0.0, 0.0))
    assert engine.scan("burger")[0] == math.inf
    engine.advance(2.0)
    assert engine.scan("burger")[0] == pytest.approx(0.8 + 0.032)
    assert [part.pose[:2] for part in engine.visible("burger")] == [pytest.approx((1.0, 0.0))]


def test_a_walker_cannot_be_put_but_taken_away_and_inserted():
    engine = make(WALKER)
    engine.add("burger", BURGER, (0.0, 3.0, 0.0))
    engine.advance(2.0)
    with pytest.raises(WorldError, match="'walker' moves by itself: take it away"):
        engine.put("walker", (5.0, 5.0, 0.0))
    engine.remove_obstacle("walker")
    assert engine.movers == {}
    engine.insert(WALKER)
    engine.advance(4.0)
    assert engine.pose("walker")[0] == pytest.approx(1.0)  # by its own clock it began anew
    engine.reset()
    assert engine.pose("walker") == (0.0, 0.0, 0.0)
