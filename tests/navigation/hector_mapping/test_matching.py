"""The map as a surface, its slope against differences, one step by hand, and that a match finds the pose."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.geometry.poses import transform_points
from rosmini.navigation.hector_mapping.grid import OccupancyGrid
from rosmini.navigation.hector_mapping.matching import UNKNOWN_VARIANCE, climb, compiled_climb, match, surface

BEARINGS = np.arange(180) * math.tau / 180


def room(pose, width=2.0, depth=1.4):
    """Where beams from a pose end, in the robot's frame: a room of 2 width x 2 depth around the origin."""
    x, y, heading = pose
    c, s = np.cos(heading + BEARINGS), np.sin(heading + BEARINGS)
    with np.errstate(divide="ignore"):
        to_x = np.where(c > 0, width - x, -width - x) / c
        to_y = np.where(s > 0, depth - y, -depth - y) / s
    lengths = np.fmin(np.where(to_x > 0, to_x, 99.0), np.where(to_y > 0, to_y, 99.0))
    return lengths[:, None] * np.column_stack([np.cos(BEARINGS), np.sin(BEARINGS)])


def a_map(resolution=0.05, times=3):
    size = round(6 / resolution)
    grid = OccupancyGrid((size, size), resolution, (-3.0, -3.0))
    for _ in range(times):
        grid.update((0.1, 0.1), transform_points((0.1, 0.1, 0.0), room((0.1, 0.1, 0.0))))
    return grid


@pytest.fixture(scope="module")
def grid():
    return a_map()


BY_HAND = np.array([[0.1, 0.5, 0.5], [0.2, 0.9, 0.4], [0.5, 0.6, 0.3]], dtype=np.float32)


def test_a_surface_by_hand():
    assert surface(BY_HAND, 1.0, 1.0)[0] == pytest.approx(0.9)
    value, along_x, along_y = surface(BY_HAND, 0.25, 0.5)
    assert value == pytest.approx(0.75 * 0.15 + 0.25 * 0.7)
    assert along_x == pytest.approx(0.7 - 0.15)
    assert along_y == pytest.approx(0.75 * 0.1 + 0.25 * 0.4)
    for outside in ((-0.01, 0.5), (2.0, 0.5), (0.5, 2.0), (math.nan, 0.5), (math.inf, 0.5)):
        assert surface(BY_HAND, *outside) == (0.0, 0.0, 0.0)


@given(st.floats(0.02, 1.97), st.floats(0.02, 1.97))
def test_slopes_are_differences(x, y):
    e = 1e-5
    if min(abs(v - round(v)) for v in (x, y)) < 2 * e:
        return  # At the middles of cells the surface has a kink.
    _, dx, dy = surface(BY_HAND, x, y)
    assert dx == pytest.approx((surface(BY_HAND, x + e, y)[0] - surface(BY_HAND, x - e, y)[0]) / 2 / e, abs=1e-5)
    assert dy == pytest.approx((surface(BY_HAND, x, y + e)[0] - surface(BY_HAND, x, y - e)[0]) / 2 / e, abs=1e-5)


def test_a_step_is_gauss_newtons(grid):
    """Against numpy: residuals and their Jacobian by differences, and the normal equations."""
    pose = np.array([60.3, 61.2, 0.03])
    ends = room((0.1, 0.1, 0.0))[::20] / 0.05

    def lacking(p):
        c, s = math.cos(p[2]), math.sin(p[2])
        points = ends @ np.array([[c, s], [-s, c]]) + p[:2]
        return np.array([1 - surface(grid.probabilities, *point)[0] for point in points])

    e = 1e-6
    jacobian = np.column_stack([(lacking(pose + e * unit) - lacking(pose - e * unit)) / 2 / e for unit in np.eye(3)])
    step = -np.linalg.solve(jacobian.T @ jacobian, jacobian.T @ lacking(pose))
    moved, result = pose.copy(), np.zeros(8)
    climb(grid.probabilities, ends, moved, 1, result)
    assert moved - pose == pytest.approx(step, abs=1e-5)
    assert result[6] == pytest.approx(np.mean(lacking(pose) ** 2))
    compiled, same = pose.copy(), np.zeros(8)
    compiled_climb()(grid.probabilities, ends, compiled, 1, same)
    assert compiled == pytest.approx(moved, abs=1e-9)
    assert same == pytest.approx(result, rel=1e-9)


@pytest.mark.parametrize("off", [(0.04, -0.05, 0.03), (-0.05, 0.03, -0.04), (0.0, 0.0, 0.0)])
def test_a_match_finds_a_known_shift(grid, off):
    truth = (0.2, 0.0, 0.1)
    found = match(grid, room(truth), tuple(a + b for a, b in zip(truth, off, strict=True)), 15)
    assert math.dist(found.pose[:2], truth[:2]) < 0.015
    assert abs(found.pose[2] - truth[2]) < 0.01
    assert found.steps == 16
    deviations = np.sqrt(np.diag(found.covariance))
    assert (deviations < 0.02).all(), "it says that it knows"


def test_where_nothing_holds(grid):
    """Along a wall the covariance is large in one direction; off the map nothing is known; nothing moves."""
    wall = np.column_stack([np.full(40, 1.9), np.linspace(-0.4, 0.4, 40)])
    found = match(grid, wall, (0.1, 0.1, 0.0), 5)
    spread = np.diag(found.covariance)
    assert spread[1] > 20 * spread[0]
    assert np.isfinite(found.pose).all()
    nowhere = match(grid, wall, (40.0, 0.0, 0.0), 5)
    assert (nowhere.pose, nowhere.steps) == ((40.0, 0.0, 0.0), 0)
    assert np.diag(nowhere.covariance) == pytest.approx([UNKNOWN_VARIANCE] * 3)
    assert match(grid, np.empty((0, 2)), (0.1, 0.1, 0.0), 5).pose == (0.1, 0.1, 0.0)
