"""Maps of worlds, compared with what the worlds themselves say of each cell."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assets.generate.worlds.map_file import write_map
from rosmini.core.maps import load_map
from rosmini.sim.world import Box, Compound, Cylinder, Obstacle, Polygon, World, WorldError
from rosmini.sim.worlds.world_map import to_map

sizes = st.floats(0.05, 1.5)
places = st.floats(-2, 2)
shapes = st.one_of(
    st.builds(Box, sizes, sizes),
    st.builds(Cylinder, sizes),
    st.just(Polygon(((0, 0), (2, 0), (2, 0.5), (0.5, 0.5), (0.5, 2), (0, 2)))),
    st.just(Compound(((Box(1, 0.2), (0, 0, 0.4)), (Cylinder(0.3), (0.6, 0, 0))))),
)
obstacles = st.lists(st.tuples(shapes, st.tuples(places, places, st.floats(-3, 3))), min_size=1, max_size=3)


@pytest.mark.nightly
@given(obstacles, st.lists(st.tuples(places, places, places, places), max_size=2), st.sampled_from([0.17, 0.25]))
def test_a_cell_is_occupied_if_the_world_says_so_of_a_square_as_large(things, walls, resolution):
    walls = [wall for wall in walls if math.dist(wall[:2], wall[2:]) > 1e-3]
    world = World("w", tuple(Obstacle(f"{i}", shape, pose) for i, (shape, pose) in enumerate(things)), walls)
    grid = to_map(world, resolution)
    half = resolution / 2
    square = ((-half, -half), (half, -half), (half, half), (-half, half))
    for row, column in np.argwhere(np.ones_like(grid.occupied)).tolist():
        x, y = grid.origin[0] + (column + 0.5) * resolution, grid.origin[1] + (row + 0.5) * resolution
        if grid.occupied[row, column] != (world.blocked((x, y, 0.0), square) is not None):
            # only where it hangs on less than what counts as touching
            shrunk, grown = (tuple((a * f, b * f) for a, b in square) for f in (1 - 1e-4, 1 + 1e-4))
            assert world.blocked((x, y, 0.0), shrunk) is None
            assert world.blocked((x, y, 0.0), grown) is not None


def test_only_what_is_at_the_height_of_the_laser_and_stays_there_is_in_the_map():
    world = World(
        "w",
        (
            Obstacle("low", Box(0.5, 0.5), (-3, 0, 0), 0.1),
            Obstacle("lamp", Box(0.5, 0.5), (-2, 0, 0), 2.0, bottom=1.0),
            Obstacle("crate", Box(0.5, 0.5), (-1, 0, 0), mass=1.0),
            Obstacle("pillar", Box(0.5, 0.5), (2, 0, 0)),
        ),
    )
    grid = to_map(world, 0.1)
    assert grid.occupied.sum() == 5 * 6 or grid.occupied.sum() == 6 * 6
    assert to_map(world, 0.1, height=1.5).occupied.sum() == grid.occupied.sum()


def test_what_no_start_leads_to_is_unknown():
    walls = [(-1, -1, 1, -1), (1, -1, 1, 1), (1, 1, -1, 1), (-1, 1, -1, -1)]
    world = World("w", (Obstacle("far", Cylinder(0.1), (3, 3, 0)),), walls)
    grid = to_map(world, 0.1)
    row, column = (int((0 - low) / 0.1) for low in grid.origin[1::-1])
    assert grid.occupancy[row, column] == 0
    assert grid.occupancy[0, 0] == -1
    outside = to_map(World("w", world.obstacles, walls, starts=((2, 2, 0),)), 0.1)
    assert outside.occupancy[row, column] == -1
    assert outside.occupancy[0, 0] == 0
    solid = to_map(World("w", walls=walls, starts=((1.2, 0, 0),), solid=True), 0.1)
    assert solid.occupancy[row, column] == 100


def test_a_map_that_is_written_is_read_as_it_was(tmp_path):
    grid = to_map(World("w", (Obstacle("p", Cylinder(0.5)),), starts=((1, 1, 0),)), 0.05)
    write_map(grid, tmp_path / "w.yaml")
    stored = load_map(tmp_path / "w.yaml")
    assert (stored.occupancy == grid.occupancy).all()
    assert (stored.resolution, stored.origin) == (0.05, pytest.approx(grid.origin))


def test_impossible_maps_are_refused():
    for resolution in (0, -1, math.nan, math.inf):
        with pytest.raises(WorldError, match="resolution"):
            to_map(World("w"), resolution)
    with pytest.raises(WorldError, match="too many"):
        to_map(World("w"), 1e-5)
