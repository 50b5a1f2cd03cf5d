"""The measurements of local planners, run once: what they say is checked against what physics says."""

import math

import pytest
from rosmini_bench import nav_control


@pytest.mark.nightly
def test_a_cycle_is_what_its_figure_says():
    samples = nav_control.cycle()()
    assert 760 <= len(samples) <= 800
    assert set(samples.lengths.tolist()) <= {29, 30}
    assert samples.best is not None
    assert len(nav_control.cycle(planner=nav_control.rollout())()) == 800


def test_the_dynamic_window_ignores_how_long_wheels_take_to_accelerate():
    """From a standstill to v at a it takes v / a, in which the robot comes v^2 / 2a less far than was foreseen."""
    lag = nav_control.miss((0.22, 0.0), (0.0, 0.0), 2.5, window=True)
    assert lag.distance == pytest.approx(0.22**2 / (2 * 1.0), abs=1e-3)
    steady = nav_control.miss((0.22, 0.0), (0.22, 0.0), 2.5, window=True)
    assert steady.distance < 1e-3


def test_the_true_acceleration_predicts_better_than_that_of_the_files():
    sums = [
        sum(each.distance + 0.1 * abs(each.heading) for each in nav_control.misses(acceleration, window=window))
        for acceleration, window in ((2.5, True), (2.5, False), (1.0, False))
    ]
    assert sums[0] > sums[1] > sums[2]


def test_a_turn_on_the_spot_lags_by_its_acceleration():
    """The rim of a wheel 8 cm aside reaches w 0.08 m/s at 1 m/s2; for so long half of the turn is missing."""
    turn = nav_control.miss((0.0, 2.75), (0.0, 0.0), 2.5, window=True)
    assert turn.heading == pytest.approx(-(2.75**2) * 0.08 / 2, rel=0.15)
    assert math.isclose(turn.distance, 0.0, abs_tol=2e-3)
