"""Many robots: they do not go through one another, cost what they do, and change nothing about each other's noise."""

import math

import numpy as np
import pytest

from rosmini.sim.engine import Engine, RobotGone
from rosmini.sim.models import BURGER, WAFFLE
from rosmini.sim.world import Box, Cylinder, Obstacle, World, WorldError

from .pens import generator, pen


def test_a_robot_that_comes_while_another_rests_is_not_overlooked():
    # the one looks while the other is far away, and rests; later the other comes near, and is pushed still nearer
    engine = Engine(World("void"), generator, noise=0.0)
    engine.add("resting", BURGER, (0.0, 0.0, 0.0))
    engine.add("coming", BURGER, (2.0, 0.0, math.pi))
    engine.command("coming", 0.22, 0.0)
    engine.advance(20.0)
    one, other = engine.robots["resting"], engine.robots["coming"]
    assert other.pose[0] - one.pose[0] == pytest.approx(0.082, abs=1e-3)
    # two robots of one mass and one grip: both slip, at half the speed
    pushed = 20.0 * 0.22 - 0.22**2 / 2 - (2.0 - 0.082)
    assert one.pose[0] == pytest.approx(-pushed / 2, abs=0.02)


def test_of_two_robots_the_one_with_less_grip_gives_way():
    for model, moves in ((WAFFLE, True), (BURGER, False)):
        engine = Engine(World("void"), generator, noise=0.0)
        engine.add("resting", WAFFLE if model is BURGER else BURGER, (0.0, 0.0, 0.0))
        engine.add("coming", model, (1.0, 0.0, math.pi))
        engine.command("coming", 0.2, 0.0)
        engine.advance(10.0)
        assert engine.pose("resting")[0] == pytest.approx(-0.2 * 10 + 0.02 + 1.0 - 0.118 if moves else 0.0, abs=0.01)


def test_a_robot_between_a_stronger_one_and_a_wall_is_not_pushed_through_the_wall():
    engine = Engine(World("wall", walls=np.array([(0.2, -2.0, 0.2, 2.0)])), generator, noise=0.0)
    engine.add("between", BURGER, (0.1, 0.0, 0.0))
    engine.add("strong", WAFFLE, (-0.5, 0.0, 0.0))
    engine.command("strong", 0.26, 0.0)
    engine.advance(4.0)
    assert engine.robots["between"].corners()[:, 0].max() < 0.2 + 1e-4
    assert engine.pose("strong")[0] == pytest.approx(0.2 - 0.146 - 0.077, abs=1e-3)


@pytest.mark.nightly
def test_a_row_of_robots_pushes_as_one():
    engine = Engine(World("void"), generator, noise=0.0)
    for i in range(4):
        engine.add(f"{i}", BURGER, (0.2 * i, 0.0, 0.0))
        engine.command(f"{i}", 0.2, 0.0)
    engine.insert(Obstacle("crate", Box(0.2, 0.4), (1.0, 0.0, 0.0), mass=3.0))
    engine.advance(20.0)
    # one robot's grip, 0.7 * 1 kg, is less than the drag of 0.5 * 3 kg; that of four is more
    assert engine.pose("crate")[0] > 1.2
    alone = Engine(World("void"), generator, noise=0.0)
    alone.add("0", BURGER, (0.6, 0.0, 0.0))
    alone.command("0", 0.2, 0.0)
    alone.insert(Obstacle("crate", Box(0.2, 0.4), (1.0, 0.0, 0.0), mass=3.0))
    alone.advance(20.0)
    assert alone.pose("crate")[0] == pytest.approx(1.0, abs=2e-3)


def test_a_robot_is_removed_while_it_moves_and_pushes_and_is_pushed():
    engine = Engine(World("crate", (Obstacle("crate", Box(0.2, 0.2), (0.5, 0.0, 0.0), mass=0.3),)), generator)
    for i in range(3):
        engine.add(f"{i}", BURGER, (-0.2 * i, 0.0, 0.0))
        engine.command(f"{i}", 0.2, 0.0, 0.5 if i == 1 else 0.0)
    engine.advance(2.5)
    assert engine.robots["0"].pose[0] > 0.3
    engine.remove("1")
    engine.advance(3.0)
    engine.remove("0")
    with pytest.raises(RobotGone, match="robots: 2"):
        engine.robot("0")
    engine.advance(10.0)
    assert engine.robots["2"].pose[0] > 1.0
    engine.remove("2")
    engine.advance(20.0)
    engine.add("0", BURGER, (5.0, 0.0, 0.0))


@pytest.mark.parametrize("restitution", [0.0, 0.25, 0.5, 1.0])
@pytest.mark.parametrize("ratio", [1.0, 3.0])
def test_discs_that_collide_head_on_keep_momentum_and_restitution(restitution, ratio):
    each = math.sqrt(restitution)  # of two things the product counts
    things = tuple(
        Obstacle(name, Cylinder(0.1), (x, 0.0, 0.0), mass=mass, drag=0.0, restitution=each)
        for name, x, mass in (("a", 0.0, 1.0), ("b", 0.5, ratio))
    )
    engine = Engine(World("table", things), generator)
    engine.put("a", (0.0, 0.0, 0.0), (0.8, 0.0, 0.0))
    engine.advance(2.0)
    (u, _, _), (v, _, _) = engine.velocity("a"), engine.velocity("b")
    assert u + ratio * v == pytest.approx(0.8, abs=1e-6)
    assert v - u == pytest.approx(restitution * 0.8, abs=0.01)


def test_equal_discs_that_collide_aslant_part_at_a_right_angle():
    things = tuple(
        Obstacle(name, Cylinder(0.1), (x, y, 0.0), mass=1.0, drag=0.0, restitution=1.0)
        for name, x, y in (("a", 0.0, 0.0), ("b", 0.5, 0.1))
    )
    engine = Engine(World("table", things), generator)
    engine.set_surface(friction=0.0)
    engine.put("a", (0.0, 0.0, 0.0), (0.4, 0.0, 0.0))
    engine.advance(2.0)
    u, v = (np.array(engine.velocity(name)[:2]) for name in "ab")
    assert u @ v == pytest.approx(0.0, abs=2e-3)
    assert u @ u + v @ v == pytest.approx(0.16, abs=2e-3)
    # along the line of their middles at the blow, whose slope is 0.1 in 0.2
    assert math.atan2(v[1], v[0]) == pytest.approx(math.asin(0.1 / 0.2), abs=0.03)


def test_a_thing_slides_v_squared_by_two_mu_g_far():
    for drag, gravity in ((0.5, 9.80665), (0.2, 9.80665), (0.5, 1.62)):
        thing = Obstacle("puck", Cylinder(0.05), mass=0.2, drag=drag)
        engine = Engine(World("ice", (thing,)), generator)
        engine.set_surface(gravity=gravity)
        engine.put("puck", (0.0, 0.0, 0.0), (0.6, 0.0, 0.0))
        engine.advance(5.0)
        assert engine.pose("puck")[0] == pytest.approx(0.6**2 / 2 / drag / gravity, abs=2e-3)
        assert engine.velocity("puck") == pytest.approx((0.0, 0.0, 0.0), abs=1e-4)


@pytest.mark.parametrize(("mass", "moves"), [(1.3, True), (1.5, False)])
def test_wheels_push_no_harder_than_their_grip(mass, moves):
    # Coulomb: 0.7 * 1 kg of the robot against 0.5 * m of the crate
    crate = Obstacle("crate", Box(0.2, 0.2), (0.3, 0.0, 0.0), mass=mass)
    engine = Engine(World("crate", (crate,)), generator, noise=0.0)
    engine.add("burger", BURGER, (0.0, 0.0, 0.0))
    engine.command("burger", 0.2, 0.0)
    engine.advance(6.0)
    assert (engine.pose("crate")[0] > 0.8) == moves
    slipped = engine.robots["burger"].left_distance - engine.pose("burger")[0]
    assert slipped > (-0.01 if moves else 0.5)


def test_a_world_of_a_hundred_thousand_walls():
    rng = np.random.default_rng(0)
    begin = rng.uniform(-100, 100, (110_000, 2))
    begin = begin[np.hypot(*begin.T) > 1.5][:99_999]
    sides = np.hstack([begin, begin + rng.uniform(-0.3, 0.3, begin.shape)])
    maze = World("maze", walls=np.vstack([sides, (1.0, -2.0, 1.0, 2.0)]))
    assert len(maze.walls) == 100_000
    engine = Engine(maze, generator, noise=0.0)
    engine.add("burger", BURGER, (0.0, 0.0, 0.0))
    first = engine.scan("burger")
    everything = Engine(World("near", walls=maze.walls[np.abs(maze.walls).max(axis=1) < 15]), generator)
    everything.add("burger", BURGER, (0.0, 0.0, 0.0))
    np.testing.assert_array_equal(first, everything.scan("burger"))
    engine.command("burger", 0.22, 0.0)
    engine.advance(10.0)
    assert engine.robots["burger"].touching
    assert engine.pose("burger")[0] == pytest.approx(1.0 - 0.041, abs=1e-6)
    everything.place("burger", engine.pose("burger"))
    np.testing.assert_array_equal(engine.scan("burger"), everything.scan("burger"))
    with pytest.raises(WorldError, match=r"the wall from .* is in its way"):
        engine.place("burger", (float(maze.walls[0, 0]), float(maze.walls[0, 1]), 0.0))


def test_names_are_taken_once_and_places_too():
    engine = Engine(pen(2.0), generator)
    engine.add("burger", BURGER, (0.0, 0.0, 0.0))
    box = Obstacle("box", Box(0.2, 0.2), (1.0, 0.0, 0.0), mass=0.5)
    engine.insert(box)
    with pytest.raises(WorldError, match=r"'second' cannot be moved to .* the obstacle 'box' is in its way"):
        engine.insert(Obstacle("second", Box(0.2, 0.2), (1.05, 0.0, 0.0)))
    with pytest.raises(Exception, match="there is an obstacle 'box' in the world 'pen' already"):
        engine.insert(box)
    with pytest.raises(Exception, match="there is an obstacle 'box'"):
        engine.add("box", BURGER, (-1.0, 0.0, 0.0))
    with pytest.raises(WorldError, match="the robot 'burger' is in its way"):
        engine.put("box", (0.0, 0.1, 0.0))
    with pytest.raises(WorldError, match="finite"):
        engine.put("box", (0.0, math.nan, 0.0))
    with pytest.raises(RobotGone, match="nothing 'bocks'"):
        engine.remove_obstacle("bocks")
    engine.put("box", (-1.0, 0.0, 0.5))
    assert engine.pose("box") == pytest.approx((-1.0, 0.0, 0.5))
    engine.remove_obstacle("box")
    assert engine.world.obstacles == ()
    engine.insert(Obstacle("block", Box(0.2, 0.2), (0.5, 0.0, 0.0)))
    engine.command("burger", 0.2, 0.0)
    engine.advance(5.0)
    assert engine.pose("burger")[0] == pytest.approx(0.4 - 0.041, abs=1e-6)
    engine.put("block", (-0.5, 0.0, 0.0))  # a fixed one is not pushed, but it can be put elsewhere
    engine.advance(6.0)
    assert engine.pose("burger")[0] > 0.45
    engine.remove_obstacle("block")
    assert np.isfinite(engine.scan("burger")).all()
