"""A velocity smoother: converts commands with jumps to commands that a robot can follow.

Between two outputs, T seconds apart, the speed ahead v and the turn w change by at most a T, with a limit a each. If
the desired change (dv, dw) is larger, it is shortened to

    s (dv, dw)   with   s = min(1, a_v T / |dv|, a_w T / |dw|),

so that both approach their targets along a straight line in the (v, w) plane, and the robot's path keeps its
shape. If a change moves a speed away from its target's sign, towards 0, the limit is a times the deceleration
factor. This is the algorithm of `yocs_velocity_smoother` (http://wiki.ros.org/yocs_velocity_smoother), with its
parameters and its rules for the end of an input.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass
from statistics import median

from rosmini.core.errors import RosminiError

Velocity = tuple[float, float]
"""The speed ahead [m/s] and the turn to the left [rad/s]."""

RECORD = 5
"""Number of intervals whose median is the typical time between two commands."""

PATIENCE, MAX_SILENCE_S = 3.0, 0.5
"""An input has ended after this many typical intervals, and after this many seconds at the latest."""

TRUST = (0.2, 2.0)
"""Maximum difference between robot speed and last output [m/s, rad/s]; beyond it, restart from the robot's speed."""

FEEDBACK = ("none", "odometry", "commands")
"""Source of the robot's speeds: none, its odometry, or the commands that it finally receives.

The indices are the numbers in ROS.
"""


@dataclass(frozen=True)
class Limits:
    """Limits of a robot; the defaults are those of `yocs_velocity_smoother`."""

    speed_v: float = 1.0
    """Maximum speed [m/s]."""
    speed_w: float = 5.0
    """Maximum rate of turn [rad/s]."""
    accel_v: float = 0.5
    """Maximum acceleration [m/s2]."""
    accel_w: float = 2.5
    """Maximum angular acceleration [rad/s2]."""
    decel_factor: float = 1.0
    """Ratio of maximum deceleration to acceleration."""


def limited(velocity: Velocity, limits: Limits) -> Velocity:
    """Limit each part of a velocity."""
    v, w = velocity
    return (max(-limits.speed_v, min(limits.speed_v, v)), max(-limits.speed_w, min(limits.speed_w, w)))


def towards(last: Velocity, target: Velocity, limits: Limits, dt: float, actual: Velocity | None = None) -> Velocity:
    """Return the velocity `dt` seconds after `last` on the way to `target`.

    With `actual`, the robot's velocity by its odometry, a robot that still moves in the opposite direction is braked.
    """
    allowed = 1.0
    for now, wanted, accel, real in zip(
        last, target, (limits.accel_v, limits.accel_w), actual or (0.0, 0.0), strict=True
    ):
        change = wanted - now
        brakes = change * wanted <= 0 or real * wanted < 0
        most = accel * (limits.decel_factor if brakes else 1.0) * dt
        if abs(change) > most:
            allowed = min(allowed, most / abs(change))
    if allowed == 1.0:
        return target
    return (last[0] + allowed * (target[0] - last[0]), last[1] + allowed * (target[1] - last[1]))


class VelocitySmoother:
    """The state of the smoother. Times are seconds of any clock, the same one for all calls.

    Args:
        limits: the robot's limits.
        period: time between two outputs [s].
        feedback: the source of the velocities in `measured`, one of `FEEDBACK`.

    """

    def __init__(self, limits: Limits | None = None, *, period: float = 0.05, feedback: str = "none") -> None:
        if not 0 < period < math.inf:
            raise RosminiError(f"the time between two outputs must be a positive number of seconds, not {period}")
        if feedback not in FEEDBACK:
            raise RosminiError(f"there is no feedback {feedback!r}; it is one of {', '.join(FEEDBACK)}")
        self.limits = limits or Limits()
        self.period = period
        self.feedback = feedback
        self.target: Velocity = (0.0, 0.0)
        self.output: Velocity = (0.0, 0.0)
        """The last output."""
        self.measured: Velocity = (0.0, 0.0)
        """The robot's velocity according to the feedback."""
        self.active = False
        """True while commands arrive."""
        self._heard = 0.0
        self._record: deque[float] = deque(maxlen=RECORD)

    def command(self, v: float, w: float, now: float) -> None:
        """Set the target. Raises `RosminiError` for a number that is not finite."""
        if not (math.isfinite(v) and math.isfinite(w)):
            raise RosminiError(f"a velocity of {v} m/s and {w} rad/s cannot be smoothed: both must be finite")
        self._record.append(now - self._heard)
        self._heard = now
        self.active = True
        self.target = limited((v, w), self.limits)

    @property
    def _typical(self) -> float:
        """The typical time between two commands [s]; a tenth of a second until it is known."""
        return median(self._record) if len(self._record) > RECORD // 2 else 0.1

    def step(self, now: float) -> Velocity | None:
        """Return the next command for the robot; None if there is no input and the output has reached its target.

        Call it every `period`.
        """
        silence, typical = now - self._heard, self._typical
        if self.active and typical > 0 and silence > min(PATIENCE * typical, MAX_SILENCE_S):
            self.active = False
            self.target = (0.0, 0.0)
        if self.feedback != "none" and self.active and typical > 0:
            off = any(
                abs(real - told) > most for real, told, most in zip(self.measured, self.output, TRUST, strict=True)
            )
            if off:
                self.output = self.measured
        if self.output == self.target and not self.active:
            return None
        actual = self.measured if self.feedback == "odometry" else None
        self.output = towards(self.output, self.target, self.limits, self.period, actual)
        return self.output
