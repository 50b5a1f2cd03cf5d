"""Odometry: where a robot believes to be by the turns of its wheels, and perhaps by a gyroscope.

Each encoder counts ticks, N a turn. From the ticks since the last time the wheels' ways are d = r 2 pi ticks / N, and
then

    ds = (d_left + d_right) / 2,   dtheta = (d_right - d_left) / b
    x += ds cos(theta + dtheta / 2),   y += ds sin(theta + dtheta / 2),   theta += dtheta

TurtleBot3's firmware does so 30 times a second (`calcOdometry` of `turtlebot3_core` in
https://github.com/ROBOTIS-GIT/OpenCR), but for one thing: it takes dtheta from the orientation that its IMU
tells, and the line with the wheels is commented out. Its v is ds / dt, and its w dtheta / dt. (It does not
wrap the difference of two orientations, so one step goes wrong each time its heading passes 180 degrees; here
none does.) Gazebo's plugin takes the wheels.

r and b are the numbers on paper. The real wheels are a little larger, smaller or farther apart, and they
slip: so the belief drifts away from the truth, without bound (Borenstein and Feng, Measurement and correction
of systematic odometry errors in mobile robots, IEEE Transactions on Robotics and Automation, 1996). A
gyroscope does not notice that wheels slip, but it drifts even while the robot stands: see
`rosmini.sim.sensors.imu`.
"""

from __future__ import annotations

import copy
import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from rosmini.core.geometry.poses import Pose
from rosmini.sim.models import RobotModel

SLIP_PERIOD = 1.0
"""How long a wheel's slip stays what it is [s]."""


def ticks(angle: float, ticks_per_turn: int) -> int:
    """What an encoder shows when its wheel has turned by `angle` [rad]: whole ticks, a started one does not count."""
    return math.floor(angle / (2 * math.pi) * ticks_per_turn)


def dead_reckoning(
    pose: Pose, left: float, right: float, separation: float, turn: float | None = None
) -> Pose:
    """The pose after the wheels have rolled `left` and `right` [m]: the equations above.

    `turn` [rad] is what something else says of dtheta.
    """
    x, y, theta = pose
    ds = (left + right) / 2
    if turn is None:
        turn = (right - left) / separation
    middle = theta + turn / 2
    return (x + ds * math.cos(middle), y + ds * math.sin(middle), theta + turn)


@dataclass
class Odometry:
    """The firmware's memory: what the encoders showed last, and what follows from it."""

    model: RobotModel
    pose: Pose = (0.0, 0.0, 0.0)
    """In the frame odom: where the robot was when it was switched on is 0."""
    v: float = 0.0
    w: float = 0.0
    left: float = 0.0
    """How far the left wheel has turned since it was switched on [rad], in whole ticks."""
    right: float = 0.0
    left_rate: float = 0.0
    """How fast the left wheel turned since the last time [rad/s]."""
    right_rate: float = 0.0
    _left_ticks: int = 0
    _right_ticks: int = 0

    def update(self, left_ticks: int, right_ticks: int, dt: float, turn: float | None = None) -> None:
        """Update with the encoders `dt` seconds later and, if there is a gyroscope, with its turn since then [rad]."""
        model = self.model
        tick = 2 * math.pi / model.ticks_per_turn
        left, right = (left_ticks - self._left_ticks) * tick, (right_ticks - self._right_ticks) * tick
        self._left_ticks, self._right_ticks = left_ticks, right_ticks
        before = self.pose[2]
        r = model.wheel_radius
        self.pose = dead_reckoning(self.pose, left * r, right * r, model.wheel_separation, turn)
        self.left, self.right = left_ticks * tick, right_ticks * tick
        self.left_rate, self.right_rate = left / dt, right / dt
        self.v, self.w = (left + right) / 2 * r / dt, (self.pose[2] - before) / dt


class RealWheels:
    """How one robot's wheels differ from the model's: `left` and `right` are metres on the ground per metre on paper.

    The radii and the separation are drawn once, the slip every `SLIP_PERIOD`. With `scale` 0 the wheels are those of
    the model.
    """

    def __init__(self, model: RobotModel, rng: np.random.Generator, scale: float = 1.0) -> None:
        errors = model.errors
        left, right, wide = (scale * rng.standard_normal(3)).tolist()
        self.separation = model.wheel_separation * (1 + errors.separation * wide)
        self._radii = (1 + errors.radius * left, 1 + errors.radius * right)
        self._slip = errors.slip * scale
        self._rng = rng
        self.left, self.right = self._radii
        self.slip()

    def slip(self) -> None:
        """Draw the slip of the next period."""
        if self._slip:
            left, right = (self._slip * self._rng.standard_normal(2)).tolist()
            self.left, self.right = self._radii[0] * (1 - left), self._radii[1] * (1 - right)

    def state(self) -> dict[str, Any]:
        """Everything about them, the generator of their slips included."""
        kept = {key: value for key, value in vars(self).items() if key != "_rng"}
        return {**kept, "generator": copy.deepcopy(self._rng.bit_generator.state)}

    def restore(self, state: dict[str, Any]) -> None:
        """Be as they were then."""
        for key, value in state.items():
            if key != "generator":
                setattr(self, key, value)
        self._rng.bit_generator.state = copy.deepcopy(state["generator"])
