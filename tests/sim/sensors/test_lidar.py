"""The laser against exact geometry, and its noise against its stated distribution."""

import math
from dataclasses import replace
from statistics import NormalDist

import numpy as np
import pytest

from rosmini.sim.geometry.raycast import raycast
from rosmini.sim.models import BURGER
from rosmini.sim.sensors import lidar

LDS = BURGER.lidar
NOTHING = np.empty((0, 3))


def square(half):
    h = half
    return np.array([(-h, -h, h, -h), (h, -h, h, h), (h, h, -h, h), (-h, h, -h, -h)])


def distances_in_square(x, y, theta, half):
    """How far it is from a point in a square around the origin to its walls, in 360 directions from theta on."""
    angles = theta + np.arange(360) * 2 * math.pi / 360
    with np.errstate(divide="ignore"):
        to_x = np.where(np.cos(angles) > 0, half - x, -half - x) / np.cos(angles)
        to_y = np.where(np.sin(angles) > 0, half - y, -half - y) / np.sin(angles)
    return np.minimum(np.where(to_x > 0, to_x, np.inf), np.where(to_y > 0, to_y, np.inf))


@pytest.mark.parametrize("pose", [(0.0, 0.0, 0.0), (0.7, -0.4, 0.0), (-0.9, 0.9, 2.1), (0.3, 0.3, -11.0)])
def test_ranges_in_a_square_are_exact(pose):
    c, s = math.cos(pose[2]), math.sin(pose[2])
    eye = (pose[0] - 0.032 * c, pose[1] - 0.032 * s)
    exact = distances_in_square(*eye, pose[2], 2.0)
    exact[exact > LDS.range_max] = np.inf
    np.testing.assert_allclose(lidar.scan(LDS, pose, square(2.0), NOTHING), exact, atol=1e-9)


def test_what_cannot_be_measured_is_infinite_as_in_rep_117():
    measured = lidar.measured(LDS, np.array([0.05, 0.12, 1.0, 3.5, 3.6, np.inf]))
    assert measured.tolist() == [-math.inf, 0.12, 1.0, 3.5, math.inf, math.inf]
    assert lidar.unmeasured(measured).tolist() == [0.0, 0.12, 1.0, 3.5, 0.0, 0.0]


def test_noise_over_fifty_seeds_has_the_stated_distribution():
    exact = distances_in_square(-0.032, 0.0, 0.0, 2.0)
    residuals = []
    for seed in range(50):
        noise = np.random.default_rng(seed).standard_normal(360) * LDS.noise
        residuals.append(lidar.scan(LDS, (0.0, 0.0, 0.0), square(2.0), NOTHING, noise) - exact)
    found = np.sort(np.concatenate(residuals))
    n = len(found)
    assert n == 18_000
    assert abs(found.mean()) < 4 * LDS.noise / math.sqrt(n)
    assert found.std() == pytest.approx(LDS.noise, rel=0.03)
    # Kolmogorov and Smirnov: the largest distance of the two distribution functions, 1.95 / sqrt(n) at the level 0.001
    expected = np.array([NormalDist(0, LDS.noise).cdf(value) for value in found])
    steps = np.arange(n + 1) / n
    assert max((steps[1:] - expected).max(), (expected - steps[:-1]).max()) < 1.95 / math.sqrt(n)


@pytest.mark.parametrize("backend", ["numba", "numpy"])
@pytest.mark.parametrize("yaw", [0.0, math.pi / 2, 2.5])
def test_one_ray_alone_measures_where_it_looks(monkeypatch, backend, yaw):
    monkeypatch.setenv("ROSMINI_RAYCAST", backend)
    single = replace(LDS, beams=1, angle_min=0.0, angle_max=0.0, yaw=yaw, mount=(0.0, 0.0, 0.2))
    (found,) = lidar.scan(single, (0.2, 0.1, 0.3), square(1.0), NOTHING)
    exact = raycast(square(1.0), NOTHING, 0.2, 0.1, 0.3 + yaw, 1.0, 2, 5.0)[0]
    assert found == pytest.approx(exact, abs=1e-9)
