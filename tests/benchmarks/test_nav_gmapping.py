"""The study of gmapping: its figures are what their names say, on paths and walls by hand, and it runs."""

import math

import numpy as np
import pytest
from rosmini_bench import nav_gmapping
from rosmini_bench.nav_gmapping import Walls

from rosmini.navigation.gmapping.slam import GridSlam, Settings

PATH = np.array([(x, 0.0, 0.0) for x in np.linspace(0.0, 4.0, 41)])


def test_a_path_that_is_turned_is_not_off():
    """Only what happens after the start counts."""
    c, s = math.cos(0.5), math.sin(0.5)
    turned = np.column_stack([3.0 + c * PATH[:, 0], s * PATH[:, 0], np.full(41, 0.5)])
    assert nav_gmapping.off_at_start(turned, PATH) == pytest.approx(0.0, abs=1e-9)
    late = turned.copy()
    late[-1, :2] += 0.41
    assert nav_gmapping.off_at_start(late, PATH) == pytest.approx(0.41 * math.sqrt(2 / 41))


def test_motions_between_pairs():
    there_and_back = np.concatenate([PATH, PATH[::-1]])
    first, second = nav_gmapping.revisits(there_and_back)
    assert (second - first > 60).all()
    assert (np.abs(there_and_back[first, 0] - there_and_back[second, 0]) < 1.0).all()
    assert len(first) > 10
    off = there_and_back.copy()
    off[41:, 1] = 0.2
    distances, angles = nav_gmapping.relative(off, there_and_back, (first, second))
    assert distances == pytest.approx(np.full(len(first), 0.2))
    assert angles == pytest.approx(0.0, abs=1e-12)


def test_precision_and_recall_of_a_wall():
    surface = np.zeros((40, 40), dtype=bool)
    surface[:, 30] = True
    walls = Walls(surface, surface, 0.05, (0.0, 0.0))
    slam = GridSlam(Settings(particles=1), start=(0.5, 1.0, 0.0), random=np.random.default_rng(0))
    bearings = np.linspace(-0.5, 0.5, 41)
    slam.process(1.02 / np.cos(bearings), bearings, (0.5, 1.0, 0.0), 0.0)
    precision, recall = nav_gmapping.map_quality(slam, walls, (0.0, 0.0, 0.0), 1)
    assert precision == 1.0
    assert 0.5 < recall < 0.8, "half a metre to both sides of two"
    assert nav_gmapping.map_quality(slam, walls, (0.2, 0.0, 0.0), 1) == (0.0, 0.0)


def test_figures_of_cost_are_measured():
    assert nav_gmapping.scan_cost(2, 30, 1) > 0
    assert nav_gmapping.memory(3, 200) < 3 * nav_gmapping.memory(1, 200), "maps are shared"
