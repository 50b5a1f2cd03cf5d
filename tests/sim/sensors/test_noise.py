"""Noise has the distribution that its numbers state."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rosmini.sim.sensors.noise import Noise, NoiseError, NoiseModel


def unit(seed=0, count=1, **numbers):
    return Noise(NoiseModel(**numbers), np.random.default_rng(seed), count)


def test_no_noise_changes_nothing():
    np.testing.assert_array_equal(unit(count=3).measured([1.0, math.inf, -2.0], 0.1), [1.0, math.inf, -2.0])


def test_white_noise_has_its_mean_and_deviation():
    values = unit(count=40_000, stddev=0.2, mean=0.5).measured(np.zeros(40_000))
    assert values.mean() == pytest.approx(0.5, abs=4 * 0.2 / 200)
    assert values.std() == pytest.approx(0.2, rel=0.02)


def test_a_bias_stays_and_differs_from_unit_to_unit():
    one = unit(bias_stddev=0.1)
    assert one.measured([0.0])[0] == one.measured([0.0])[0] != 0.0
    biases = np.array([unit(seed, bias_mean=1.0, bias_stddev=0.1).bias[0] for seed in range(400)])
    assert np.abs(biases).mean() == pytest.approx(1.0, abs=0.03)
    assert 0.4 < (biases > 0).mean() < 0.6


def test_a_drift_has_the_spread_and_the_memory_of_a_gauss_markov_process():
    sigma, tau = 0.3, 2.0
    noise = unit(count=20_000, drift=sigma, drift_time=tau)
    for _ in range(40):
        noise.measured(np.zeros(20_000), 0.5)
    before = noise.bias.copy()
    assert before.std() == pytest.approx(sigma * math.sqrt(tau / 2), rel=0.03)
    noise.measured(np.zeros(20_000), 1.0)
    assert np.corrcoef(before, noise.bias)[0, 1] == pytest.approx(math.exp(-1.0 / tau), abs=0.03)


def test_the_drift_does_not_depend_on_how_often_it_is_asked_for_on_average():
    spread = []
    for steps in (1, 10):
        noise = unit(count=20_000, drift=1.0, drift_time=1.0)
        for _ in range(steps):
            noise.measured(np.zeros(20_000), 1.0 / steps)
        spread.append(noise.bias.std())
    assert spread[0] == pytest.approx(spread[1], rel=0.03)


def test_a_resolution_rounds():
    np.testing.assert_allclose(unit(count=2, resolution=0.25).measured([0.3, -0.4]), [0.25, -0.5])


def test_gaps_are_as_many_as_said():
    values = unit(count=20_000, dropout=0.1).measured(np.ones(20_000))
    assert np.isnan(values).mean() == pytest.approx(0.1, abs=0.01)


def test_the_same_seed_gives_the_same_noise_whatever_is_measured():
    one, other = (unit(5, 4, stddev=1.0, bias_stddev=1.0) for _ in range(2))
    np.testing.assert_allclose(one.measured(np.zeros(4)), other.measured(np.full(4, 7.0)) - 7.0)


def test_a_noise_can_be_made_stronger():
    twice = NoiseModel(stddev=0.1, bias_mean=1.0, resolution=0.5).scaled(2)
    assert twice == NoiseModel(stddev=0.2, bias_mean=2.0, resolution=0.5)


@pytest.mark.parametrize(
    ("numbers", "what"),
    [
        ({"stddev": -1.0}, "stddev"),
        ({"mean": math.nan}, "mean"),
        ({"dropout": 1.5}, "dropout"),
        ({"drift": 1.0}, "drift_time"),
        ({"resolution": "fine"}, "resolution"),
    ],
)
def test_numbers_that_are_none_are_refused(numbers, what):
    with pytest.raises(NoiseError, match=what):
        NoiseModel(**numbers)
