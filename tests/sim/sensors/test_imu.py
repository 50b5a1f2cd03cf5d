"""The inertial measurement unit: accelerations of a body that turns, noise, bias and drift."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rosmini.sim.models import BURGER, GRAVITY, ImuModel
from rosmini.sim.sensors.imu import BLOCK, Imu, acceleration

MODEL = BURGER.imu


def test_at_rest_it_shows_gravity_only():
    imu = Imu(MODEL, np.random.default_rng(0), 0.0)
    assert imu.read(1, 0.0, 0.0, 0.0, 0.0) == (0.0, 0.0, 0.0, 0.0, 0.0, GRAVITY)


def test_accelerations_of_a_turn():
    # v^2 / r towards the centre; and behind the axle a pull outwards
    assert acceleration(0.0, 0.0, 0.2, 0.5, 0.0, 0.0) == pytest.approx((0.0, 0.2 * 0.5))
    assert acceleration(-0.032, 0.0, 0.0, 2.0, 0.0, 0.0) == pytest.approx((0.032 * 4.0, 0.0))
    assert acceleration(-0.032, 0.0, 0.0, 0.0, 1.0, 3.0) == pytest.approx((1.0, -0.096))


def test_accelerations_are_the_second_derivative_of_the_way():
    x, y, v0, w0, dv, dw, h = -0.032, 0.01, 0.1, 0.7, 0.4, -0.9, 1e-4

    def place(t: float) -> np.ndarray:
        from rosmini.sim.engine.drive import unicycle

        px, py, th = unicycle((0.0, 0.0, 0.0), v0, w0, dv, dw, t)
        return np.array([px + math.cos(th) * x - math.sin(th) * y, py + math.sin(th) * x + math.cos(th) * y])

    second = (place(2 * h) - 2 * place(h) + place(0.0)) / h**2
    t = h
    v, w, heading = v0 + dv * t, w0 + dw * t, w0 * t + dw * t * t / 2
    ax, ay = acceleration(x, y, v, w, dv, dw)
    c, s = math.cos(heading), math.sin(heading)
    np.testing.assert_allclose(second, [c * ax - s * ay, s * ax + c * ay], atol=1e-5)


def test_noise_over_fifty_seeds_has_the_stated_deviations():
    model = ImuModel((0.0, 0.0, 0.0), 200.0, 0.01, 0.1)
    read = np.array(
        [
            Imu(model, np.random.default_rng(seed)).read(i, 0.0, 0.0, 0.0, 0.0)
            for seed in range(50)
            for i in (0, 300)
        ]
    )
    many = Imu(model, np.random.default_rng(7))
    long = np.array([many.read(i, 0.0, 0.0, 0.0, 0.0) for i in range(5000)]) - (0, 0, 0, 0, 0, GRAVITY)
    assert read[:, :3].std() == pytest.approx(0.01, rel=0.15)
    np.testing.assert_allclose(long[:, :3].std(axis=0), 0.01, rtol=0.06)
    np.testing.assert_allclose(long[:, 3:].std(axis=0), 0.1, rtol=0.06)
    assert (abs(long.mean(axis=0)) < 4 * long.std(axis=0) / math.sqrt(5000)).all()


def test_a_bias_stays_and_differs_from_unit_to_unit():
    model = ImuModel((0.0, 0.0, 0.0), 200.0, 0.0, 0.0, gyro_bias=0.01, accel_bias=0.2)
    units = [Imu(model, np.random.default_rng(seed)) for seed in range(200)]
    first = np.array([unit.read(0, 0.0, 0.0, 0.0, 0.0) for unit in units]) - (0, 0, 0, 0, 0, GRAVITY)
    later = np.array([unit.read(999, 0.0, 0.0, 0.0, 0.0) for unit in units]) - (0, 0, 0, 0, 0, GRAVITY)
    np.testing.assert_allclose(first, later, atol=1e-12)
    assert first[:, :3].std() == pytest.approx(0.01, rel=0.12)
    assert first[:, 3:].std() == pytest.approx(0.2, rel=0.12)


def test_the_heading_is_the_integral_of_the_gyroscope():
    model = ImuModel((0.0, 0.0, 0.0), 200.0, 0.01, 0.0, gyro_bias=0.001)
    imu = Imu(model, np.random.default_rng(5))
    shown = [imu.read(i, 0.0, 0.3, 0.0, 0.0)[2] - 0.3 for i in range(1000)]
    again = Imu(model, np.random.default_rng(5))
    assert again.heading_error(999) == pytest.approx(sum(shown) / 200.0, abs=1e-12)


def test_samples_that_nobody_read_change_nothing():
    one, other = Imu(MODEL, np.random.default_rng(2)), Imu(MODEL, np.random.default_rng(2))
    for i in range(3 * BLOCK):
        one.read(i, 0.0, 0.0, 0.0, 0.0)
    assert one.read(3 * BLOCK + 7, 0.1, 0.0, 0.0, 0.0) == other.read(3 * BLOCK + 7, 0.1, 0.0, 0.0, 0.0)
