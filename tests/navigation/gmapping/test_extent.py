"""How large a published map is: the original's sizes, and growth on the lattice."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.errors import RosminiError
from rosmini.navigation.gmapping.extent import Extent, first_extent, grown, known, published
from rosmini.navigation.gmapping.maps import SIDE
from rosmini.navigation.gmapping.slam import GridSlam, Settings


def test_sizes_that_real_maps_have():
    """The map of ROBOTIS's tutorial, from -10 to 10 m, has 384 x 384 cells; the default one 4000 x 4000."""
    assert first_extent(-10.0, -10.0, 10.0, 10.0, 0.05, pytest.fail) == Extent(-200, -200, 384, 384)
    assert first_extent(-100.0, -100.0, 100.0, 100.0, 0.05, pytest.fail) == Extent(-2000, -2000, 4000, 4000)
    assert first_extent(0.0, 0.0, 0.2, 0.2, 0.05, pytest.fail) == Extent(0, 0, 32, 32)


@pytest.mark.parametrize(
    ("bounds", "extent"),
    [
        ((5.0, 0.0, -5.0, 1.0), Extent(100, 0, SIDE, SIDE)),
        ((-10_000.0, -1.0, 10_000.0, 1.0), Extent(-200_000, -20, 400_000, SIDE)),
        ((-1e6, -1e6, 1e6, 1e6), Extent(-4_992, -4_992, 9_984, 9_984)),
        ((-1.0, 1e4, 1e6, 1e6), Extent(-20, 200_000, 9_984, 9_984)),
        ((-1e6, -1e6, -1e4, 1.0), Extent(-209_984, -9_984, 9_984, 9_984)),
    ],
)
def test_unusual_bounds(bounds, extent):
    """Bounds in the wrong order start small, as in the original; a map of too many cells is limited."""
    warned: list[str] = []
    assert first_extent(*bounds, 0.05, warned.append) == extent
    assert len(warned) == (bounds[0] != -10_000.0)


boxes = st.builds(Extent, *[st.integers(-3000, 3000)] * 2, *[st.integers(1, 3000)] * 2)


@given(boxes)
def test_growth_makes_room_in_blocks(seen):
    first = Extent(-200, -200, 384, 384)
    found = grown(first, seen, 0.05)
    for low, size, had, length, from_, count in (
        (found.column, found.width, first.column, first.width, seen.column, seen.width),
        (found.row, found.height, first.row, first.height, seen.row, seen.height),
    ):
        assert low <= min(from_, had)
        assert low + size >= max(from_ + count, had + length)
        assert (had - low) % SIDE == (size - length) % SIDE == 0
        assert low == had or from_ - low >= 200, "and 10 m more, where it grows"
        assert low + size == had + length or low + size - from_ - count >= 200
    assert grown(found, seen, 0.05) == found


def test_a_map_that_would_grow_too_large_is_an_error():
    slam = GridSlam(Settings(particles=1), random=np.random.default_rng(0))
    slam.process(np.array([3.0]), np.zeros(1), (0.0, 0.0, 0.0), 0.0)
    with pytest.raises(RosminiError, match="too large"):
        published(slam, Extent(10**7, 0, 4000, 4000), 0.25)


def test_a_published_map_keeps_its_cells_where_they_are():
    slam = GridSlam(Settings(particles=1), random=np.random.default_rng(0))
    slam.process(np.array([3.02]), np.zeros(1), (0.02, 0.02, 0.0), 0.0)
    shares, seen = known(slam, 0)
    assert shares.shape == (1, 61)
    for half in (1.0, 10.0):
        extent = first_extent(-half, -half, half, half, 0.05, pytest.fail)
        cells, after = published(slam, extent, 0.25)
        assert cells.shape == (after.height, after.width)
        assert (cells == 100).sum() == 1
        assert cells[0 - after.row, 60 - after.column] == 100
        assert (cells == 0).sum() == 60
        assert seen.column >= after.column
