"""Fixed things come and go, and are named where they are in the way."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

from rosmini.sim.fixtures import Fixtures
from rosmini.sim.world import Box, Cylinder, Obstacle, World

WALLS = np.array([(2.0, -1.0, 2.0, 1.0)])


def test_obstacles_come_and_go_and_walls_stay():
    fixtures = Fixtures(WALLS, solid=False)
    fixtures.insert("box", 0.0, [(Box(1.0, 1.0), (0.0, 0.0, 0.0))])
    fixtures.insert("lamp", 1.0, [(Cylinder(0.1), (0.2, 0.0, 0.0))])
    assert fixtures.blocked((0.0, 0.0, 0.0), 0.1, 0.2) == "the obstacle 'box'"
    fixtures.remove("box")
    fixtures.remove("box")
    assert fixtures.blocked((0.0, 0.0, 0.0), 0.15, 0.2) is None, "under the lamp"
    assert fixtures.blocked((0.0, 0.0, 0.0), 0.15, 1.0) == "the obstacle 'lamp'"
    assert fixtures.blocked((1.9, 0.0, 0.0), 0.15, 0.2) == "the wall from (2.00, -1.00) to (2.00, 1.00)"


@pytest.mark.parametrize("pose", [(0.0, 0.0, 0.0), (0.3, -0.2, 1.0)])
def test_what_has_the_same_centre_or_is_the_same_is_in_the_way(pose):
    square = ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))
    for shape in (Box(1.0, 1.0), Box(0.2, 0.2), Box(4.0, 4.0), Cylinder(0.1), Cylinder(3.0)):
        world = World("w", (Obstacle("one", shape, pose),))
        assert world.blocked(pose, square) == "the obstacle 'one'"
        assert world.blocked(pose, 0.3) == "the obstacle 'one'"


def test_a_world_that_was_asked_can_be_pickled():
    world = World("w", (Obstacle("box", Box(1.0, 1.0)),))
    assert world.blocked((0.0, 0.0, 0.0), 0.1) is not None
    assert pickle.loads(pickle.dumps(world)).blocked((0.0, 0.0, 0.0), 0.1) == "the obstacle 'box'"
