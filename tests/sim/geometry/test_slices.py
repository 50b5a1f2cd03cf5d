"""Hulls, cuts through meshes, and plane regions taken apart."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.geometry import polygons
from rosmini.sim.geometry.slices import convex_hull, cut, loops, pieces, thinned, within

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


def test_an_outline_that_is_alone_stays_whole():
    ell = np.array([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)], dtype=float)
    (piece,) = pieces([ell[::-1]])
    assert polygons.area(piece) == 3
    assert len(pieces([ell, ell + (5, 0)])) == 2


def test_thinning_keeps_what_is_far_from_the_line():
    angles = np.linspace(0, 2 * math.pi, 400, endpoint=False)
    circle = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    thin = thinned(circle, 0.01)
    assert 12 <= len(thin) <= 40
    assert polygons.distances(circle, polygons.sides_of(thin)).max() <= 0.01 + 1e-12
    assert thinned(circle[:4], 1.0) is not None


@given(points.map(lambda cloud: cloud[:2]), st.tuples(number, number))
def test_a_side_passes_through_a_square_where_points_of_it_are_inside(ends, centre):
    side = np.array([[*ends[0], *ends[1]]])
    half = 0.5
    along = np.linspace(0, 1, 2001)[:, None]
    inside = (np.abs(ends[0] + along * (ends[1] - ends[0]) - centre) < half - 1e-9).all(axis=1).any()
    if (ends[0] == ends[1]).all():
        return
    if inside:
        assert within(np.array([centre]), half, side)[0]
    elif not (np.abs(ends[0] + along * (ends[1] - ends[0]) - centre) < half + 0.02).all(axis=1).any():
        assert not within(np.array([centre]), half, side)[0]
