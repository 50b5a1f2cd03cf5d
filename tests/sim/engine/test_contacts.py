"""What is where and in whose way, how much room there is, and crowds that go through nothing."""

import gc
import math

import numpy as np
import pytest

from rosmini.core.geometry import polygons
from rosmini.sim.engine import Engine
from rosmini.sim.geometry.overlaps import Outline, no_outlines
from rosmini.sim.models import BURGER, WAFFLE
from rosmini.sim.motion import Walk
from rosmini.sim.world import Box, Cylinder, Obstacle, Polygon, World, WorldError

from ...conftest import nightly
from .pens import generator, pen

ANGLE = Polygon(((0.0, 0.0), (0.4, 0.0), (0.4, 0.1), (0.1, 0.1), (0.1, 0.4), (0.0, 0.4)))


PILLARS = (
    Obstacle("pillar", Cylinder(0.1), (0.4, 0.3, 0.0)),
    Obstacle("wedge", Polygon(((0.0, 0.0), (0.4, 0.0), (0.0, 0.3))), (-0.5, -0.4, 0.3)),
    Obstacle("shelf", Box(0.5, 0.2), (0.3, -0.5, 0.0), bottom=1.0, height=1.2),
)
CRATES = (
    Obstacle("crate", Box(0.2, 0.15), (-0.3, 0.6, 0.4), mass=1.0),
    Obstacle("ball", Cylinder(0.08), (0.7, -0.2, 0.0), mass=0.2),
)


def crowded(world, count, seed):
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


def drive(engine, rng, seconds):
    for name, robot in engine.robots.items():
        fast = robot.model.max_linear
        engine.command(name, *rng.uniform((-fast / 2, -1.5), (fast, 1.5)).tolist())
    engine.advance(engine.now + seconds)


def there(*obstacles, walls=()):
    world = World("test", obstacles, np.array(walls, dtype=float).reshape(-1, 4))
    return Engine(world, generator, noise=0.0)


def test_an_outline_with_an_inner_corner_keeps_its_shape_and_its_mass():
    made = there(Obstacle("angle", ANGLE, (1.0, 1.0, math.pi / 2), mass=2.0))
    body = made.contacts.bodies["angle"]
    assert body.mass.mass == 2.0
    assert sum(polygons.area(piece.corners) for piece in body.pieces) == pytest.approx(0.07)
    assert (body.mass.x, body.mass.y) == pytest.approx((0.19 / 1.4, 0.19 / 1.4))
    obstruction = made.contacts.obstruction
    assert obstruction(BURGER, (0.8, 1.25, 0.0)) is None  # in the open corner
    assert obstruction(BURGER, (0.95, 1.05, 0.0)) == "the obstacle 'angle'"
    assert made.obstacles()[0].pose == pytest.approx((1.0, 1.0, math.pi / 2))


def test_a_thing_without_symmetry_slides_and_turns_about_its_centre_of_mass():
    engine = there(Obstacle("angle", ANGLE, (1.0, 1.0, 0.0), mass=2.0))
    c = 0.19 / 1.4
    w = 3.0
    engine.put("angle", (1.0, 1.0, 0.0), (0.5 + w * c, -w * c, w))  # so its centre goes along x with 0.5 m/s
    engine.advance(1.0)
    x, y, theta = engine.pose("angle")
    assert engine.velocity("angle") == (0.0, 0.0, 0.0)
    assert theta > 0.1
    middle = (x + math.cos(theta) * c - math.sin(theta) * c, y + math.sin(theta) * c + math.cos(theta) * c)
    # a mass that slides to rest with friction 0.5 goes v^2 / 2 mu g
    assert middle == pytest.approx((1.0 + c + 0.5**2 / 2 / 0.5 / 9.80665, 1.0 + c), abs=1e-3)


def entries(engine):
    """How many objects hang on an engine; of shared ones, as of classes, nothing is counted."""
    seen = set()
    todo = [engine]
    while todo:
        each = todo.pop()
        if id(each) not in seen and not isinstance(each, (type, type(gc), type(entries))):
            seen.add(id(each))
            todo += gc.get_referents(each)
    return len(seen)


def test_five_hundred_spawns_and_deletions_leave_nothing_behind():
    engine = there(walls=((5.0, -9.0, 5.0, 9.0),))
    engine.add("burger", BURGER, (0.0, 0.0, 0.0))
    engine.command("burger", 0.05, 0.3)

    def come_and_go(number):
        at = (2.0 + 0.3 * (number % 7), 1.0 + number % 5, 0.0)
        kinds = (
            Obstacle(f"box {number}", Box(0.2, 0.2), at),
            Obstacle(f"crate {number}", Box(0.2, 0.2), at, mass=0.4),
            Obstacle(f"walker {number}", Cylinder(0.1), motion=Walk((at[:2], (at[0], at[1] + 0.5)))),
        )
        name = f"robot {number}"
        if number % 4 == 3:
            engine.add(name, WAFFLE, at)
        else:
            name = kinds[number % 4].name
            engine.insert(kinds[number % 4])
        if number % 10 == 0:
            engine.advance(engine.now + 0.011)
            engine.scan("burger")
        (engine.remove if number % 4 == 3 else engine.remove_obstacle)(name)

    for number in range(100):
        come_and_go(number)
    before = entries(engine)
    for number in range(100, 500):
        come_and_go(number)
    assert entries(engine) <= before + 20
    assert len(engine.world.obstacles) == 0


def overlap(one, other):
    there = no_outlines()
    there.insert("other", other)
    return bool(there.find(one))


@pytest.mark.parametrize("seed", [0, *nightly(1, 2)])
def test_a_crowd_goes_through_nothing(seed):
    engine = crowded(pen(1.6, *PILLARS, *CRATES), 30, seed)
    rng = np.random.default_rng(seed)
    touched = 0
    for _ in range(4):
        drive(engine, rng, float(rng.uniform(0.3, 1.5)))
        touched += sum(robot.touching for robot in engine.robots.values())
        pillar, ball = (Outline(np.array([at[:2]]), r) for at, r in (((0.4, 0.3), 0.095), (engine.pose("ball"), 0.075)))
        outlines = [robot.corners() for robot in engine.robots.values()]
        for i, corners in enumerate(outlines):
            assert abs(corners).max() < 1.6 + 1e-3
            assert not overlap(Outline(corners), pillar)
            assert not overlap(Outline(corners), ball)
            inner = Outline(corners.mean(axis=0) + 0.95 * (corners - corners.mean(axis=0)))  # 5 mm are allowed
            assert not any(overlap(inner, Outline(other)) for other in outlines[:i])
    assert touched > 8
