"""What overlaps: polygons, segments and discs; labels; with pymunk and without."""

import numpy as np
import pytest
from hypothesis import assume, given

from rosmini.core.geometry import polygons
from rosmini.sim.geometry.overlaps import Outline, PlainOverlaps, PymunkOverlaps, no_outlines

from ...core.geometry.test_polygons import ELL, SQUARE, stars

KINDS = [PymunkOverlaps, PlainOverlaps]


def found(insert, probe):
    """Whether two outlines overlap, which must not depend on the kind."""
    answers = set()
    for kind in KINDS:
        there = kind()
        there.insert("a", insert)
        answers.add(there.find(probe) == {"a"})
    assert len(answers) == 1
    return answers.pop()


def overlap(a, b):
    return found(Outline(a), Outline(b))


def overlaps_disc(outline, x, y, radius):
    return found(Outline(np.array([[x, y]]), radius), Outline(outline))


@given(stars, stars)
def test_polygons_overlap_if_they_have_a_point_in_common(a, b):
    grid = np.stack(np.meshgrid(np.linspace(-2.5, 2.5, 101), np.linspace(-2.5, 2.5, 101)), -1).reshape(-1, 2)
    common = polygons.inside(grid, polygons.sides_of(a)) & polygons.inside(grid, polygons.sides_of(b))
    is_overlap = overlap(a, b)
    assert is_overlap == overlap(b, a)
    if common.any():
        assert is_overlap
    elif is_overlap:  # then less than what lies between the points of the grid
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


@pytest.mark.parametrize("kind", KINDS)
def test_a_removed_label_is_not_found(kind):
    there = kind()
    for label, x in (("left", 0.0), ("right", 0.8), ("left", 0.4)):
        there.insert(label, Outline(SQUARE + (x, 0.0)))
    assert there.find(Outline(SQUARE)) == {"left", "right"}
    there.remove("left")
    there.remove("nothing")
    assert there.find(Outline(SQUARE)) == {"right"}


def test_a_wall_crosses_a_robot_from_any_side():
    wall = Outline(np.array([[0.0, 0.5], [2.0, 0.5]]))
    assert found(wall, Outline(SQUARE))
    assert found(wall, Outline(np.array([[1.0, 0.6]]), 0.2))
    assert not found(wall, Outline(SQUARE + (2.0, 0.0)))
    assert not found(wall, Outline(np.array([[1.0, 0.8]]), 0.2))


def test_without_pymunk_the_engine_finds_them(monkeypatch):
    monkeypatch.setattr("rosmini.sim.geometry.overlaps._pymunk", lambda: None)
    assert isinstance(no_outlines(), PlainOverlaps)
