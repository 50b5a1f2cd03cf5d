"""Polygons: inside, crossing, overlapping, against pixels and exact cases."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.geometry import polygons

SQUARE = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
ELL = np.array([(0.0, 0.0), (3.0, 0.0), (3.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0)])


def star(seed, corners, x=0.0, y=0.0):
    """A polygon around (x, y), seldom convex, never crossing itself."""
    rng = np.random.default_rng(seed)
    angles = (np.arange(corners) + rng.uniform(0.1, 0.9, corners)) * math.tau / corners
    return np.array([x, y]) + rng.uniform(0.3, 1.0, corners)[:, None] * np.stack([np.cos(angles), np.sin(angles)], 1)


stars = st.builds(star, st.integers(0, 10**6), st.integers(5, 9), st.floats(-1.5, 1.5), st.floats(-1.5, 1.5))


def test_area_has_the_sign_of_the_direction():
    assert polygons.area(SQUARE) == 1
    assert polygons.area(SQUARE[::-1]) == -1
    assert polygons.area(ELL) == 5


def test_inside_counts_crossings():
    hole = polygons.sides_of(SQUARE * 0.5 + 0.25)
    sides = np.vstack([polygons.sides_of(SQUARE), hole])
    points = np.array([(0.1, 0.5), (0.5, 0.5), (0.9, 0.9), (1.1, 0.5), (-0.1, -0.1)])
    assert polygons.inside(points, sides).tolist() == [True, False, True, False, False]
    assert polygons.inside(points, np.empty((0, 4))).tolist() == [False] * 5


def test_distances_are_those_from_the_nearest_side():
    sides = np.array([(0.0, 0.0, 2.0, 0.0), (5.0, 5.0, 5.0, 5.0)])
    points = np.array([(1.0, 3.0), (-3.0, 4.0), (5.0, 6.0)])
    assert polygons.distances(points, sides) == pytest.approx([3, 5, 1])
    assert polygons.distances_to_sides(points[:1], sides)[0] == pytest.approx([3, math.sqrt(20)])
    assert np.isinf(polygons.distances(points, np.empty((0, 4)))).all()


@pytest.mark.parametrize(
    ("corners", "expected"),
    [
        (SQUARE, None),
        (ELL, None),
        ([(0, 0), (1, 1), (1, 0), (0, 1)], (0, 2)),  # a bow tie
        ([(0, 0), (2, 0), (1, 0)], (0, 1)),  # back along itself
        ([(0, 0), (1, 0), (1, 0), (0, 1)], (0, 1)),  # a corner twice
        ([(0, 0), (4, 0), (4, 2), (2, 0), (0, 2)], (0, 2)),  # a corner on a side
        ([(0, 0), (4, 0), (4, 1), (3, 0), (1, 0), (0, 1)], (0, 2)),  # along a side
    ],
)
def test_crossing_sides_are_found(corners, expected):
    assert polygons.crossing_sides(np.array(corners, dtype=float)) == expected


@given(stars)
def test_a_star_does_not_cross_itself(outline):
    assert polygons.crossing_sides(outline) is None
    assert polygons.area(outline) > 0


@pytest.mark.parametrize("corners", [4, 5, 8, 13])
def test_a_convex_polygon_crosses_itself_once_two_corners_are_exchanged(corners):
    angles = np.arange(corners) * math.tau / corners + 0.1
    outline = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    assert polygons.crossing_sides(outline) is None
    outline[[1, 2]] = outline[[2, 1]]
    assert polygons.crossing_sides(outline) == (0, 2)
