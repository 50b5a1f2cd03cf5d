"""Maps that particles share: what a scan writes, who owns which patch, and that growth moves nothing."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.navigation.gmapping.maps import EMPTY_PATCH, PATCH_BYTES, SIDE, Scan, SharedMaps, register

AHEAD = np.zeros(1)


def write(maps, pose, ranges, bearings=None, usable=10.0):
    count = len(maps.tables)
    bearings = np.zeros(len(ranges)) if bearings is None else np.asarray(bearings, dtype=float)
    maps.register(np.tile(np.array(pose, dtype=float), (count, 1)), np.asarray(ranges, dtype=float), bearings, usable)


def at(maps, particle, x, y):
    cells, (left, low) = maps.occupancy(particle)
    return cells[math.floor((y - low) / maps.resolution), math.floor((x - left) / maps.resolution)]


def test_a_beam_frees_its_way_and_fills_its_end():
    maps = SharedMaps(1, 0.1)
    write(maps, (0.05, 0.05, 0.0), [1.0])
    cells, (left, low) = maps.occupancy(0)
    row, column = round((0.0 - low) / 0.1), round((0.0 - left) / 0.1)
    assert cells[row, column : column + 12].tolist() == [0.0] * 10 + [1.0, -1.0]
    assert (cells >= 0).sum() == 11
    write(maps, (0.05, 0.05, 0.0), [2.0])
    assert at(maps, 0, 1.05, 0.05) == 0.5, "one end of two visits"


def test_a_beam_beyond_what_is_usable_only_frees():
    maps = SharedMaps(1, 0.1)
    write(maps, (0.05, 0.05, 0.0), [5.0], usable=1.0)
    cells, _ = maps.occupancy(0)
    assert cells.max() == 0.0
    assert (cells == 0.0).sum() == 10, "and not its last cell, which may be the wall"


def test_a_cell_has_the_mean_of_the_ends_in_it():
    maps = SharedMaps(1, 0.1)
    ends = [1.01, 1.03, 1.05]
    for end in ends:
        write(maps, (0.0, 0.05, 0.0), [end])
    patch = maps.tables[0][tuple(np.argwhere(maps.tables[0] != EMPTY_PATCH)[0])]
    full = np.argwhere(maps.hits > 0)
    assert len(full) == 1
    found = maps.means[tuple(full[0])]
    assert found == pytest.approx([np.mean(ends), 0.05])
    assert maps.hits[tuple(full[0])] == 3
    assert patch >= 0


@given(st.integers(0, 2**32 - 1))
def test_every_beam_ends_where_it_points(seed):
    """The end of each beam is full, its start is free, and machine code does as Python does."""
    rng = np.random.default_rng(seed)
    maps = SharedMaps(1, 0.05)
    x, y, heading = rng.uniform(-3, 3, 3)
    ranges, bearings = rng.uniform(0.2, 4.0, 5), rng.uniform(-math.pi, math.pi, 5)
    write(maps, (x, y, heading), ranges, bearings)
    for length, bearing in zip(ranges, bearings, strict=True):
        end = x + length * math.cos(heading + bearing), y + length * math.sin(heading + bearing)
        assert at(maps, 0, *end) > 0
    other = SharedMaps(1, 0.05)
    other.low, other.tables = maps.low, np.full_like(maps.tables, EMPTY_PATCH)
    other._add_patches(len(maps.hits) - 1)
    scan = Scan(ranges, bearings, 10.0, np.zeros(other.tables.shape[1:], dtype=np.uint8))
    assert register(other.pool, scan, np.array([(x, y, heading)]), np.arange(1, len(other.hits)), 0) == 1
    assert (other.hits == maps.hits).all()
    assert (other.visits == maps.visits).all()
    assert np.allclose(other.means, maps.means, rtol=0.0, atol=1e-12)
    assert (other.full == maps.full).all()
    columns = (other.full[:, :, None] >> np.arange(SIDE)) & 1
    assert (columns == (other.hits > 0.1 * other.visits)).all(), "a bit for each full cell"


def test_a_map_that_is_chosen_twice_is_not_copied_until_it_changes():
    maps = SharedMaps(3, 0.1)
    maps.register(np.array([(0.05, 0.05, 0.0), (0.05, 5.05, 0.0), (0.05, 9.05, 0.0)]), np.array([1.0]), AHEAD, 10.0)
    before = maps.occupancy(1)[0].copy()
    maps.choose(np.array([1, 1, 1]))
    one = maps.bytes_used
    assert one < 3 * PATCH_BYTES
    assert (maps.tables[0] == maps.tables[2]).all()
    maps.register(np.array([(0.05, 5.05, 0.0), (0.05, 5.05, 0.5), (0.05, 5.05, 1.0)]), np.array([2.0]), AHEAD, 10.0)
    assert maps.bytes_used > one
    shown = [maps.occupancy(particle)[0] for particle in range(3)]
    assert not np.array_equal(shown[0], shown[1])
    assert not np.array_equal(shown[1], shown[2])
    for cells in shown:
        assert at(maps, 0, 1.05, 5.05) >= 0
        assert (cells >= 0).sum() > (before >= 0).sum()


def test_memory_of_maps_that_died_is_used_again():
    maps = SharedMaps(4, 0.1)
    for step in range(30):
        poses = np.array([(0.05, 0.05, 0.1 * particle + 0.01 * step) for particle in range(4)])
        maps.register(poses, np.array([3.0]), AHEAD, 10.0)
        maps.choose(np.array([0, 0, 1, 1]))
    assert (maps.owners > 0).sum() <= 4 * maps.tables[0].size
    assert len(maps.hits) <= 64 + 2 * 4 * maps.tables[0].size


def test_a_map_that_grows_keeps_its_cells():
    maps = SharedMaps(2, 0.05)
    write(maps, (0.02, 0.02, 0.3), [1.0, 2.0], [0.0, 2.0])
    before, (left, low) = maps.occupancy(0)
    write(maps, (-7.0, -9.0, 0.0), [1.0])
    write(maps, (8.0, 9.0, 0.0), [1.0])
    after, (new_left, new_low) = maps.occupancy(0)
    column, row = round((left - new_left) / 0.05), round((low - new_low) / 0.05)
    assert column > 0
    assert row > 0
    part = after[row : row + before.shape[0], column : column + before.shape[1]]
    assert (part[before >= 0] == before[before >= 0]).all()
    assert maps.low[0] % SIDE == maps.low[1] % SIDE == 0
