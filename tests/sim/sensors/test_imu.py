"""The inertial measurement unit: accelerations of a body that turns, noise, bias and drift."""

import math

import numpy as np
import pytest

from rosmini.sim.models import BURGER, GRAVITY, ImuModel
from rosmini.sim.sensors.imu import FINEST, Imu, acceleration

MODEL = BURGER.imu


def read(imu, number, v, w, dv, dw):
    """Return the angular velocities and the accelerations of a sample."""
    return imu.sample(number, 0.0, v, w, dv, dw)[1:]


def test_accelerations_of_a_turn():
    # v^2 / r towards the centre; and behind the axle a pull outwards
    assert acceleration(0.0, 0.0, 0.2, 0.5, 0.0, 0.0) == pytest.approx((0.0, 0.2 * 0.5))
    assert acceleration(-0.032, 0.0, 0.0, 2.0, 0.0, 0.0) == pytest.approx((0.032 * 4.0, 0.0))
    assert acceleration(-0.032, 0.0, 0.0, 0.0, 1.0, 3.0) == pytest.approx((1.0, -0.096))


def test_noise_over_fifty_seeds_has_the_stated_deviations():
    model = ImuModel((0.0, 0.0, 0.0), 200.0, 0.01, 0.1)
    short = np.array(
        [read(Imu(model, np.random.default_rng(seed)), i, 0.0, 0.0, 0.0, 0.0) for seed in range(50) for i in (0, 300)]
    )
    many = Imu(model, np.random.default_rng(7))
    long = np.array([read(many, i, 0.0, 0.0, 0.0, 0.0) for i in range(5000)]) - (0, 0, 0, 0, 0, GRAVITY)
    assert short[:, :3].std() == pytest.approx(0.01, rel=0.15)
    np.testing.assert_allclose(long[:, :3].std(axis=0), 0.01, rtol=0.06)
    np.testing.assert_allclose(long[:, 3:].std(axis=0), 0.1, rtol=0.06)
    assert (abs(long.mean(axis=0)) < 4 * long.std(axis=0) / math.sqrt(5000)).all()


def test_a_bias_stays_and_differs_from_unit_to_unit():
    model = ImuModel((0.0, 0.0, 0.0), 200.0, 0.0, 0.0, gyro_bias=0.01, accel_bias=0.2)
    units = [Imu(model, np.random.default_rng(seed)) for seed in range(200)]
    first = np.array([read(unit, 0, 0.0, 0.0, 0.0, 0.0) for unit in units]) - (0, 0, 0, 0, 0, GRAVITY)
    later = np.array([read(unit, 999, 0.0, 0.0, 0.0, 0.0) for unit in units]) - (0, 0, 0, 0, 0, GRAVITY)
    np.testing.assert_allclose(first, later, atol=1e-12)
    assert first[:, :3].std() == pytest.approx(0.01, rel=0.12)
    assert first[:, 3:].std() == pytest.approx(0.2, rel=0.12)


def test_the_heading_is_the_integral_of_the_gyroscope():
    model = ImuModel((0.0, 0.0, 0.0), 200.0, 0.01, 0.0, gyro_bias=0.001, gyro_scale=0.05)
    imu = Imu(model, np.random.default_rng(5))
    shown = sum(read(imu, i, 0.0, 0.3, 0.0, 0.0)[2] for i in range(1000)) / 200.0
    again = Imu(model, np.random.default_rng(5))
    assert again.heading(999, 0.3 * 1000 / 200.0) == pytest.approx(shown, abs=FINEST)
    assert abs(again.scale - 1.0) > 0.001


def test_its_scale_is_off_by_as_much_as_stated_from_unit_to_unit():
    scales = np.array([Imu(MODEL, np.random.default_rng(seed)).scale for seed in range(400)])
    assert scales.mean() == pytest.approx(1.0, abs=4 * 0.01 / 20)
    assert scales.std() == pytest.approx(0.01, rel=0.15)


def test_a_calibrated_gyroscope_shows_up_to_one_step_at_rest():
    biases = np.array([Imu(MODEL, np.random.default_rng(seed)).bias[:3] for seed in range(400)]) / MODEL.gyro_step
    blur = 4 * MODEL.gyro_noise / MODEL.gyro_step / math.sqrt(512)
    assert -blur < biases.min() and biases.max() < 1 + blur
    assert biases.mean() == pytest.approx(0.5, abs=0.04)
    assert biases.std() == pytest.approx(1 / math.sqrt(12), rel=0.1)


def test_where_the_step_is_fine_the_error_of_the_heading_is_a_walk():
    model = ImuModel((0.0, 0.0, 0.0), 200.0, 0.01, 0.0)
    ends = np.array([Imu(model, np.random.default_rng(seed)).heading(1999, 0.0) for seed in range(300)])
    assert ends.std() == pytest.approx(0.01 * math.sqrt(10.0 / 200.0), rel=0.12)


def test_calibrating_changes_the_zero_from_then_on_and_nothing_before():
    one, other = (Imu(MODEL, np.random.default_rng(3)) for _ in range(2))
    assert read(one, 300, 0.0, 0.0, 0.0, 0.0) == read(other, 300, 0.0, 0.0, 0.0, 0.0)
    other.calibrate(300, 0.5)  # while it turns: that rate is rest from now on, but for less than a step
    assert one.heading(300, 0.0) == other.heading(300, 0.0)
    off = [other.bias[axis] - one.bias[axis] for axis in range(3)]
    assert off[2] == pytest.approx(-0.5 * other.scale, abs=1.2 * MODEL.gyro_step)
    for number in (301, 500, 520, 700, 1100):
        a, b = read(one, number, 0.0, 0.0, 0.0, 0.0), read(other, number, 0.0, 0.0, 0.0, 0.0)
        np.testing.assert_allclose(np.subtract(b, a), [*off, 0.0, 0.0, 0.0], atol=1e-12)
        drift = other.heading(number, 0.0) - one.heading(number, 0.0)
        assert drift == pytest.approx(off[2] * (number - 300) / MODEL.rate, abs=2 * FINEST)
