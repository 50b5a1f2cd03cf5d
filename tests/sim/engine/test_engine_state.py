"""A state that is taken and brought back: the same happens again, to the last bit."""

import pickle
from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from rosmini.sim.engine import Engine
from rosmini.sim.models import BURGER, WAFFLE
from rosmini.sim.motion import Walk
from rosmini.sim.world import Box, Cylinder, Obstacle, World

OMNI = replace(BURGER, name="omni", drive="holonomic", linear_acceleration=0.8)
TROLLEY = replace(BURGER, name="trolley", drive=None, mass=0.3)

YARD = World(
    "yard",
    (
        Obstacle("crate", Box(0.2, 0.3), (0.5, 0.0, 0.1), mass=0.3),
        Obstacle("ball", Cylinder(0.08), (0.0, 0.7, 0.0), mass=0.2, restitution=0.5),
        Obstacle("pillar", Cylinder(0.15), (-0.6, -0.6, 0.0)),
        Obstacle("walker", Cylinder(0.15), motion=Walk(((1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)), speed=0.3)),
    ),
    np.array([(-1.5, -1.5, 1.5, -1.5), (1.5, -1.5, 1.5, 1.5), (1.5, 1.5, -1.5, 1.5), (-1.5, 1.5, -1.5, -1.5)]),
)


def make():
    engine = Engine(YARD, lambda name: np.random.default_rng(sum(name.encode())))
    engine.add("one", BURGER, (0.2, 0.0, 0.0))
    engine.add("two", WAFFLE, (-0.9, 0.3, 0.0))
    engine.add("three", OMNI, (0.5, -0.8, 1.0))
    engine.add("trolley", TROLLEY, (0.0, 0.3, 0.0))
    return engine


def drive(engine, seed, seconds, look=1 / 10):
    rng = np.random.default_rng(seed)
    end = engine.now + seconds
    while engine.now < end - 1e-9:
        for name in engine.robots:
            if engine.robots[name].model.drive:
                v, w, vy = rng.uniform((-0.05, -1.2, -0.2), (0.22, 1.2, 0.2)).tolist()
                engine.command(name, v, w, 0.3, vy=vy)
        until = min(engine.now + 0.4, end)
        while engine.now < until - 1e-9:
            engine.advance(min(engine.now + look, until))


def picture(engine):
    robots = [(r.name, r.pose, r.velocity, r.ticks, r.touching) for r in engine.robots.values()]
    scans = [engine.scan(name).tolist() for name in engine.robots]
    return (engine.now, robots, [(o.name, o.pose) for o in engine.obstacles()], scans)


@settings(max_examples=2)
@given(st.floats(0.0, 4.0), st.integers(0, 1000))
def test_the_same_happens_from_a_state_on(seconds, seed):
    engine = make()
    drive(engine, seed, seconds)
    state, seen = engine.state(), picture(engine)
    drive(engine, seed + 1, 2.0)
    later = picture(engine)
    engine.restore(state)
    assert picture(engine) == seen
    drive(engine, seed + 1, 2.0)
    assert picture(engine) == later
    # and in another engine, from bytes
    other = Engine(World("elsewhere"), lambda name: np.random.default_rng(1))
    other.add("somebody", BURGER, (3.0, 0.0, 0.0))
    other.restore(pickle.loads(pickle.dumps(state)))
    assert picture(other) == seen
    drive(other, seed + 1, 2.0)
    assert picture(other) == later


def test_robots_and_things_that_came_and_went_since_go_and_come_back():
    engine = make()
    drive(engine, 5, 1.0)
    one = engine.robots["one"]
    state, seen = engine.state(), picture(engine)
    engine.remove("two")
    engine.add("four", BURGER, (1.2, 1.2, 0.0))
    engine.remove_obstacle("pillar")
    engine.remove_obstacle("walker")
    engine.insert(Obstacle("new", Box(0.1, 0.1), (-1.3, -1.3, 0.0), mass=0.1))
    drive(engine, 6, 1.0)
    engine.restore(state)
    assert list(engine.robots) == ["one", "two", "three", "trolley"]
    assert engine.robots["one"] is one  # whoever holds it goes on with it
    assert {o.name for o in engine.world.obstacles} == {"crate", "ball", "pillar", "walker"}
    assert picture(engine) == seen
    assert not any(touch.other == "new" for name in engine.robots for touch in engine.touching(name))


def test_errors_and_settings_come_back_too():
    engine = make()
    engine.set_surface(gravity=3.7)
    state = engine.state()
    wheels = [engine.robots["one"].wheels.left for _ in range(1)]
    engine.advance(5.0)  # the slips of five seconds are drawn
    engine.set_surface(gravity=9.8)
    drawn = engine.robots["one"].wheels.left
    engine.restore(state)
    assert engine.surface.gravity == 3.7
    assert [engine.robots["one"].wheels.left] == wheels
    engine.advance(5.0)
    assert engine.robots["one"].wheels.left == drawn
