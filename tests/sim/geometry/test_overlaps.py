"""What overlaps: polygons, segments and discs; labels; and what is said without pymunk."""

import sys

import numpy as np
import pytest
from hypothesis import assume, given

from rosmini.core.errors import RosminiError
from rosmini.core.geometry import polygons
from rosmini.sim.geometry import overlaps
from rosmini.sim.geometry.overlaps import Outline, Overlaps

from ...core.geometry.test_polygons import ELL, SQUARE, stars


def overlap(a, b):
    there = Overlaps()
    there.insert("a", Outline(a))
    return there.find(Outline(b)) == {"a"}


def overlaps_disc(outline, x, y, radius):
    there = Overlaps()
    there.insert("disc", Outline(np.array([[x, y]]), radius))
    return bool(there.find(Outline(outline)))


@given(stars, stars)
def test_polygons_overlap_if_they_have_a_point_in_common(a, b):
    grid = np.stack(np.meshgrid(np.linspace(-2.5, 2.5, 101), np.linspace(-2.5, 2.5, 101)), -1).reshape(-1, 2)
    common = polygons.inside(grid, polygons.sides_of(a)) & polygons.inside(grid, polygons.sides_of(b))
    found = overlap(a, b)
    assert found == overlap(b, a)
    if common.any():
        assert found
    elif found:  # then less than what lies between the points of the grid
        gap = polygons.distances(a, polygons.sides_of(b)).min()
        other = polygons.distances(b, polygons.sides_of(a)).min()
        assume(min(gap, other) > 0.1)
        pytest.fail("they overlap, but no point of the grid is in both")


def test_touching_alike_within_and_around():
    assert not overlap(SQUARE, SQUARE + (1, 0))
    assert not overlap(SQUARE, SQUARE + (1, 1))
    assert not overlap(SQUARE, SQUARE + (1 - 1e-7, 0.3))
    assert overlap(SQUARE, SQUARE + (1 - 1e-5, 0.3))
    assert overlap(SQUARE, SQUARE)
    assert overlap(SQUARE, SQUARE * 3 - 1)
    assert overlap(SQUARE * 3 - 1, SQUARE)
    assert not overlap(SQUARE + (1, 1), ELL)  # in the corner of the L
    assert overlap(SQUARE * 2, ELL)


def test_discs_overlap_polygons():
    assert overlaps_disc(SQUARE, 0.5, 0.5, 0.1)
    assert overlaps_disc(SQUARE, 1.5, 0.5, 0.51)
    assert not overlaps_disc(SQUARE, 1.5, 0.5, 0.5)
    assert not overlaps_disc(SQUARE, 2, 2, 1.41)
    assert overlaps_disc(SQUARE, 2, 2, 1.42)
    assert not overlaps_disc(ELL, 2, 2, 1.0)


def test_without_pymunk_the_error_says_what_to_do(monkeypatch):
    overlaps._pymunk.cache_clear()
    monkeypatch.setitem(sys.modules, "pymunk", None)
    with pytest.raises(RosminiError, match="Windows on ARM"):
        Overlaps()
    monkeypatch.undo()
    assert Overlaps().find(Outline(SQUARE)) == set()
