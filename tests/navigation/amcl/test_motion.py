"""Samples of the odometry motion model, against the moments of Probabilistic Robotics, section 5.4, and of amcl."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.navigation.amcl.motion import MODELS, sample_motion_model

COUNT = 100_000
ALPHAS = (0.04, 0.02, 0.03, 0.05, 0.01)


def samples(after, model, alphas=ALPHAS, before=(0.0, 0.0, 0.0)):
    noise = np.random.default_rng(5).standard_normal((COUNT, 3))
    return sample_motion_model(np.zeros((COUNT, 3)), before, after, alphas, noise, model)


@pytest.mark.parametrize("model", ["diff", "diff-corrected"])
@pytest.mark.parametrize(("x", "turn"), [(0.5, 0.0), (-0.5, 0.0), (0.0, 0.7)])
def test_the_spread_of_a_robot_on_wheels(model, x, turn):
    """Straight ahead, backwards, and on the spot: there way and heading have the deviations of the formulas."""
    found = samples((x, 0.0, turn), model)
    a1, a2, a3, a4, _ = ALPHAS
    along = a3 * x**2 + a4 * turn**2
    first, last = a2 * x**2, a1 * turn**2 + a2 * x**2
    power = 1 if model.endswith("corrected") else 2  # the original takes variances for deviations
    assert np.std(found[:, 2]) == pytest.approx(math.sqrt(first**power + last**power), rel=0.02)
    way = np.hypot(found[:, 0], found[:, 1]) if turn else np.sign(x) * np.hypot(found[:, 0], found[:, 1])
    if not turn:
        assert np.mean(way) == pytest.approx(x, abs=0.005)
        assert np.std(way) == pytest.approx(math.sqrt(along**power), rel=0.02)
    assert np.mean(found[:, 2]) == pytest.approx(turn, abs=0.005)


@pytest.mark.parametrize("model", ["omni", "omni-corrected"])
def test_the_spread_of_a_robot_that_drives_sideways(model):
    way, turn = 0.4, 0.3
    found = samples((0.0, way, turn), model)
    a1, a2, a3, a4, a5 = ALPHAS
    if model == "omni":
        along, aside, turned = (a3 * way**2 + a1 * turn**2, a1 * turn**2 + a5 * way**2, a4 * turn**2 + a2 * way**2)
    else:
        along, aside, turned = (
            math.sqrt(a3 * way**2 + a4 * turn**2),
            math.sqrt(a4 * turn**2 + a5 * way**2),
            math.sqrt(a1 * turn**2 + a2 * way**2),
        )
    assert np.std(found[:, 1]) == pytest.approx(along, rel=0.02)
    assert np.std(found[:, 0]) == pytest.approx(aside, rel=0.02)
    assert np.std(found[:, 2]) == pytest.approx(turned, rel=0.02)
    assert np.mean(found, axis=0) == pytest.approx([0.0, way, turn], abs=0.01)


poses = st.tuples(st.floats(-5, 5), st.floats(-5, 5), st.floats(-3.1, 3.1))


@given(poses, poses, poses, st.sampled_from(MODELS))
def test_without_errors_particles_do_as_the_odometry(start, before, after, model):
    found = sample_motion_model(np.array([start]), before, after, (0.0,) * 5, np.ones((1, 3)), model)[0]
    turn = after[2] - before[2]
    dx, dy = after[0] - before[0], after[1] - before[1]
    if math.hypot(dx, dy) < 0.011 and model.startswith("diff"):
        return
    rotation = start[2] - before[2]
    expected = (
        start[0] + math.cos(rotation) * dx - math.sin(rotation) * dy,
        start[1] + math.sin(rotation) * dx + math.cos(rotation) * dy,
    )
    assert found[:2] == pytest.approx(expected, abs=1e-9)
    assert math.remainder(found[2] - start[2] - turn, math.tau) == pytest.approx(0.0, abs=1e-9)
