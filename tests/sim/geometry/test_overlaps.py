"""What overlaps: polygons, segments and discs; labels; and what is said without pymunk."""

from __future__ import annotations

import sys

import numpy as np
import pytest
from hypothesis import assume, given

from rosmini.core.errors import RosminiError
from rosmini.core.geometry import polygons
from rosmini.sim.geometry import overlaps
from rosmini.sim.geometry.overlaps import Outline, Overlaps

from ...core.geometry.test_polygons import ELL, SQUARE, stars


def overlap(a: np.ndarray, b: np.ndarray) -> bool:
    there = Overlaps()
    there.insert("a", Outline(a))
    return there.find(Outline(b)) == {"a"}


def overlaps_disc(outline: np.ndarray, x: float, y: float, radius: float) -> bool:
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


def test_a_segment_overlaps_what_a_part_of_it_is_inside_of():
    segments = [
        (-1, -1, 2, 2),
        (0, 0, 1, 1),
        (0, 0, 1, 0),
        (-1, 0, 2, 0),
        (1, 1, 2, 2),
        (0.4, 0.4, 0.6, 0.6),
        (-1, 2, 2, 2),
    ]
    found = [overlap(np.array(each, dtype=float).reshape(2, 2), SQUARE) for each in segments]
    assert found == [True, True, False, False, False, True, False]


def test_discs_overlap_polygons():
    assert overlaps_disc(SQUARE, 0.5, 0.5, 0.1)
    assert overlaps_disc(SQUARE, 1.5, 0.5, 0.51)
    assert not overlaps_disc(SQUARE, 1.5, 0.5, 0.5)
    assert not overlaps_disc(SQUARE, 2, 2, 1.41)
    assert overlaps_disc(SQUARE, 2, 2, 1.42)
    assert not overlaps_disc(ELL, 2, 2, 1.0)


def test_labels_may_have_several_outlines_and_go_with_all_of_them():
    there = Overlaps()
    for x in (0.0, 3.0):
        there.insert("two", Outline(SQUARE + (x, 0)))
    there.insert("one", Outline(SQUARE + (0.5, 0.5)))
    assert there.find(Outline(SQUARE)) == {"one", "two"}
    assert there.find(Outline(SQUARE + (3.1, 0.1))) == {"two"}
    there.remove("two")
    there.remove("nobody")
    assert there.find(Outline(SQUARE)) == {"one"}
    assert there.find(Outline(SQUARE + (3.1, 0.1))) == set()


def test_without_pymunk_the_error_says_what_to_do(monkeypatch):
    overlaps._pymunk.cache_clear()
    monkeypatch.setitem(sys.modules, "pymunk", None)
    with pytest.raises(RosminiError, match="Windows on ARM"):
        Overlaps()
    monkeypatch.undo()
    assert Overlaps().find(Outline(SQUARE)) == set()
