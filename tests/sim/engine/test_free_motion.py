"""The differential drive against closed forms, and against itself with other steps."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.sim.engine.free_motion import body_velocity, rim_speeds, unicycle

speeds = st.floats(-0.5, 0.5)
rates = st.floats(-2.0, 2.0)


@given(speeds, rates)
def test_rim_speeds_and_body_velocity_are_inverse(v, w):
    assert body_velocity(*rim_speeds(v, w, 0.16), 0.16) == pytest.approx((v, w), abs=1e-12)


@given(speeds, rates, rates, rates, st.floats(0.01, 2.0), st.integers(1, 7))
def test_a_motion_with_changing_speeds_does_not_depend_on_the_step(v, w, dv, dw, dt, count):
    pose, h = (0.0, 0.0, 1.0), dt / count
    for i in range(count):
        pose = unicycle(pose, v + dv * h * i, w + dw * h * i, dv, dw, h)
    assert pose == pytest.approx(unicycle((0.0, 0.0, 1.0), v, w, dv, dw, dt), abs=1e-10)


def test_a_spiral_against_fine_sums():
    v, w, dv, dw, dt, n = 0.1, 0.2, 0.3, -1.5, 1.3, 200_000
    x = y = 0.0
    h = dt / n
    for i in range(n):
        t = (i + 0.5) * h
        heading = w * t + dw * t * t / 2
        x += (v + dv * t) * math.cos(heading) * h
        y += (v + dv * t) * math.sin(heading) * h
    found = unicycle((0.0, 0.0, 0.0), v, w, dv, dw, dt)
    assert found == pytest.approx((x, y, w * dt + dw * dt * dt / 2), abs=1e-10)
