"""An inertial measurement unit: angular velocity, acceleration and heading of the place where it sits.

At (x, y) from the middle of the axle, of a robot with the speed v ahead and w to the left and their rates dv and dw, the acceleration is

    a_x = dv - x w^2 - y dw,   a_y = v w + x dw - y w^2,   a_z = g

and if it goes to its left too, with u and its rate du, then - u w and du come on top of these (a_z points up at rest: REP 145,
https://www.ros.org/reps/rep-0145.html). To each comes white noise, and a bias that stays: a gyroscope that shows 0.00001 rad/s at rest has turned by 2 degrees after an hour. The heading is the integral of what the gyroscope shows, from 0 on.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rosmini.sim.models import ImuModel

BLOCK = 256
"""So many samples' noise is drawn at once."""


class Motion(NamedTuple):
    """How a robot moves at one moment: speeds ahead [m/s] and to the left [rad/s], and their rates."""

    v: float
    w: float
    dv: float
    dw: float


def acceleration(
    x: float, y: float, v: float, w: float, dv: float, dw: float, aside: tuple[float, float] = (0.0, 0.0)
) -> tuple[float, float]:
    """The acceleration ahead and to the left [m/s2] at the place (x, y) of a robot that moves so: the equations above.

    `aside` is its speed to its left side [m/s] and how fast that changes [m/s2].
    """
    ahead, left = dv - x * w * w - y * dw, v * w + x * dw - y * w * w
    if aside == (0.0, 0.0):
        return (ahead, left)
    return (ahead - aside[0] * w, left + aside[1])


class Imu:
    """One unit with its biases. Sample k always gets the same noise, whether the samples before it were read or not."""

    def __init__(self, model: ImuModel, rng: np.random.Generator, scale: float = 1.0) -> None:
        self.model = model
        self._mount = model.mount
        self._rng = rng
        self._scale = scale
        gyro, accel = scale * model.gyro_bias, scale * model.accel_bias
        self.bias: list[float] = (rng.standard_normal(6) * ([gyro] * 3 + [accel] * 3)).tolist()
        self._noise: list[list[float]] = []
        self._first = self._end = 0
        self._deviations = np.array([model.gyro_noise] * 3 + [model.accel_noise] * 3) * scale
        self._drift = 0.0
        self._drifts: list[float] = []

    def read(
        self,
        number: int,
        v: float,
        w: float,
        dv: float,
        dw: float,
        aside: tuple[float, float] = (0.0, 0.0),
    ) -> tuple[float, float, float, float, float, float]:
        """Sample `number`, counted from 0 and never backwards: angular velocities x, y, z [rad/s] and accelerations x, y, z [m/s2]."""
        return self.measure(number, v, w, dv, dw, aside)[:6]

    def measure(
        self,
        number: int,
        v: float,
        w: float,
        dv: float,
        dw: float,
        aside: tuple[float, float] = (0.0, 0.0),
    ) -> tuple[float, float, float, float, float, float, float]:
        """What `read` returns, and after it what `heading_error` does."""
        x, y, _ = self._mount
        ax, ay = acceleration(x, y, v, w, dv, dw, aside)
        if not self._scale:
            return (0.0, 0.0, w, ax, ay, self.model.gravity, 0.0)
        if number >= self._end:
            self._draw(number)
        place = number - self._first
        e = self._noise[place]
        return (e[0], e[1], w + e[2], ax + e[3], ay + e[4], self.model.gravity + e[5], self._drifts[place])

    def heading_error(self, number: int) -> float:
        """By how much the integral of what the gyroscope showed, up to sample `number`, differs from the turn of the robot [rad]."""
        if not self._scale:
            return 0.0
        if number >= self._end:
            self._draw(number)
        return self._drifts[number - self._first]

    def _draw(self, number: int) -> None:
        """Draw the blocks up to that of sample `number`."""
        while number >= self._end:
            block = self._rng.standard_normal((BLOCK, 6)) * self._deviations + self.bias
            drifts = self._drift + np.cumsum(block[:, 2]) / self.model.rate
            self._noise, self._drifts, self._drift = block.tolist(), drifts.tolist(), float(drifts[-1])
            self._first, self._end = self._end, self._end + BLOCK
