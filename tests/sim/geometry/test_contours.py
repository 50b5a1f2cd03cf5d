"""Outlines of occupied cells: what is inside stays inside, what is apart stays apart, and the sides are few."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

from rosmini.core.geometry.errors import GeometryError
from rosmini.sim.geometry.contours import edge_loops, outlines, trace

images = arrays(bool, array_shapes(min_dims=2, max_dims=2, min_side=1, max_side=12))
tolerances = st.sampled_from([0.0, 0.2, 0.36, 0.45, 0.49, 0.4999])


def sides(loops):
    return np.vstack([np.hstack([loop, np.roll(loop, -1, axis=0)]) for loop in loops] or [np.empty((0, 4))])


def winding(point, loop):
    """How often a loop goes around a point: the sum of the angles under which its sides are seen."""
    seen = loop - point
    following = np.roll(seen, -1, axis=0)
    cross = seen[:, 0] * following[:, 1] - seen[:, 1] * following[:, 0]
    return round(np.arctan2(cross, (seen * following).sum(axis=1)).sum() / math.tau)


def inside(point, segments):
    """The even-odd rule, with a ray that meets no corner: corners are at multiples of a half."""
    (x, y), slope = point, 0.1234567
    x1, y1, x2, y2 = segments.T
    below1, below2 = y1 - y < slope * (x1 - x), y2 - y < slope * (x2 - x)
    a, b = y1 - y - slope * (x1 - x), y2 - y - slope * (x2 - x)
    crossing = below1 != below2
    t = a[crossing] / (a - b)[crossing]
    return np.count_nonzero((x1 + 0.0)[crossing] + t * (x2 - x1)[crossing] > x) % 2 == 1


def distances(points, segments):
    """How far each point is from the nearest segment."""
    start, v = segments[:, :2], segments[:, 2:] - segments[:, :2]
    d = points[:, None] - start
    t = np.clip((d * v).sum(axis=2) / np.maximum((v * v).sum(axis=1), 1e-300), 0, 1)
    return np.linalg.norm(d - t[..., None] * v, axis=2).min(axis=1)


def along(segments, each=16):
    t = np.linspace(0, 1, each)[:, None, None]
    return (segments[:, :2] * (1 - t) + segments[:, 2:] * t).reshape(-1, 2)


def crosses(segments, a, b):
    """Whether the way from `a` to `b` meets one of the segments."""

    def side(p, q, r):
        return (q[..., 0] - p[..., 0]) * (r[..., 1] - p[..., 1]) - (q[..., 1] - p[..., 1]) * (r[..., 0] - p[..., 0])

    p, q = segments[:, :2], segments[:, 2:]
    return bool(((side(p, q, a) * side(p, q, b) <= 0) & (side(a, b, p) * side(a, b, q) <= 0)).any())


@given(images, tolerances)
def test_centres_of_occupied_cells_are_inside_and_those_of_free_cells_outside(image, tolerance):
    loops = outlines(image, tolerance)
    every = sides(loops)
    for row, column in np.ndindex(image.shape):
        centre = np.array([column + 0.5, row + 0.5])
        assert inside(centre, every) == image[row, column]
        assert sum(winding(centre, loop) for loop in loops) == image[row, column]


@given(images, tolerances)
def test_an_outline_is_nowhere_half_a_cell_from_the_edges_nor_the_edges_half_a_diagonal_from_it(image, tolerance):
    exact = sides(edge_loops(image))
    traced = sides(outlines(image, tolerance))
    assert (len(traced) == 0) == (not image.any())
    if len(traced):
        assert distances(along(traced), exact).max() < (0.5 if tolerance else 1e-9)
        assert distances(along(exact), traced).max() < (math.sqrt(0.5) if tolerance else 1e-9)


@given(images, tolerances)
def test_no_ray_slips_between_cells_that_touch_at_a_corner(image, tolerance):
    traced = sides(outlines(image, tolerance))
    corner = image[:-1, :-1], image[:-1, 1:], image[1:, :-1], image[1:, 1:]
    rising = corner[0] & corner[3] & ~corner[1] & ~corner[2]
    falling = corner[1] & corner[2] & ~corner[0] & ~corner[3]
    for row, column in np.argwhere(rising):
        assert crosses(traced, np.array([column + 1.5, row + 0.5]), np.array([column + 0.5, row + 1.5]))
    for row, column in np.argwhere(falling):
        assert crosses(traced, np.array([column + 0.5, row + 0.5]), np.array([column + 1.5, row + 1.5]))


@given(images, tolerances)
def test_the_sides_close_to_the_bit_and_are_never_more_than_the_corners_of_the_cells(image, tolerance):
    segments = trace(image, 0.05, (1.7, -0.3, 0.4), tolerance * 0.05)
    assert sorted(map(tuple, segments[:, :2])) == sorted(map(tuple, segments[:, 2:]))
    assert len(segments) <= sum(map(len, edge_loops(image)))
    assert (np.hypot(*(segments[:, 2:] - segments[:, :2]).T) > 0.01).all()


def test_the_origin_turns_and_moves_the_outline():
    image = np.zeros((3, 5), bool)
    image[1, 1:4] = True
    turned = trace(image, 0.5, (2.0, 1.0, math.pi / 2))
    straight = trace(image, 0.5)
    expected = np.stack([2 - straight[:, 1], 1 + straight[:, 0], 2 - straight[:, 3], 1 + straight[:, 2]], axis=1)
    assert turned == pytest.approx(expected, abs=1e-12)


def test_a_grid_without_occupied_cells_has_no_outline():
    assert trace(np.zeros((4, 6)), 0.05).shape == (0, 4)
    assert trace(np.zeros((0, 0)), 0.05).shape == (0, 4)


@pytest.mark.parametrize(
    ("arguments", "part"),
    [
        ((np.zeros(4), 0.05), "table"),
        ((np.zeros((2, 2, 3)), 0.05), "table"),
        ((np.zeros((2, 2)), 0.0), "resolution is 0"),
        ((np.zeros((2, 2)), math.nan), "resolution is nan"),
        ((np.zeros((2, 2)), 0.05, (0, math.inf, 0)), "origin"),
        ((np.zeros((2, 2)), 0.05, (0, 0)), "origin"),
        ((np.zeros((2, 2)), 0.05, (0, 0, 0), 0.025), "half a cell"),
        ((np.zeros((2, 2)), 0.05, (0, 0, 0), -0.01), "tolerance"),
        ((np.zeros((2, 2)), 0.05, (0, 0, 0), math.nan), "tolerance"),
    ],
)
def test_what_cannot_be_traced_is_refused(arguments, part):
    with pytest.raises(GeometryError, match=part):
        trace(*arguments)
