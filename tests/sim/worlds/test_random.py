"""Worlds by chance: the same for the same seed, connected, and free where robots start."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.sim.world import World, WorldError
from rosmini.sim.worlds import random_world, to_map

CELL = 0.05
RADIUS = 0.3
"""Of a robot that gets everywhere: a little less than promised, since cells are coarse."""


def described(world):
    return (world.name, world.obstacles, world.starts)


def test_the_same_seed_makes_the_same_world_and_another_one_another():
    assert described(random_world(3)) == described(random_world(3))
    assert described(random_world(3)) != described(random_world(4))


def regions(free):
    """How many cells each connected region of free cells has."""
    left = free.copy()
    sizes = []
    while left.any():
        todo = [tuple(np.argwhere(left)[0])]
        count = 0
        while todo:
            row, column = todo.pop()
            if left[row, column]:
                left[row, column] = False
                count += 1
                todo += [(row + 1, column), (row - 1, column), (row, column + 1), (row, column - 1)]
        sizes.append(count)
    return sizes


@given(st.integers(0, 2**32), st.tuples(st.floats(5, 14), st.floats(5, 14)), st.integers(1, 8), st.integers(0, 15))
def test_a_robot_gets_from_every_start_to_everywhere(seed, size, rooms, obstacles):
    size = (round(size[0], 2), round(size[1], 2))
    world = random_world(seed, size=size, rooms=rooms, obstacles=obstacles, movable=1, starts=2)
    for start in world.starts:
        assert world.blocked(start, 0.35) is None
    grid = to_map(World("w", world.obstacles, starts=world.starts), CELL)
    rows, columns = np.indices(grid.occupied.shape)
    room = (np.abs((columns + 0.5) * CELL + grid.origin[0]) < size[0] / 2) & (
        np.abs((rows + 0.5) * CELL + grid.origin[1]) < size[1] / 2
    )
    reach = int(RADIUS / CELL)
    near = grid.occupied.copy()
    for up in range(-reach, reach + 1):
        for along in range(-reach, reach + 1):
            if math.hypot(up, along) <= reach:
                near |= np.roll(grid.occupied, (up, along), axis=(0, 1))
    free = ~near & room
    assert len([count for count in regions(free) if count > 4]) == 1, "one region but for crumbs"
    for x, y, _ in world.starts:
        assert free[int((y - grid.origin[1]) / CELL), int((x - grid.origin[0]) / CELL)]


def test_there_is_what_was_asked_for():
    world = random_world(5, size=(14, 12), rooms=5, obstacles=8, movable=2, starts=4)
    things = [each for each in world.obstacles if each.colour != "wall"]
    assert sum(each.movable for each in things) == 2
    assert len(things) == 10
    assert len(world.starts) == 4


@pytest.mark.parametrize(
    ("arguments", "part"),
    [
        ({"size": (1, 5)}, "size"),
        ({"size": (math.nan, 5)}, "size"),
        ({"seed": -1}, "seed is -1"),
        ({"seed": "one"}, "seed is 'one'; it must be a whole number, 0 or more"),
        ({"rooms": 0}, "rooms is 0"),
        ({"obstacles": -1}, "obstacles is -1"),
        ({"starts": 1.5}, "starts is 1.5"),
        ({"rooms": 10**9}, "rooms is 1000000000; it must be 10000 or less"),
        ({"obstacles": 10**9}, "obstacles is 1000000000"),
        ({"movable": 10**9}, "movable is 1000000000"),
        ({"starts": 10**9}, "starts is 1000000000"),
        ({"size": (1e12, 8.0)}, "size is"),
        ({"size": (2, 2), "rooms": 1, "starts": 50}, "no room for 50 starts"),
    ],
)
def test_what_makes_no_sense_is_refused(arguments, part):
    with pytest.raises(WorldError, match=part):
        random_world(**{"seed": 1, **arguments})
