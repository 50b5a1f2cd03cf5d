"""Distances, tables and beams, against geometry and brute force."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rosmini.navigation.amcl.field import BeamMixture, LikelihoodField, beam_ranges, distances, scores


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


def test_a_density_is_that_of_the_formula():
    field, mixture = room(), BeamMixture(z_hit=0.9, z_rand=0.1, sigma_hit=0.1)
    table, outside = field.densities(mixture, 3.5, "cube")
    log, _ = field.densities(mixture, 3.5, "log")
    density = 0.9 * np.exp(-(field.distance**2) / (2 * 0.1**2)) + 0.1 / 3.5
    assert table == pytest.approx(density**3, rel=1e-4)
    assert log == pytest.approx(np.log(density), rel=1e-4, abs=1e-6)
    assert outside == pytest.approx((0.9 * math.exp(-(2.0**2) / 0.02) + 0.1 / 3.5) ** 3, rel=1e-4)


def test_densities_of_another_laser_replace_the_table():
    field = room()
    one, _ = field.densities(BeamMixture(), 3.5, "cube")
    other, _ = field.densities(BeamMixture(), 7.0, "cube")
    assert not np.allclose(one, other)
    assert field.densities(BeamMixture(), 7.0, "cube")[0] is other


@settings(max_examples=30)
@given(st.integers(0, 2**32 - 1))
def test_sums_are_the_sums_of_each(seed):
    rng = np.random.default_rng(seed)
    field = room()
    table, outside = field.densities(BeamMixture(), 3.5, "cube")
    poses, ends = rng.uniform(-1.5, 1.5, (7, 3)), rng.uniform(-2, 2, (11, 2))
    each = field.each(table, outside, poses, ends).sum(axis=1)
    assert field.sums(table, outside, poses, ends) == pytest.approx(each, rel=1e-6)
    plain = np.empty(7)
    scores(table, outside, *field.origin, 1 / field.resolution, poses, ends, plain)
    assert plain == pytest.approx(each, rel=1e-6)


@given(st.floats(-0.9, 0.9), st.floats(-0.9, 0.9), st.floats(-math.pi, math.pi))
def test_beams_end_at_the_walls(x, y, angle):
    """The inner sides of the walls of the room are at -0.95 and 0.95."""
    field = room()
    c, s = math.cos(angle), math.sin(angle)
    to_x = ((0.95 if c > 0 else -0.95) - x) / c if abs(c) > 1e-12 else math.inf
    to_y = ((0.95 if s > 0 else -0.95) - y) / s if abs(s) > 1e-12 else math.inf
    poses, bearings = np.array([[x, y, 0.0]]), np.array([angle])
    found = field.ranges(poses, bearings, 10.0)
    assert found[0, 0] == pytest.approx(min(to_x, to_y), abs=1e-6)
    plain = np.empty((1, 1))
    beam_ranges(field.blocked, *field.origin, field.resolution, poses, bearings, 10.0, plain)
    assert plain == pytest.approx(found, abs=1e-9)
    assert field.ranges(poses, bearings, 0.02)[0, 0] == 0.02


def test_a_beam_ends_where_nothing_is_known_too():
    occupied, free = np.zeros((10, 10), dtype=bool), np.ones((10, 10), dtype=bool)
    free[:, 6] = False
    field = LikelihoodField(occupied, 0.1, (0.0, 0.0), free=free)
    assert field.ranges(np.array([[0.25, 0.5, 0.0]]), np.array([0.0]), 5.0)[0, 0] == pytest.approx(0.35)
    assert LikelihoodField(occupied, 0.1, (0.0, 0.0)).ranges(
        np.array([[0.25, 0.5, 0.0]]), np.array([0.0]), 5.0
    )[0, 0] == pytest.approx(0.75)
