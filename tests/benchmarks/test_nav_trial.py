"""Drives of navigation begin where the robot has room, and say why one did not begin."""

import math

import pytest
from rosmini_bench import nav_trial
from rosmini_bench.nav_goals import DISC, Errand, Terrain
from rosmini_bench.nav_trial import Setup, drawn, place

from rosmini.core.errors import RosminiError
from rosmini.sim.models import model


@pytest.mark.parametrize("name", ["burger", "waffle"])
def test_errands_begin_and_end_where_the_whole_robot_has_room(name):
    """With seed 7 a waffle was to begin with a corner in the wall of the maze: goal 5, at (6.675, 1.775)."""
    terrain = Terrain(place("maze")[0])
    for errand in drawn(Setup("maze", model=name, seed=7), 8):
        for pose in (errand.start, errand.goal):
            assert terrain.distance[terrain.cell(*pose[:2])] >= max(DISC, model(name).reach)


def test_a_simulator_that_does_not_start_says_why():
    inside_a_wall = Errand(5, (6.675, 1.775, 2.21), (8.6, 6.1, 0.0), 8.5, math.pi)
    with pytest.raises(RosminiError, match=r"goal 5 of maze, waffle.*no robot can be placed at"):
        nav_trial.run(Setup("maze", model="waffle"), inside_a_wall)


def test_two_studies_side_by_side_do_not_write_one_file():
    """One that read its map while the other wrote it lost its robot at once: goal 152 of the maze, seed 23."""
    assert place.__wrapped__("maze")[1] != place.__wrapped__("maze")[1]
