"""An inertial measurement unit: angular velocity, acceleration and heading at its mount.

At (x, y) relative to the middle of the axle, for a robot with the speed v ahead and the turn w to the left, and their
rates dv and dw, the acceleration is

    a_x = dv - x w^2 - y dw,   a_y = v w + x dw - y w^2,   a_z = g

and with a speed u to its left, at the rate du, - u w and du are added to these (a_z points up at rest:
REP 145, https://www.ros.org/reps/rep-0145.html). White noise and a constant bias are added to each. The gyroscope shows
(1 + s) w of a turn, and the heading is the integral of its output: Madgwick's filter without a magnetometer, which
TurtleBot3's board runs, has no other information about the heading of a robot on flat ground (`IMU.cpp` and
`MadgwickAHRS.cpp` in https://github.com/ROBOTIS-GIT/OpenCR). So after t seconds and a turn by a, the heading's error is

    s a + b t + n,   n ~ N(0, sigma^2 t / f)

with the scale error s, the bias b, and the deviation sigma of one of f samples a second. That board calibrates the
gyroscope when a connection is made, and on the topic `reset`: it takes the mean of 512 samples as its zero, rounded
down to whole steps of the converter. The remaining b is between zero and one step, 0.061 degrees a second: so the
heading of a TurtleBot3 at rest drifts to the left (https://github.com/ROBOTIS-GIT/turtlebot3/issues/819). The
values of sigma, of the step and of the largest s are published; we assume that s is normal, with a third of the
largest as deviation. Temperature, which changes b, the chip's low-pass filter, and tilts are left out.
"""

from __future__ import annotations

import math
from struct import Struct
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rosmini.sim.models import ImuModel

Floats = NDArray[np.float64]

BLOCK = 256
"""Number of samples whose noise is drawn at once."""

ROW = Struct("7d")
"""One sample: the noise and biases of the gyroscope and the accelerometer, and the drift of the heading."""

FINEST = 2.0**-22
"""Resolution of a heading [rad]: the board computes with 32-bit numbers."""

CALIBRATION = 512
"""Number of samples averaged for a gyroscope's zero: MPU_CALI_COUNT of TurtleBot3's firmware."""


class Motion(NamedTuple):
    """A robot's motion at one moment: speed ahead [m/s], turn to the left [rad/s], and their rates."""

    v: float
    w: float
    dv: float
    dw: float


def acceleration(
    x: float, y: float, v: float, w: float, dv: float, dw: float, aside: tuple[float, float] = (0.0, 0.0)
) -> tuple[float, float]:
    """Return the acceleration ahead and to the left [m/s2] at (x, y) on a moving robot: the equations above.

    `aside` is its speed to its left side [m/s] and the rate of that [m/s2].
    """
    ahead, left = dv - x * w * w - y * dw, v * w + x * dw - y * w * w
    if aside == (0.0, 0.0):
        return (ahead, left)
    return (ahead - aside[0] * w, left + aside[1])


class Imu:
    """A unit with its biases. Sample k always gets the same noise, whether or not earlier samples were read."""

    def __init__(self, model: ImuModel, rng: np.random.Generator, scale: float = 1.0) -> None:
        self.model = model
        self._mount = model.mount
        self._rng = rng
        self._scale = scale
        gyro, accel = scale * model.gyro_bias, scale * model.accel_bias
        self.bias: list[float] = (rng.standard_normal(6) * ([gyro] * 3 + [accel] * 3)).tolist()
        self._rows = b""
        """A `ROW` for each sample from `_first` to before `_end`; takes a fifth of the memory of lists."""
        self._first = self._end = 0
        self._deviations = np.array([model.gyro_noise] * 3 + [model.accel_noise] * 3) * scale
        self._drift = 0.0
        # a separate generator, so that the noise depends neither on the scale nor on calibrations
        self._unit = rng.spawn(1)[0]
        self.scale = 1.0 + scale * model.gyro_scale * float(self._unit.standard_normal())
        """Ratio of the measured to the true turn."""
        self._step = scale * model.gyro_step
        self._offset: Floats = self._step * self._unit.random(3)
        self._zero = np.zeros(3)
        self._shift(-1, self._offset)
        self.calibrate(-1)

    def calibrate(self, number: int, w: float = 0.0) -> None:
        """Take the gyroscope's current output as its zero, in whole steps, from the sample after `number` on.

        The robot should be at rest: a turn of `w` [rad/s] becomes part of the zero. The real unit takes two and a half
        seconds for it, this one no time.
        """
        if self._step:
            shown = self._offset + self._unit.standard_normal(3) * self._deviations[:3] / math.sqrt(CALIBRATION)
            shown[2] += w * self.scale
            zero = np.floor(shown / self._step) * self._step
            self._shift(number, self._zero - zero)
            self._zero = zero

    def _shift(self, number: int, more: Floats) -> None:
        """Add this bias [rad/s] to the gyroscope's output after sample `number`."""
        self.bias[:3] = (np.array(self.bias[:3]) + more).tolist()
        if self._rows:
            rows = np.frombuffer(self._rows).reshape(-1, 7).copy()
            start = max(number + 1 - self._first, 0)
            rows[start:, :3] += more
            rows[start:, 6] += more[2] * np.arange(self._first + start - number, self._end - number) / self.model.rate
            self._rows, self._drift = rows.tobytes(), float(rows[-1, 6])

    def sample(
        self,
        number: int,
        turned: float,
        v: float,
        w: float,
        dv: float,
        dw: float,
        aside: tuple[float, float] = (0.0, 0.0),
    ) -> tuple[float, float, float, float, float, float, float]:
        """Return sample `number`, from 0 in ascending order.

        The sample contains the heading [rad] after a turn by `turned`, see `heading`; the angular velocities [rad/s]
        and the accelerations [m/s2] along x, y and z.
        """
        x, y, _ = self._mount
        ax, ay = acceleration(x, y, v, w, dv, dw, aside)
        gravity = self.model.gravity
        if not self._scale:
            return (round(turned / FINEST) * FINEST, 0.0, 0.0, w, ax, ay, gravity)
        if number >= self._end:
            self._draw(number)
        ex, ey, ez, fx, fy, fz, drift = ROW.unpack_from(self._rows, (number - self._first) * ROW.size)
        heading = round((turned * self.scale + drift) / FINEST) * FINEST
        return (heading, ex, ey, w * self.scale + ez, ax + fx, ay + fy, gravity + fz)

    def heading(self, number: int, turned: float) -> float:
        """Return the integral [rad] of the gyroscope's output up to sample `number`, for a robot turned by `turned`.

        The result is a multiple of `FINEST`.
        """
        return self.sample(number, turned, 0.0, 0.0, 0.0, 0.0)[0]

    def _draw(self, number: int) -> None:
        """Draw the blocks up to the one with sample `number`."""
        while number >= self._end:
            block = self._rng.standard_normal((BLOCK, 6)) * self._deviations + self.bias
            drifts = self._drift + np.cumsum(block[:, 2]) / self.model.rate
            self._rows, self._drift = np.column_stack([block, drifts]).tobytes(), float(drifts[-1])
            self._first, self._end = self._end, self._end + BLOCK
