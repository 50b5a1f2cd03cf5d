"""One robot of the engine: its pose, its wheels, and how they take it along."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rosmini.geometry.poses import Pose, transform_points

from .drive import Phase, body_velocity, phases, unicycle
from .imu import Motion
from .models import RobotModel
from .odometry import RealWheels, ticks

Floats = NDArray[np.float64]

WheelState = tuple[float, float, float, float]

ROUNDING = 1e-12
"""Speeds that differ by less [m/s] are the same."""


class Robot:
    """One robot: where it is, how fast its wheels turn, and what they were told."""

    def __init__(self, name: str, model: RobotModel, pose: Pose, wheels: RealWheels) -> None:
        self.name = name
        self.model = model
        self.pose = pose
        """The truth, in the frame map; the heading is not wrapped."""
        self.start = pose
        self.wheels = wheels
        self.stop()

    def stop(self) -> None:
        """Stand still, with encoders at zero and no command."""
        self.left = self.right = 0.0
        """How fast the wheels' rims go [m/s], if the wheels had the radius on paper."""
        self.left_target = self.right_target = 0.0
        """How fast they were told to go [m/s]."""
        self.left_way = self.right_way = 0.0
        """How far they have gone [m]."""
        self.expires = math.inf
        """When the command is too old [s]."""
        self.room = 0.0
        """How far it can move [m] before it has to be looked again whether anything is in its way."""
        self.touching = False
        """True while something keeps it from where its wheels would take it."""
        self.seen = (0.0, 0.0)
        """How fast it went, ahead [m/s] and to the left [rad/s], when that was last looked at."""
        self._rates = (0.0, 0.0)

    @property
    def standing(self) -> bool:
        """True while neither wheel turns nor is told to."""
        return self.left == self.right == self.left_target == self.right_target == 0.0

    @property
    def ticks(self) -> tuple[int, int]:
        """What the encoders of the left and the right wheel show."""
        r, n = self.model.wheel_radius, self.model.ticks_per_turn
        return (ticks(self.left_way / r, n), ticks(self.right_way / r, n))

    def motion(self) -> Motion:
        """How it really moves at this moment."""
        if self.touching:
            return Motion(*self.seen, *self._rates)
        wheels = self.wheels
        v, w = body_velocity(self.left * wheels.left, self.right * wheels.right, wheels.separation)
        if self.left == self.left_target and self.right == self.right_target:
            return Motion(v, w, 0.0, 0.0)
        a = self.model.wheel_acceleration
        dl = math.copysign(a, self.left_target - self.left) if self.left_target != self.left else 0.0
        dr = math.copysign(a, self.right_target - self.right) if self.right_target != self.right else 0.0
        return Motion(v, w, *body_velocity(dl * wheels.left, dr * wheels.right, wheels.separation))

    def corners(self) -> Floats:
        """The footprint (k, 2) where the robot is now."""
        return transform_points(self.pose, self.model.footprint)

    def wheel_state(self) -> WheelState:
        """The speeds and the ways of the left and right rim [m/s, m], to come back to."""
        return (self.left, self.right, self.left_way, self.right_way)

    def set_wheel_state(self, state: WheelState) -> None:
        """Come back to a state of the wheels."""
        self.left, self.right, self.left_way, self.right_way = state

    # -- for the engine ------------------------------------------------------------------------------------------

    def roll(self, dt: float) -> tuple[Pose, float]:
        """Turn the wheels for `dt` seconds; return where that takes the robot, and how far its farthest corner moves at most."""
        pose, moved = self.pose, 0.0
        if self.standing:
            return pose, moved
        wheels, reach = self.wheels, self.model.reach
        b, kl, kr = wheels.separation, wheels.left, wheels.right
        for h, al, ar in self._phases(dt):
            left, right = self.left, self.right
            v, w = (left * kl + right * kr) / 2, (right * kr - left * kl) / b
            if al or ar:
                dv, dw = (al * kl + ar * kr) / 2, (ar * kr - al * kl) / b
                self.left, self.right = left + al * h, right + ar * h
            else:
                dv = dw = 0.0
            pose = unicycle(pose, v, w, dv, dw, h)
            self.left_way += (left + self.left) / 2 * h
            self.right_way += (right + self.right) / 2 * h
            moved += max(abs(v), abs(v + dv * h)) * h + reach * max(abs(w), abs(w + dw * h)) * h
        return pose, moved

    def _phases(self, dt: float) -> list[Phase]:
        if self.left == self.left_target and self.right == self.right_target:
            return [(dt, 0.0, 0.0)]
        return phases(
            self.left, self.right, self.left_target, self.right_target, self.model.wheel_acceleration, dt
        )

    def settle(self) -> None:
        """Make a speed that has reached its target, but for the last digits, equal to it."""
        if abs(self.left - self.left_target) < ROUNDING:
            self.left = self.left_target
        if abs(self.right - self.right_target) < ROUNDING:
            self.right = self.right_target

    def note(self) -> None:
        """Remember how it moves now, to know later how that has changed."""
        self.seen = self.motion()[:2]

    def carried(self, pose: Pose, dt: float, *, touching: bool) -> None:
        """Learn where the robot really got to while it may have touched something, and note how fast it went."""
        x, y, theta = self.pose
        middle = (theta + pose[2]) / 2
        v = ((pose[0] - x) * math.cos(middle) + (pose[1] - y) * math.sin(middle)) / dt
        w = (pose[2] - theta) / dt
        self._rates = ((v - self.seen[0]) / dt, (w - self.seen[1]) / dt)
        self.seen = (v, w)
        self.pose = pose
        self.touching = touching
