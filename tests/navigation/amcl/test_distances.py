"""Distances and beams, against geometry and brute force."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.navigation.amcl.field import LikelihoodField, cast_beams, clearances, distances


@st.composite
def masks(draw):
    height, width = draw(st.integers(1, 12)), draw(st.integers(1, 12))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    return rng.random((height, width)) < draw(st.sampled_from([0.0, 0.05, 0.3, 1.0]))


@given(masks(), st.integers(1, 15))
def test_distances_are_exact(occupied, farthest):
    found = distances(occupied, farthest)
    rows, columns = np.nonzero(occupied)
    for row, column in np.ndindex(*occupied.shape):
        nearest = min(np.hypot(rows - row, columns - column), default=math.inf)
        assert found[row, column] == pytest.approx(min(nearest, farthest), abs=1e-5)


def room(size=40, resolution=0.05):
    occupied = np.zeros((size, size), dtype=bool)
    occupied[[0, -1], :] = occupied[:, [0, -1]] = True
    return LikelihoodField(occupied, resolution, (-1.0, -1.0))


@given(st.floats(-0.9, 0.9), st.floats(-0.9, 0.9), st.floats(-math.pi, math.pi))
def test_beams_end_at_the_walls(x, y, angle):
    """The inner sides of the walls of the room are at -0.95 and 0.95."""
    poses, bearings = np.array([[x, y, 0.0]]), np.array([angle])
    found = room().ranges(poses, bearings, 10.0)[0, 0]
    end = x + found * math.cos(angle), y + found * math.sin(angle)
    assert max(map(abs, end)) == pytest.approx(0.95, abs=5e-5)
    assert room().ranges(poses, bearings, 0.02)[0, 0] == pytest.approx(0.02)


def test_a_beam_ends_where_nothing_is_known_too():
    occupied, free = np.zeros((10, 10), dtype=bool), np.ones((10, 10), dtype=bool)
    free[:, 6] = False
    field = LikelihoodField(occupied, 0.1, (0.0, 0.0), free=free)
    assert field.ranges(np.array([[0.25, 0.5, 0.0]]), np.array([0.0]), 5.0)[0, 0] == pytest.approx(0.35, abs=5e-5)
    assert LikelihoodField(occupied, 0.1, (0.0, 0.0)).ranges(np.array([[0.25, 0.5, 0.0]]), np.array([0.0]), 5.0)[
        0, 0
    ] == pytest.approx(0.75, abs=5e-5)


@given(masks(), st.integers(0, 2**32 - 1), st.sampled_from([3.0, 15.0]))
def test_beams_end_at_the_first_blocked_cell(blocked, seed, limit):
    """As looking every hundredth of a cell finds it; but a corner may be cut by a hair, or not."""
    height, width = blocked.shape
    rng = np.random.default_rng(seed)
    poses = np.column_stack([rng.uniform(0, (width, height), (9, 2)), rng.uniform(-4, 4, 9)])
    bearings = rng.uniform(-4, 4, 5)
    found = cast_beams(clearances(blocked, 4), poses, bearings, limit)
    angles = poses[:, 2, None] + bearings
    ways = np.arange(0, limit, 0.01)
    columns = np.floor(poses[:, 0, None, None] + ways * np.cos(angles)[..., None]).astype(int)
    rows = np.floor(poses[:, 1, None, None] + ways * np.sin(angles)[..., None]).astype(int)
    inside = (columns >= 0) & (columns < width) & (rows >= 0) & (rows < height)
    stopped = ~inside | blocked[rows.clip(0, height - 1), columns.clip(0, width - 1)]
    first = np.where(stopped.any(axis=2), stopped.argmax(axis=2) * 0.01, limit)
    assert np.count_nonzero(abs(found - first) > 0.03) <= 2


def test_a_long_beam_on_a_large_map():
    blocked = np.zeros((2, 4000), dtype=bool)
    blocked[:, 3990] = True
    found = cast_beams(clearances(blocked, 40), np.array([[0.5, 1.0, 0.0]]), np.array([0.0, 1e-4]), 20_000.0)
    assert found == pytest.approx(3989.5, abs=0.1)
