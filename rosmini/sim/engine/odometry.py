"""Odometry: a robot's pose estimated from the rotation of its wheels, and optionally a gyroscope.

Each encoder counts N ticks per turn. From the ticks since the last update the wheels' distances are
d = r 2 pi ticks / N, and

    ds = (d_left + d_right) / 2,   dtheta = (d_right - d_left) / b
    x += ds cos(theta + dtheta / 2),   y += ds sin(theta + dtheta / 2),   theta += dtheta

TurtleBot3's firmware does this 30 times a second (`calcOdometry` of `turtlebot3_core` in
https://github.com/ROBOTIS-GIT/OpenCR), with one difference: it takes dtheta from the orientation that its IMU reports,
and the line that uses the wheels is commented out. Its v is ds / dt, and its w dtheta / dt. (It does not wrap the
difference of two orientations, so one step is wrong each time its heading passes 180 degrees; rosmini does not copy
this fault.) Gazebo's plugin uses the wheels.

r and b are nominal values. The real wheels are a little larger, smaller or farther apart, and they
slip: so the estimate drifts away from the truth, without bound (Borenstein and Feng, Measurement and correction
of systematic odometry errors in mobile robots, IEEE Transactions on Robotics and Automation, 1996). A
gyroscope is not affected by wheel slip, but it drifts even while the robot is at rest: see
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
"""Time between changes of a wheel's slip [s]."""


def ticks(angle: float, ticks_per_turn: int) -> int:
    """Return an encoder's count after its wheel has turned by `angle` [rad], rounded down to whole ticks."""
    return math.floor(angle / (2 * math.pi) * ticks_per_turn)


def dead_reckoning(pose: Pose, left: float, right: float, separation: float, turn: float | None = None) -> Pose:
    """Return the pose after the wheels have rolled `left` and `right` [m], by the equations of this module's docstring.

    `turn` [rad] overrides dtheta, for example with a gyroscope's value.
    """
    x, y, theta = pose
    ds = (left + right) / 2
    if turn is None:
        turn = (right - left) / separation
    middle = theta + turn / 2
    return (x + ds * math.cos(middle), y + ds * math.sin(middle), theta + turn)


@dataclass
class Odometry:
    """The firmware's odometry state: the last encoder counts and the quantities derived from them.

    `v` [m/s] and `w` [rad/s, to the left] are the robot's average speeds since the previous update.
    """

    model: RobotModel
    pose: Pose = (0.0, 0.0, 0.0)
    """In the odom frame [m, m, rad], whose origin is the robot's pose at power-on."""
    v: float = 0.0
    w: float = 0.0
    left: float = 0.0
    """Rotation of the left wheel since power-on [rad], in whole ticks."""
    right: float = 0.0
    left_rate: float = 0.0
    """Speed of the left wheel since the last update [rad/s]."""
    right_rate: float = 0.0
    _left_ticks: int = 0
    _right_ticks: int = 0

    def update(self, left_ticks: int, right_ticks: int, dt: float, turn: float | None = None) -> None:
        """Update from the encoder counts after `dt` seconds, and optionally the rotation by a gyroscope [rad]."""
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
    """One robot's real wheels; `left` and `right` are the distance on the ground per nominal distance.

    The radii and the separation are drawn once, the slip every `SLIP_PERIOD`. With `scale` 0 the wheels equal
    the model's.
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
        """Return the complete state, including the random generator of the slip."""
        kept = {key: value for key, value in vars(self).items() if key != "_rng"}
        return {**kept, "generator": copy.deepcopy(self._rng.bit_generator.state)}

    def restore(self, state: dict[str, Any]) -> None:
        """Restore what `state` returned."""
        for key, value in state.items():
            if key != "generator":
                setattr(self, key, value)
        self._rng.bit_generator.state = copy.deepcopy(state["generator"])
