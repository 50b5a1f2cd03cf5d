"""What the navigation benchmark measures against: its errands, its shortest paths, and its intervals."""

import math
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from rosmini_bench.nav_goals import APART, CLEARANCE, DISC, Terrain, errands, unmapped, wilson

from rosmini.core.errors import RosminiError
from rosmini.core.maps import GridMap
from rosmini.sim.motion import Door
from rosmini.sim.world import Box, Obstacle, World
from rosmini.sim.worlds.world_map import to_map


def drawn(rows):
    """A map of cells of half a metre; the first row is the top."""
    cells = np.array([[100 if sign == "#" else 0 for sign in row] for row in rows[::-1]], dtype=np.int8)
    fine = np.kron(cells, np.ones((10, 10), dtype=np.int8))
    return GridMap(fine, 0.05, (0.0, 0.0, 0.0), Path("drawn.yaml"))


ROOM = drawn(["##########", "#........#", "#........#", "#..####..#", "#..#######", "#..#######", "##########"])


def test_a_shortest_path_goes_around_a_corner_at_the_clearance():
    terrain = Terrain(ROOM)
    path = terrain.shortest(terrain.cell(1.0, 0.8), terrain.cell(4.0, 2.5))
    assert path is not None
    length = sum(math.dist(a, b) for a, b in pairwise(path))
    # Straight to the circle of the clearance around the corner (1.5, 2.0), along it, and straight on.
    (ax, ay), (bx, by) = path[0], path[-1]
    a, b = math.dist((ax, ay), (1.5, 2.0)), math.dist((bx, by), (1.5, 2.0))
    angle = math.tau - math.acos(((ax - 1.5) * (bx - 1.5) + (ay - 2.0) * (by - 2.0)) / (a * b))
    arc = angle - math.acos(CLEARANCE / a) - math.acos(CLEARANCE / b)
    best = math.sqrt(a * a - CLEARANCE**2) + math.sqrt(b * b - CLEARANCE**2) + CLEARANCE * arc
    assert best - 0.03 <= length <= 1.03 * best


def test_errands_keep_to_what_a_disc_reaches_and_are_the_same_for_the_same_seed():
    first, again, other = (list(errands(ROOM, (1.0, 1.0), 8, seed)) for seed in (1, 1, 2))
    assert first == again != other
    terrain = Terrain(ROOM)
    for errand in first:
        for pose in (errand.start, errand.goal):
            assert terrain.distance[terrain.cell(*pose[:2])] >= DISC
        straight = math.dist(errand.start[:2], errand.goal[:2])
        assert straight >= APART
        assert errand.shortest >= straight - 1e-9


def test_nobody_is_sent_to_where_a_crate_stands_or_a_door_swings():
    walls = (
        Obstacle("west", Box(0.2, 4.0), (-3.0, 0.0, 0.0)),
        Obstacle("east", Box(0.2, 4.0), (3.0, 0.0, 0.0)),
        Obstacle("south", Box(6.0, 0.2), (0.0, -2.0, 0.0)),
        Obstacle("north", Box(6.0, 0.2), (0.0, 2.0, 0.0)),
    )
    crate = Obstacle("crate", Box(0.4, 0.4), (2.0, -1.0, 0.0), mass=2.0)
    leaf = Obstacle("door", Box(1.0, 0.05), (-1.5, -0.5, 0.0), motion=Door(hinge=(-0.5, 0.0)))
    world = World("hall", (*walls, crate, leaf))
    taken, grid = unmapped(world), to_map(world)
    area = taken.sum() * grid.resolution**2
    assert area == pytest.approx(0.4**2 + math.pi / 4, rel=0.15)
    for errand in errands(grid, (0.0, 0.0), 30, 1, taken):
        for x, y, _ in (errand.start, errand.goal):
            assert max(abs(x - 2.0), abs(y + 1.0)) > 0.2 + DISC - 0.05
            assert not (x > -2.0 and y > -0.5 and math.hypot(x + 2.0, y + 0.5) < 1.0)


def test_a_room_that_is_too_small_is_named():
    with pytest.raises(RosminiError, match=r"drawn.yaml.* has no two places 3.0 m apart"):
        list(errands(drawn(["####", "#..#", "####"]), (0.75, 0.75), 1, 0))
    with pytest.raises(RosminiError, match=r"has no room at \(0.1, 0.1\)"):
        list(errands(ROOM, (0.1, 0.1), 1, 0))


@pytest.mark.parametrize(
    ("successes", "count", "low", "high"),
    [(0, 10, 0.0, 0.2775), (5, 10, 0.2366, 0.7634), (81, 263, 0.2553, 0.3662), (200, 200, 0.9812, 1.0)],
)
def test_the_interval_is_wilsons(successes, count, low, high):
    """The third is Newcombe's (1998) example: 81 of 263."""
    assert wilson(successes, count) == pytest.approx((low, high), abs=1e-4)
