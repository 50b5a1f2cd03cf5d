"""Encoders, dead reckoning, and what makes them wrong."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rosmini.sim.engine.free_motion import unicycle
from rosmini.sim.engine.odometry import Odometry, RealWheels, dead_reckoning, ticks
from rosmini.sim.models import BURGER, WheelErrors


def test_ticks_are_whole_and_count_backwards_too():
    assert ticks(2 * math.pi, 4096) == 4096
    assert ticks(2 * math.pi * 0.9999, 4096) == 4095
    assert ticks(-1e-9, 4096) == -1
    assert ticks(10 * 2 * math.pi, 4096) == 40960


def test_dead_reckoning_is_the_firmwares_midpoint_rule():
    x, y, theta = dead_reckoning((1.0, 2.0, 0.5), 0.01, 0.03, 0.16)
    assert theta == pytest.approx(0.5 + 0.125)
    assert (x, y) == pytest.approx((1 + 0.02 * math.cos(0.5625), 2 + 0.02 * math.sin(0.5625)))


def drive(odometry, wheels, v, w, seconds):
    """The truth after driving so from the origin; the odometry learns of it 30 times a second."""
    model = odometry.model
    half = w * model.wheel_separation / 2
    truth, n = (0.0, 0.0, 0.0), round(seconds * 30)
    for i in range(1, n + 1):
        left, right = (v - half) * wheels.left, (v + half) * wheels.right
        truth = unicycle(truth, (left + right) / 2, (right - left) / wheels.separation, 0.0, 0.0, 1 / 30)
        angles = [(v - half) * i / 30 / model.wheel_radius, (v + half) * i / 30 / model.wheel_radius]
        odometry.update(*(ticks(angle, model.ticks_per_turn) for angle in angles), 1 / 30)
    return truth


def test_without_errors_and_with_fine_ticks_odometry_is_the_truth():
    model = replace(BURGER, ticks_per_turn=10**10)
    odometry = Odometry(model)
    truth = drive(odometry, RealWheels(model, np.random.default_rng(1), 0.0), 0.2, 0.0, 10.0)
    assert odometry.pose == pytest.approx(truth, abs=1e-8)
    assert (odometry.v, odometry.w) == pytest.approx((0.2, 0.0), abs=1e-6)
    assert odometry.left == pytest.approx(2.0 / 0.033, abs=1e-8)
    assert odometry.left_rate == pytest.approx(0.2 / 0.033, abs=1e-6)


def test_the_midpoint_rule_shortens_an_arc_by_a_known_part():
    # a chord of the polygon is ds where the arc's is ds sin(h) / h, with h half the turn of a thirtieth of a second
    model = replace(BURGER, ticks_per_turn=10**10)
    odometry = Odometry(model)
    truth = drive(odometry, RealWheels(model, np.random.default_rng(1), 0.0), 0.2, 1.0, 1.0)
    h = 0.5 / 30
    assert math.hypot(*odometry.pose[:2]) == pytest.approx(math.hypot(*truth[:2]) * h / math.sin(h), rel=1e-7)


def test_drift_is_a_few_percent_and_another_one_for_each_robot():
    away = []
    for seed in range(50):
        odometry = Odometry(BURGER)
        truth = drive(odometry, RealWheels(BURGER, np.random.default_rng(seed)), 0.2, 0.0, 20.0)
        away.append(math.dist(odometry.pose[:2], truth[:2]) / 4.0)
    assert 0.01 < np.median(away) < 0.05
    assert max(away) < 0.15
    assert len(set(away)) == 50


def test_the_errors_of_wheels_have_the_stated_size():
    model = replace(BURGER, errors=WheelErrors(radius=0.01, separation=0.02, slip=0.0))
    drawn = [RealWheels(model, np.random.default_rng(seed)) for seed in range(400)]
    radii = np.array([[wheels.left, wheels.right] for wheels in drawn]) - 1
    wide = np.array([wheels.separation for wheels in drawn]) / model.wheel_separation - 1
    assert radii.std() == pytest.approx(0.01, rel=0.1)
    assert wide.std() == pytest.approx(0.02, rel=0.1)
    assert abs(radii.mean()) < 0.002


def test_slip_changes_and_keeps_its_mean():
    model = replace(BURGER, errors=WheelErrors(radius=0.0, separation=0.0, slip=0.01))
    wheels = RealWheels(model, np.random.default_rng(3))
    drawn = []
    for _ in range(2000):
        wheels.slip()
        drawn.append(wheels.left)
    assert np.std(drawn) == pytest.approx(0.01, rel=0.1)
    assert np.mean(drawn) == pytest.approx(1.0, abs=0.001)
