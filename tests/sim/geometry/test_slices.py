"""Hulls, cuts through meshes, and plane regions taken apart."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.geometry import polygons
from rosmini.sim.geometry.slices import convex_hull, cut, loops, pieces

number = st.integers(-40, 40).map(lambda v: v / 8)
points = st.lists(st.tuples(number, number), min_size=3, max_size=30).map(np.array)


@given(points)
def test_a_hull_is_convex_and_holds_all_points(cloud):
    hull = convex_hull(cloud)
    if len(hull) < 3:
        assert len(np.unique(cloud, axis=0)) < 3 or np.linalg.matrix_rank(cloud - cloud[0], tol=1e-9) < 2
        return
    for begin, end in zip(hull, np.roll(hull, -1, axis=0), strict=True):
        way = end - begin
        sides = way[0] * (cloud[:, 1] - begin[1]) - way[1] * (cloud[:, 0] - begin[0])
        assert (sides >= -1e-9).all()
    assert {tuple(corner) for corner in hull.tolist()} <= {tuple(place) for place in cloud.tolist()}


def test_a_cut_through_a_tetrahedron_is_a_triangle():
    a, b, c, d = np.array([(0, 0, 0), (4, 0, 0), (0, 4, 0), (0, 0, 4)], dtype=float)
    triangles = np.array([(a, c, b), (a, b, d), (b, c, d), (c, a, d)])
    (outline,) = loops(cut(triangles, 1.0))
    assert polygons.area(outline) == pytest.approx(4.5)
    assert len(cut(triangles, 5.0)) == len(cut(triangles, -1.0)) == 0
    assert len(cut(triangles, 0.0)) == 0, "what lies in the plane counts as above it"
    assert loops(cut(triangles[1:], 1.0)) is not None
    assert loops(cut(triangles[2:], 1.0)) is None, "two sides are missing"


squares = st.tuples(number, number, st.integers(1, 20).map(lambda v: v / 4)).map(
    lambda s: np.array(
        [(s[0] - s[2], s[1] - s[2]), (s[0] + s[2], s[1] - s[2]), (s[0] + s[2], s[1] + s[2]), (s[0] - s[2], s[1] + s[2])]
    )
)


def turned(outline, angle):
    c, s = math.cos(angle), math.sin(angle)
    return outline @ np.array([[c, s], [-s, c]])


@given(
    st.lists(st.tuples(squares, st.integers(0, 300).map(lambda v: v / 100)), min_size=1, max_size=3),
    st.integers(0, 2**32 - 1),
)
def test_pieces_cover_what_is_inside_by_the_even_odd_rule(drawn, seed):
    outlines = [turned(square, angle) for square, angle in drawn]
    found = pieces(outlines)
    sides = np.vstack([polygons.sides_of(outline) for outline in outlines])
    low, high = sides.reshape(-1, 2).min(axis=0), sides.reshape(-1, 2).max(axis=0)
    places = np.random.default_rng(seed).uniform(low, high, (200, 2))
    places = places[polygons.distances(places, sides) > 1e-3]
    cover = np.zeros(len(places), dtype=int)
    for piece in found:
        assert polygons.area(piece) > 0
        own = polygons.sides_of(piece)
        near = polygons.distances(places, own) < 1e-6  # between two pieces
        cover += polygons.inside(places, own) & ~near
        places, cover = places[~near], cover[~near]
    assert (cover == polygons.inside(places, sides)).all()
