"""Many robots at once: the same answers as pymunk gives robot by robot, and nobody goes through anything."""

from __future__ import annotations

import math

import numpy as np
import pymunk
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from rosmini.sim.engine import Engine, crowd, crowd_numba, physics, pushing
from rosmini.sim.engine.bodies import VIEW, depths_of, put
from rosmini.sim.engine.physics import Contacts
from rosmini.sim.models import BURGER, WAFFLE
from rosmini.sim.world import Box, Cylinder, Obstacle, Polygon, World, WorldError

pytest.importorskip("numba")

KINDS = ("disc", "robot", "triangle", "wall")


def shape_of(kind: str) -> tuple[pymunk.Body, pymunk.Shape]:
    """Something that a robot can bump into; its body goes with it, for a shape alone keeps none."""
    body = pymunk.Body(1.0, 1.0)
    if kind == "disc":
        return body, pymunk.Circle(body, 0.08, (0.02, 0.0))
    if kind == "wall":
        return body, pymunk.Segment(body, (-0.3, 0.0), (0.5, 0.0), 0.0)
    triangle = [(-0.1, -0.1), (0.2, -0.05), (0.0, 0.2)]
    outlines = {"burger": BURGER.footprint, "robot": WAFFLE.footprint, "triangle": triangle}
    return body, pymunk.Poly(body, outlines[kind])


places = st.floats(-0.4, 0.4)
headings = st.floats(-math.pi, math.pi)


def placed(shape: pymunk.Shape, pose: tuple[float, float, float]) -> tuple[np.ndarray, float]:
    """The outline of a shape there."""
    outline, radius = crowd.piece_of(shape)
    c, s = math.cos(pose[2]), math.sin(pose[2])
    return outline @ np.array([[c, s], [-s, c]]) + pose[:2], radius


def generator(name: str) -> np.random.Generator:
    return np.random.default_rng(sum(name.encode()))


def pen(half: float, *obstacles: Obstacle) -> World:
    h = half
    sides = np.array([(-h, -h, h, -h), (h, -h, h, h), (h, h, -h, h), (-h, h, -h, -h)])
    return World("pen", obstacles, walls=sides)


PILLARS = (
    Obstacle("pillar", Cylinder(0.1), (0.4, 0.3, 0.0)),
    Obstacle("wedge", Polygon(((0.0, 0.0), (0.4, 0.0), (0.0, 0.3))), (-0.5, -0.4, 0.3)),
    Obstacle("shelf", Box(0.5, 0.2), (0.3, -0.5, 0.0), bottom=1.0, height=1.2),
)
CRATES = (
    Obstacle("crate", Box(0.2, 0.15), (-0.3, 0.6, 0.4), mass=1.0),
    Obstacle("ball", Cylinder(0.08), (0.7, -0.2, 0.0), mass=0.2),
)


def crowded(world: World, count: int, seed: int) -> Engine:
    rng = np.random.default_rng(seed)
    half = float(world.walls.max())
    engine = Engine(world, generator)
    while len(engine.robots) < count:
        x, y = rng.uniform(-half + 0.25, half - 0.25, 2).tolist()
        model = WAFFLE if len(engine.robots) % 5 == 4 else BURGER
        try:
            engine.add(f"robot {len(engine.robots)}", model, (x, y, float(rng.uniform(-3, 3))))
        except WorldError:
            continue
    return engine


def drive(engine: Engine, rng: np.random.Generator, seconds: float) -> None:
    for name, robot in engine.robots.items():
        fast = robot.model.max_linear
        engine.command(name, *rng.uniform((-fast / 2, -1.5), (fast, 1.5)).tolist())
    engine.advance(engine.now + seconds)


# -- two outlines ----------------------------------------------------------------------------------------------------


@settings(max_examples=300, deadline=None)
@given(st.sampled_from(KINDS), places, places, headings, headings)
def test_two_outlines_overlap_where_and_as_deep_as_pymunk_says(kind, x, y, theta, other_theta):
    own, burger = shape_of("burger")
    body, shape = shape_of(kind)
    put(own, (0.0, 0.0, theta))
    put(body, (x, y, other_theta))
    space = pymunk.Space()
    space.add(body, shape)
    hits = [hit.contact_point_set for hit in space.shape_query(burger)]
    depth = max((depth for hit in hits for depth in depths_of(hit)), default=0.0)
    a, _ = placed(burger, (0.0, 0.0, theta))
    b, radius = placed(shape, (x, y, other_theta))
    found = crowd_numba.contact(a, 0, len(a), b, 0, len(b), radius, 1e-9)
    assert max(found[3], found[6]) == pytest.approx(depth, abs=1e-8)
    assert bool(found[0]) == (depth > 1e-9) or depth < 2e-8
    expected = hits[0] if hits else pymunk.ContactPointSet(pymunk.Vec2d(0.0, 0.0), ())
    if found[0] and found[1] * expected.normal.x + found[2] * expected.normal.y > 1 - 1e-6:
        # of equal ways out either may be taken; if it is the same one, the points are the same
        assume(len(expected.points) == found[0])
        assert sorted([found[3], found[6]][: found[0]]) == pytest.approx(
            sorted(depths_of(expected)), abs=1e-6
        )
        mine = [found[4:6], found[7:9]][: found[0]]
        its = [tuple(point.point_a) for point in expected.points]
        if math.dist(mine[0], its[0]) > math.dist(mine[0], its[-1]):
            its.reverse()
        for one, other in zip(mine, its, strict=True):
            assert one == pytest.approx(other, abs=1e-5)


@settings(max_examples=200, deadline=None)
@given(st.sampled_from(KINDS), places, places, headings, headings)
def test_two_outlines_are_as_far_apart_as_pymunk_says(kind, x, y, theta, other_theta):
    contacts = Contacts(World("void"))
    contacts.add("burger", BURGER, (0.0, 0.0, theta))
    body, shape = shape_of(kind)
    put(body, (x, y, other_theta))
    contacts.space.add(body, shape)
    a, _ = placed(contacts.rovers["burger"].shape, (0.0, 0.0, theta))
    b, radius = placed(shape, (x, y, other_theta))
    expected = [
        VIEW - max(depths_of(hit.contact_point_set))
        for hit in contacts.space.shape_query(contacts.rovers["burger"].view)
        if hit.shape is shape
    ]
    found = crowd_numba.gap(a, 0, len(a), b, 0, len(b), radius)
    assert (
        (found < VIEW + 1e-9 and found == pytest.approx(expected[0], abs=1e-7))
        if expected
        else found > VIEW - 1e-9
    )


def test_robots_that_coincide_are_told_how_to_part():
    a = np.array(BURGER.footprint)
    count, nx, ny, depth, *_ = crowd_numba.contact(a, 0, 4, a.copy(), 0, 4, 0.0, 0.0)
    assert count == 2
    assert math.hypot(nx, ny) == pytest.approx(1.0)
    assert depth == pytest.approx(0.146)  # a Burger's length, which is less than its width


# -- a crowd beside one robot after the other ------------------------------------------------------------------------


def mixed_up(seed: int) -> tuple[Contacts, dict[str, tuple[float, float, float]]]:
    """Robots, walls and things; some of the robots reach into one another, and into the rest, by up to a few millimetres."""
    engine = crowded(pen(1.1, *PILLARS, *CRATES), 12, seed)
    rng = np.random.default_rng(seed)
    drive(engine, rng, 3.0)
    drive(engine, rng, 3.0)
    contacts = engine.contacts
    contacts.wake(engine.robots)
    poses = {}
    for name, robot in engine.robots.items():
        dx, dy, turn = rng.uniform(-0.002, 0.002, 3).tolist()
        poses[name] = (robot.pose[0] + dx, robot.pose[1] + dy, robot.pose[2] + turn)
    return contacts, poses


@pytest.mark.parametrize("seed", range(12))
def test_a_crowd_makes_way_as_one_robot_after_the_other_does(seed):
    contacts, poses = mixed_up(seed)
    one, other = dict(poses), dict(poses)
    moved = pushing.one_by_one(contacts, one, list(one))
    limits = (pushing.ROUNDS, pushing.QUICK, pushing.TOUCH, pushing.NEARLY, pushing.SLACK)
    assert contacts.crowd.make_way(contacts, other, list(other), limits) == moved
    for name, pose in one.items():
        assert other[name] == pytest.approx(pose, abs=1e-6)
        assert (other[name] == poses[name]) == (pose == poses[name])


@pytest.mark.parametrize("seed", range(6))
def test_a_crowd_looks_around_as_one_robot_after_the_other_does(seed):
    contacts_seen = []
    for at_once in (False, True):
        engine = crowded(pen(2.0, *PILLARS, *CRATES), 15, seed)
        if at_once:
            engine.contacts.crowd.look(engine.contacts, engine.robots, list(engine.robots), 1e-4)
        else:
            for robot in engine.robots.values():
                engine.clockwork.look(robot)
        contacts_seen.append([(robot.room, robot.clear) for robot in engine.robots.values()])
    assert np.array(contacts_seen[0]) == pytest.approx(np.array(contacts_seen[1]), abs=1e-7)


def test_machine_code_and_plain_python_part_a_crowd_equally_to_the_last_bit(monkeypatch):
    contacts, poses = mixed_up(3)
    limits = (pushing.ROUNDS, pushing.QUICK, pushing.TOUCH, pushing.NEARLY, pushing.SLACK)
    one, other = dict(poses), dict(poses)
    contacts.crowd.make_way(contacts, one, list(one), limits)
    monkeypatch.setattr(crowd, "compiled", lambda: (crowd_numba.part_all, crowd_numba.look))
    contacts.crowd.make_way(contacts, other, list(other), limits)
    assert one == other != poses


# -- what happens ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(3))
def test_a_crowd_goes_through_nothing(seed):
    engine = crowded(pen(1.6, *PILLARS, *CRATES), 30, seed)
    rng = np.random.default_rng(seed)
    touched = 0
    for _ in range(8):
        drive(engine, rng, float(rng.uniform(0.3, 1.5)))
        touched += sum(robot.touching for robot in engine.robots.values())
        engine.clockwork.tell_places()
        for robot in engine.robots.values():
            assert abs(robot.corners()).max() < 1.6 + 1e-3
            for hit in engine.contacts.space.shape_query(engine.contacts.rovers[robot.name].feel):
                owner = engine.contacts.owners[hit.shape]
                if owner.name not in (robot.name, "shelf"):  # a Burger fits under that
                    assert max(depths_of(hit.contact_point_set)) < 0.005
    assert touched > 8


def test_a_crowd_that_is_brought_back_goes_on_equally_to_the_last_bit():
    engine = crowded(pen(1.2, *PILLARS, *CRATES), 14, 5)
    drive(engine, np.random.default_rng(0), 2.0)
    state = engine.state()

    def run(engine: Engine) -> list:
        rng = np.random.default_rng(1)
        for _ in range(4):
            drive(engine, rng, 0.7)
        return [robot.pose for robot in engine.robots.values()] + [o.pose for o in engine.obstacles()]

    expected = run(engine)
    engine.restore(state)
    assert run(engine) == expected
    other = Engine(engine.world, generator)
    other.restore(state)
    assert run(other) == expected


def test_things_that_come_and_go_are_in_a_crowds_way_while_they_are_there():
    engine = crowded(pen(3.0), 5, 1)
    for i, name in enumerate(engine.robots):
        engine.put(name, (0.0, 0.35 * i - 0.7, 0.0))
    engine.insert(Obstacle("bar", Box(0.1, 2.5), (0.5, 0.0, 0.0)))
    front = {name: max(x for x, _ in robot.model.footprint) for name, robot in engine.robots.items()}
    for taken, limit in ((False, 0.45 + 1e-4), (True, 3.0)):
        if taken:
            engine.take_away("bar")
        for name in engine.robots:
            engine.command(name, 0.2, 0.0)
        engine.advance(engine.now + 5.0)
        for name, robot in engine.robots.items():
            assert robot.pose[0] + front[name] * math.cos(robot.pose[2]) < limit
    assert min(robot.pose[0] for robot in engine.robots.values()) > 0.8


def test_without_numba_pymunk_does_it(monkeypatch):
    for module in (pushing, physics):
        monkeypatch.setattr(module, "fast", lambda: False)
    monkeypatch.setattr(crowd, "compiled", lambda: pytest.fail("there is no machine code"))
    engine = crowded(pen(1.0), 10, 2)
    drive(engine, np.random.default_rng(2), 2.0)
    assert any(robot.touching for robot in engine.robots.values())
