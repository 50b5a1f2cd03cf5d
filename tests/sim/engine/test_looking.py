"""Looking changes nothing: not one bit of a trajectory, with numba or without, alone or with others far away."""

import math
import pickle
from dataclasses import replace

import numpy as np
import pytest

from rosmini.sim.engine import Engine, scene
from rosmini.sim.engine.kernels import PLAIN
from rosmini.sim.models import BURGER, WAFFLE
from rosmini.sim.motion import Door, Walk
from rosmini.sim.world import Box, Compound, Cylinder, Obstacle, Polygon, World

from ...conftest import nightly
from .pens import generator, pen

OMNI = replace(BURGER, name="omni", drive="holonomic", linear_acceleration=0.8)
TROLLEY = replace(BURGER, name="trolley", drive=None, mass=0.3)
SECONDS = 3.0


def made(world, **robots):
    engine = Engine(world, generator)
    for name, (model, pose) in robots.items():
        engine.add(name, model, pose)
    return engine


def struck():
    """A crate that a robot strikes, and that strikes another."""
    crates = (
        Obstacle("crate", Box(0.2, 0.2), (0.25, 0.03, 0.3), mass=0.3, restitution=0.6),
        Obstacle("ball", Cylinder(0.08), (0.6, 0.0, 0.0), mass=0.2, restitution=0.8, drag=0.05),
    )
    engine = made(pen(1.0, *crates), one=(BURGER, (0.0, 0.0, 0.0)))
    engine.put("ball", (0.6, 0.05, 0.0), (-0.7, 0.0, 2.0))
    return engine


def two_that_push_one():
    crate = Obstacle("crate", Box(0.2, 0.5), (0.3, 0.0, 0.0), mass=1.6)
    return made(World("hall", (crate,)), one=(BURGER, (0.1, -0.12, 0.0)), two=(WAFFLE, (0.1, 0.16, 0.0)))


def along_a_wall():
    wedge = Obstacle("wedge", Polygon(((0.0, 0.0), (0.4, 0.0), (0.0, 0.3))), (0.7, 0.6, 3.0))
    return made(pen(0.8, wedge), one=(BURGER, (0.0, 0.66, 0.9)), omni=(OMNI, (0.66, -0.5, -0.6)))


def yard():
    """Something of everything."""
    legs = Compound(tuple((Cylinder(0.03), (x, y, 0.0)) for x in (-0.2, 0.2) for y in (-0.15, 0.15)))
    things = (
        Obstacle("table", legs, (0.0, 0.75, 0.2), mass=0.4),
        Obstacle("walker", Cylinder(0.15), motion=Walk(((0.9, -0.9), (0.9, 0.9), (-0.9, 0.0)), speed=0.5)),
        Obstacle("door", Box(0.5, 0.04), (-0.7, 0.4, 0.0), motion=Door(hinge=(-0.25, 0.0), closed=0.3, open=0.5)),
        Obstacle("shelf", Box(0.5, 0.2), (0.3, -0.5, 0.0), bottom=1.0, height=1.2),
    )
    return made(
        pen(1.2, *things),
        one=(BURGER, (0.0, 0.3, 1.2)),
        two=(WAFFLE, (-0.6, -0.3, 0.0)),
        omni=(OMNI, (0.5, -0.8, 1.0)),
        trolley=(TROLLEY, (-0.2, -0.25, 0.3)),
    )


def crowd():
    engine = made(pen(0.9, Obstacle("crate", Box(0.15, 0.2), (0.0, 0.0, 0.4), mass=0.5)))
    for i in range(12):
        x, y = 0.62 * math.cos(i * math.tau / 12), 0.62 * math.sin(i * math.tau / 12)
        engine.add(f"robot {i}", BURGER, (x, y, i * math.tau / 12 + 2.5))
    return engine


SCENES = [struck, two_that_push_one, along_a_wall, yard, *nightly(crowd)]


def told(engine, seed):
    """What the robots are told, and when: some of it on the grid of the physics, some beside it."""
    rng = np.random.default_rng(seed)
    orders = []
    for name, robot in engine.robots.items():
        if robot.model.drive is None or name.startswith("far"):
            continue
        for _ in range(5):
            when = float(rng.choice([rng.uniform(0.0, SECONDS), 0.1 * rng.integers(0, 30), 0.0]))
            v, vy, w = rng.uniform((-0.05, -0.2, -1.0), (0.22, 0.2, 1.0)).tolist()
            orders.append((when, name, (v, vy, w), float(rng.choice([0.0, 0.37]))))
    return sorted(orders)


def run(engine, seed, look=None):
    """Where everything is every 50 ms, and what is felt."""
    orders = told(engine, seed)
    rng = np.random.default_rng(seed + 1)
    seen = []
    for number in range(1, round(SECONDS * 20) + 1):
        end = number / 20
        while engine.now < end:
            until = min([end, *(when for when, *_ in orders[:1])])
            if look is not None:
                for time in sorted(rng.uniform(engine.now, until, 3).tolist()):
                    engine.advance(time)
                    look(engine, rng)
            engine.advance(until)
            while orders and orders[0][0] <= until:
                _, name, (v, vy, w), timeout = orders.pop(0)
                engine.command(name, v, w, timeout, vy=vy)
        seen.append(picture(engine))
    return seen


def picture(engine):
    robots = [each for each in engine.robots.values() if not each.name.startswith("far")]
    return (
        [(r.name, r.pose, r.velocity, r.motion(), r.touching, r.ticks) for r in robots],
        [(o.name, o.pose, engine.velocity(o.name)) for o in engine.obstacles()],
        [engine.touching(r.name) for r in robots],
    )


def glance(engine, rng):
    names = list(engine.robots)
    name = names[int(rng.integers(len(names)))]
    what = int(rng.integers(5))
    if what == 0:
        picture(engine)
    elif what == 1:
        engine.trails.remember(0.2)
        engine.sweep(name, 0.2 / 360)
    elif what == 2:
        engine.predict_pose(name, engine.now + 0.03)
    elif what == 3:
        engine.obstruction(BURGER, (float(rng.uniform(-1, 1)), 0.0, 0.0))
    else:
        engine.scan(name)


def save(engine, rng):
    state = engine.state()
    if rng.random() < 0.3:
        state = pickle.loads(pickle.dumps(state))
    if rng.random() < 0.6:
        if rng.random() < 0.5:
            engine.advance(engine.now + float(rng.uniform(0.0, 0.2)))
        engine.restore(state)


@pytest.mark.parametrize("look", [glance, save])
@pytest.mark.parametrize("scenery", SCENES)
@pytest.mark.parametrize("seed", [0, *nightly(1)])
def test_who_looks_or_saves_changes_nothing(scenery, seed, look):
    assert run(scenery(), seed, look) == run(scenery(), seed)


@pytest.mark.parametrize("scenery", [yard, *nightly(struck, two_that_push_one, along_a_wall, crowd)])
def test_with_numba_and_without_everything_is_equal_to_the_last_bit(scenery, monkeypatch):
    pytest.importorskip("numba")
    for kernel in scene.KERNELS.values():
        kernel()  # from now on it is used at once
    expected = run(scenery(), 1)
    assert any(robot[4] for robots, _, _ in expected for robot in robots)  # something touched
    monkeypatch.setattr(scene.Loops, "run", lambda self, name, size, *args: PLAIN[name](*args))
    assert run(scenery(), 1) == expected


@pytest.mark.parametrize("count", [1, *nightly(9)])
@pytest.mark.parametrize("scenery", SCENES)
def test_robots_far_away_change_nothing(scenery, count):
    engine = scenery()
    for i in range(count):
        engine.add(f"far {i}", BURGER, (9.0 + 0.2 * i, 9.0, 0.0))  # so near that they push each other
        engine.command(f"far {i}", 0.2, 0.1 * i)
    assert run(engine, 2, glance) == run(scenery(), 2)


def test_a_command_within_a_step_counts_from_the_end_of_the_step_for_who_is_kept_from_its_way():
    wall = World("wall", walls=np.array([(0.3, -1.0, 0.3, 1.0)]))
    engine = made(wall, one=(BURGER, (0.25, 0.0, 0.0)))
    engine.command("one", 0.2, 0.0)
    engine.advance(2.0)
    robot = engine.robots["one"]
    assert robot.touching
    engine.advance(2.002)
    engine.command("one", -0.2, 0.0)
    turned = robot.left_distance
    engine.advance(2.005)
    assert robot.left_distance == pytest.approx(turned + 0.003 * robot.left)
    assert robot.left > 0.199
    engine.advance(2.105)  # it brakes from 2.005 on
    assert robot.left == pytest.approx(0.2 - 0.1, abs=1e-9)
    free = made(World("void"), one=(BURGER, (0.25, 0.0, 0.0)))
    free.advance(2.002)
    free.command("one", 0.2, 0.0)
    free.advance(2.102)
    assert free.robots["one"].left == pytest.approx(0.1, abs=1e-9)


def test_what_is_put_somewhere_within_a_step_is_there_at_once_and_goes_on():
    engine = made(World("void", (Obstacle("puck", Cylinder(0.05), mass=0.2, drag=0.0),)))
    engine.advance(1.002)
    engine.put("puck", (3.0, 0.0, 0.0), (1.0, 0.0, 0.0))
    assert engine.pose("puck") == (3.0, 0.0, 0.0)
    for when in (1.003, 1.005, 1.0075, 1.055):
        engine.advance(when)
        assert engine.pose("puck")[0] == pytest.approx(3.0 + when - 1.002)
