"""The particle filter: numbers of Fox's formula, unbiased resampling, recovery and clusters."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.navigation.amcl.filter import ParticleFilter, cell_numbers, cells, cluster_labels, cluster_of


def a_filter(fewest=10, most=2000, **options):
    return ParticleFilter(fewest, most, random=np.random.default_rng(3), **options)


def nowhere(count):
    raise AssertionError("nothing is drawn at random")


@pytest.mark.parametrize("bins", [2, 10, 50, 100])
def test_the_limit_is_that_of_the_formula(bins):
    """And, as it approximates, the quantile of the chi-square distribution over 2 e (Fox 2003, equation 7)."""
    k = bins - 1
    formula = k / 0.02 * (1 - 2 / (9 * k) + math.sqrt(2 / (9 * k)) * 0.99) ** 3
    found = int(a_filter(1, 10**6).limit(np.array([bins]))[0])
    assert found == math.ceil(formula)
    drawn = np.random.default_rng(1).chisquare(k, 400_000)
    assert found == pytest.approx(np.quantile(drawn, 0.8389) / 0.02, rel=0.02), "0.99 is the quantile of 0.8389"


def test_the_limit_stays_in_its_bounds():
    particles = a_filter(100, 5000)
    assert particles.limit(np.array([1, 2, 10**6])).tolist() == [5000, 100, 5000]
    assert a_filter(1, 500, error=0.0).limit(np.array([5])).tolist() == [500]


def test_an_initial_cloud_has_its_mean_and_covariance():
    wanted = np.array([[0.2, 0.05, 0.0], [0.05, 0.1, 0.0], [0.0, 0.0, 0.04]])
    particles = a_filter(most=100_000)
    particles.initialize((1.0, -2.0, 3.0), wanted)
    found = particles.mean()
    assert found.mean == pytest.approx((1.0, -2.0, 3.0), abs=0.01)
    assert found.covariance == pytest.approx(wanted, abs=0.005)
    assert (abs(particles.particles[:, 2]) <= math.pi).all()


def test_weights_are_likelihoods_and_sum_to_one():
    particles = a_filter(1, 4)
    particles.update_weights(np.log([0.1, 0.2, 0.3, 0.4]) - 2000.0)
    assert particles.weights == pytest.approx([0.1, 0.2, 0.3, 0.4])
    assert particles.effective == pytest.approx(1 / 0.30)
    particles.update_weights(np.full(4, -math.inf))
    assert particles.weights == pytest.approx([0.25] * 4), "when no particle explains anything, all are equal"


def test_resampling_is_unbiased():
    """How often a particle is drawn has the mean of its weight, within four standard errors."""
    weights = np.random.default_rng(8).random(20) ** 3
    weights /= weights.sum()
    drawn = np.zeros(20)
    particles = a_filter(1, 20)
    rounds = 3000
    for _ in range(rounds):
        particles.particles = np.column_stack([np.arange(20) * 1.0, np.zeros(20), np.zeros(20)])
        particles.weights = weights.copy()
        particles.resample(nowhere)
        drawn += np.bincount(particles.particles[:, 0].astype(int), minlength=20) / len(particles.particles)
    error = np.sqrt(weights * (1 - weights) / (rounds * 15))
    assert (abs(drawn / rounds - weights) < 4 * error + 1e-4).all()


def test_a_narrow_cloud_takes_few_particles_and_a_wide_one_many():
    narrow, wide = a_filter(20, 5000), a_filter(20, 5000)
    narrow.initialize((0.25, 0.25, 0.05), np.diag([1e-6] * 3))
    wide.initialize((0.0, 0.0, 0.0), np.diag([4.0, 4.0, 1.0]))
    narrow.resample(nowhere)
    wide.resample(nowhere)
    assert len(wide.particles) == 5000
    assert narrow.converged
    assert not wide.converged
    narrow.initialize((0.0, 0.25, 0.05), np.diag([1e-4, 1e-6, 1e-6]))
    narrow.resample(nowhere)
    assert len(narrow.particles) == narrow.limit(np.array([2]))[0] + 1, "two cells of the histogram"


def test_selective_resampling_waits_until_few_count():
    particles = a_filter(10, 100, selective=True)
    particles.initialize((0.0, 0.0, 0.0), np.diag([0.1] * 3))
    before = particles.particles
    particles.resample(nowhere)
    assert particles.particles is before
    particles.update_weights(np.where(np.arange(100) < 10, 0.0, -20.0))
    particles.resample(nowhere)
    assert particles.particles is not before


def test_particles_at_random_come_when_the_likelihood_falls():
    """Probabilistic Robotics, table 8.3: the share is 1 - fast / slow."""
    particles = a_filter(50, 2000, slow=0.001, fast=0.1)
    particles.initialize((0.0, 0.0, 0.0), np.diag([0.01] * 3))
    particles.update_weights(np.zeros(2000))
    particles.update_weights(np.full(2000, math.log(0.1)))
    fast, slow = 1 - 0.1 * 0.9, 1 - 0.001 * 0.9
    assert particles.random_share == pytest.approx(1 - fast / slow)
    asked = []

    def far(count):
        asked.append(count)
        return np.full((count, 3), 100.0)

    particles.resample(far)
    assert asked[0] == pytest.approx(2000 * (1 - fast / slow), rel=0.3)
    assert (particles.particles[:, 0] == 100.0).any()
    assert particles.random_share == 0.0, "and it begins anew"


def test_clusters_and_the_best_of_them():
    particles = a_filter(1, 300)
    particles.particles = np.concatenate([np.full((100, 3), 0.1), np.tile((5.0, 5.0, 2.0), (200, 1))])
    particles.weights = np.concatenate([np.full(100, 0.006), np.full(200, 0.002)])
    best, other = particles.clusters()
    assert best.mean == pytest.approx((0.1, 0.1, 0.1))
    assert (best.weight, best.count, other.count) == (pytest.approx(0.6), 100, 200)


def test_a_cluster_goes_on_where_the_heading_wraps_around():
    particles = a_filter(1, 100)
    particles.initialize((0.0, 0.0, math.pi), np.diag([1e-4, 1e-4, 0.04]))
    (only,) = particles.clusters()
    assert math.remainder(only.mean[2] - math.pi, math.tau) == pytest.approx(0.0, abs=0.1)
    assert only.covariance[2, 2] == pytest.approx(0.04, rel=0.5)


@given(st.integers(0, 2**32 - 1), st.integers(1, 120), st.floats(0.5, 8.0))
def test_clusters_are_cells_that_touch(seed, count, size):
    rng = np.random.default_rng(seed)
    keys = cells(rng.uniform(-size, size, (count, 3)) % (10.0, 10.0, math.tau))
    labels = cluster_labels(keys)
    away = abs(keys[:, None] - keys[None])
    away[..., 2] = np.minimum(away[..., 2], 36 - away[..., 2])
    reach = (away <= 1).all(axis=2)
    for _ in range(8):
        reach = reach @ reach
    assert (reach == (labels[:, None] == labels[None])).all()
    assert set(labels.tolist()) == set(range(labels.max() + 1))
    assert len(np.unique(cell_numbers(keys))) == len(np.unique(keys, axis=0))


def test_the_mean_of_headings_is_circular():
    found = cluster_of(np.array([(0.0, 0.0, 3.1), (2.0, 0.0, -3.1)]), np.array([0.5, 0.5]))
    assert abs(found.mean[2]) == pytest.approx(math.pi)
    assert found.mean[0] == 1.0
    assert found.covariance[0, 0] == 1.0
