"""The differential drive against closed forms, and against itself with other steps."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.sim.engine.free_motion import body_velocity, limited, phases, ramp, rim_speeds, unicycle

speeds = st.floats(-0.5, 0.5)
rates = st.floats(-2.0, 2.0)
times = st.floats(0.0, 3.0)


def test_limits_are_those_of_the_firmware_each_on_its_own():
    assert limited(1.0, -9.0, 0.22, 2.84) == (0.22, -2.84)
    assert limited(-0.1, 0.5, 0.22, 2.84) == (-0.1, 0.5)


def test_wheels_of_a_turn_in_place_go_against_each_other():
    assert rim_speeds(0.0, 1.0, 0.16) == (-0.08, 0.08)


@given(speeds, rates)
def test_rim_speeds_and_body_velocity_are_inverse(v, w):
    assert body_velocity(*rim_speeds(v, w, 0.16), 0.16) == pytest.approx((v, w), abs=1e-12)


def test_braking_takes_the_way_v_squared_by_two_a():
    way, speed = ramp(0.22, 0.0, 1.0, 5.0)
    assert way == pytest.approx(0.22**2 / 2, abs=1e-15)
    assert speed == 0.0


def test_a_ramp_that_goes_on():
    assert ramp(0.0, 0.2, 1.0, 0.1) == pytest.approx((0.005, 0.1), abs=1e-15)
    assert ramp(0.0, 0.2, 1.0, 1.0) == pytest.approx((0.02 + 0.16, 0.2), abs=1e-15)
    assert ramp(0.2, -0.2, 1.0, 0.4) == pytest.approx((0.0, -0.2), abs=1e-15)


@given(speeds, speeds, times, times)
def test_a_ramp_does_not_depend_on_the_step(speed, target, first, second):
    way, after = ramp(speed, target, 1.0, first)
    more, end = ramp(after, target, 1.0, second)
    whole, last = ramp(speed, target, 1.0, first + second)
    assert (way + more, end) == pytest.approx((whole, last), abs=1e-12)


@given(speeds, speeds, speeds, speeds, st.floats(0.001, 3.0))
def test_phases_are_the_two_ramps(left, right, left_target, right_target, dt):
    found = phases(left, right, left_target, right_target, 1.0, dt)
    assert 1 <= len(found) <= 3
    assert sum(h for h, _, _ in found) == pytest.approx(dt)
    ways, ends = [0.0, 0.0], [left, right]
    for h, *accelerations in found:
        for i, a in enumerate(accelerations):
            ways[i] += ends[i] * h + a * h * h / 2
            ends[i] += a * h
    for i, (speed, target) in enumerate(((left, left_target), (right, right_target))):
        assert (ways[i], ends[i]) == pytest.approx(ramp(speed, target, 1.0, dt), abs=1e-12)


def test_a_circle_closes():
    pose = (1.0, 2.0, 0.3)
    for _ in range(1000):
        pose = unicycle(pose, 0.2, 0.5, 0.0, 0.0, 2 * math.pi / 0.5 / 1000)
    assert pose[:2] == pytest.approx((1.0, 2.0), abs=1e-9)
    assert pose[2] == pytest.approx(0.3 + 2 * math.pi, abs=1e-9)


def test_a_half_circle_has_twice_the_radius_across():
    x, y, theta = unicycle((0.0, 0.0, 0.0), 0.2, 0.5, 0.0, 0.0, math.pi / 0.5)
    assert (x, y, theta) == pytest.approx((0.0, 2 * 0.2 / 0.5, math.pi), abs=1e-12)


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
