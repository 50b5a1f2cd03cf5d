"""Taking robots and things by hand: what is refused, walls among it, and that nothing has changed then."""

import pickle

import numpy as np
import pytest

from rosmini.core.errors import RosminiError
from rosmini.sim.dragging import drag
from rosmini.sim.engine import Engine
from rosmini.sim.models import BURGER
from rosmini.sim.motion import Walk
from rosmini.sim.shapes import Compound
from rosmini.sim.world import Box, Cylinder, Obstacle, World

WORLD = World(
    "yard",
    (
        Obstacle("fence", Box(0.1, 4.0), (2.0, 0.0, 0.0)),
        Obstacle("bridge", Box(1.0, 1.0), (-3.0, 0.0, 0.0), 2.0, bottom=1.0),
        Obstacle("box", Box(0.4, 0.4), (1.0, 1.0, 0.0), mass=1.0),
        Obstacle("drum", Cylinder(0.2), (1.0, -1.0, 0.0), mass=1.0),
        Obstacle(
            "chair",
            Compound(((Box(0.1, 0.1), (0.4, 0.0, 0.0)), (Box(0.1, 0.1), (-0.4, 0.0, 0.0)))),
            (0.0, 2.5, 0.0),
            mass=2.0,
        ),
        Obstacle("walker", Cylinder(0.2), (-1.0, -2.0, 0.0), motion=Walk(((-1.0, -2.0), (-1.0, -3.0)), 1.0)),
    ),
    walls=np.array([(-4.0, 4.0, 4.0, 4.0)]),
)


@pytest.fixture
def engine():
    engine = Engine(WORLD, lambda _: np.random.default_rng(0), noise=0.0)
    engine.add("burger", BURGER, (0.0, 0.0, 0.0))
    return engine


@pytest.mark.parametrize(
    ("name", "to", "what"),
    [
        ("box", (1.8, 0.0, 0.0), "the obstacle 'fence'"),
        ("box", (1.0, 3.9, 0.0), "the wall from"),
        ("drum", (1.0, 3.9, 0.0), "the wall from"),
        ("drum", (1.0, 1.3, 0.0), "'box'"),
        ("drum", (0.1, 0.0, 0.0), "the robot 'burger'"),
        ("chair", (1.6, 0.0, 0.0), "the obstacle 'fence'"),
        ("burger", (2.0, 1.0, 0.0), "the obstacle 'fence'"),
        ("burger", (1.0, -1.0, 0.0), "'drum'"),
        ("walker", (0.0, -2.0, 0.0), "moves by itself"),
        ("box", (float("nan"), 0.0, 0.0), "finite"),
        ("fence", (0.0, -3.0, 0.0), "'fence' is fixed"),
        ("drun", (0.0, -3.0, 0.0), "did you mean drum"),
    ],
)
def test_an_occupied_place_is_refused(engine, name, to, what):
    before = engine.state()
    with pytest.raises(RosminiError, match=what):
        drag(engine, name, to)
    assert pickle.dumps(engine.state()) == pickle.dumps(before)


def test_what_stands_between_legs_is_free(engine):
    drag(engine, "chair", (2.0, 2.5, 0.0))  # a leg on either side of where the fence ends, above it
    assert engine.pose("chair") == (2.0, 2.5, 0.0)
    drag(engine, "chair", (2.0, 1.0, 0.0))  # the fence is between its legs
    assert engine.pose("chair") == (2.0, 1.0, 0.0)


def test_what_is_low_goes_under_a_bridge(engine):
    drag(engine, "box", (-3.0, 0.0, 0.0))
    drag(engine, "burger", (-3.0, 0.4, 0.0))
    assert engine.pose("box") == (-3.0, 0.0, 0.0)


def test_it_is_at_rest_then_and_can_be_pushed(engine):
    engine.command("burger", 0.2, 0.0)
    engine.advance(1.0)
    drag(engine, "burger", (-1.0, 0.0, 0.0))
    drag(engine, "box", (-0.5, 0.0, 0.0))
    engine.advance(2.0)
    assert engine.pose("burger") == pytest.approx((-1.0, 0.0, 0.0), abs=0.02)  # it comes to a halt
    engine.command("burger", 0.2, 0.0)
    engine.advance(5.0)
    assert engine.pose("box")[0] > -0.4
