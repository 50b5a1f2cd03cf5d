"""Tables and what is summed from them, against formulas and brute force."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.navigation.amcl.field import BeamMixture, LikelihoodField, scores


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
