"""A velocity smoother: commands that a robot can follow, out of commands that jump.

Between two outputs, T seconds apart, the speed ahead v and the turn w change by at most a T, with a limit a of each. If
the wanted change (dv, dw) is larger than that, it is shortened to

    s (dv, dw)   with   s = min(1, a_v T / |dv|, a_w T / |dw|),

so that both come to their targets along a straight line of the (v, w) plane, and the way that the robot draws keeps its
shape. Where a change takes a speed away from its target's sign, towards 0, the limit is a times the deceleration
factor. This is what `yocs_velocity_smoother` does (http://wiki.ros.org/yocs_velocity_smoother), with its parameters and
its rules of when an input has ended.
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
"""The typical time between two commands is the median of so many."""

PATIENCE, LONGEST = 3.0, 0.5
"""An input has ended after so many of these times, and after so many seconds at the latest."""

TRUST = (0.2, 2.0)
"""If the robot's speeds differ more than this from the last output [m/s, rad/s], it starts again from the robot's."""

FEEDBACK = ("none", "odometry", "commands")
"""Where the robot's speeds are from: nowhere, its odometry, or the commands that it gets in the end.

Their places are the numbers in ROS.
"""


@dataclass(frozen=True)
class Limits:
    """What a robot can follow; the defaults are those of `yocs_velocity_smoother`."""

    speed_v: float = 1.0
    """[m/s]"""
    speed_w: float = 5.0
    """[rad/s]"""
    accel_v: float = 0.5
    """[m/s2]"""
    accel_w: float = 2.5
    """[rad/s2]"""
    decel_factor: float = 1.0
    """By this factor it brakes harder than it accelerates."""


def limited(velocity: Velocity, limits: Limits) -> Velocity:
    """A velocity with each part cut to its limit."""
    v, w = velocity
    return (
        max(-limits.speed_v, min(limits.speed_v, v)),
        max(-limits.speed_w, min(limits.speed_w, w)),
    )


def towards(
    last: Velocity, target: Velocity, limits: Limits, dt: float, actual: Velocity | None = None
) -> Velocity:
    """The velocity after `last` on the way to `target`, `dt` seconds later.

    With `actual`, the robot's own velocity by its odometry, a robot that still goes the other way is braked.
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
    """The smoother's memory. Times are seconds of whatever clock, the same for all calls.

    Args:
        limits: what the robot can follow.
        period: from one output to the next [s].
        feedback: where the velocities of `measured` are from, one of `FEEDBACK`.

    """

    def __init__(self, limits: Limits | None = None, *, period: float = 0.05, feedback: str = "none") -> None:
        if not 0 < period < math.inf:
            raise RosminiError(
                f"the time between two outputs has to be a positive number of seconds, not {period}"
            )
        if feedback not in FEEDBACK:
            raise RosminiError(f"there is no feedback {feedback!r}; it is one of {', '.join(FEEDBACK)}")
        self.limits = limits or Limits()
        self.period = period
        self.feedback = feedback
        self.target: Velocity = (0.0, 0.0)
        self.output: Velocity = (0.0, 0.0)
        """What was told last."""
        self.measured: Velocity = (0.0, 0.0)
        """How fast the robot goes, by the feedback."""
        self.active = False
        """Whether commands are coming in."""
        self._heard = 0.0
        self._record: deque[float] = deque(maxlen=RECORD)

    def command(self, v: float, w: float, now: float) -> None:
        """Take a command. Raises `RosminiError` for what is no finite number."""
        if not (math.isfinite(v) and math.isfinite(w)):
            raise RosminiError(
                f"a velocity of {v} m/s and {w} rad/s cannot be smoothed: both have to be finite"
            )
        self._record.append(now - self._heard)
        self._heard = now
        self.active = True
        self.target = limited((v, w), self.limits)

    @property
    def _typical(self) -> float:
        """The time between two commands [s]; a tenth until it is known."""
        return median(self._record) if len(self._record) > RECORD // 2 else 0.1

    def step(self, now: float) -> Velocity | None:
        """What is to be told the robot now; None if nothing comes in and it stands as it should.

        To be called every `period`.
        """
        silence, typical = now - self._heard, self._typical
        if self.active and typical > 0 and silence > min(PATIENCE * typical, LONGEST):
            self.active = False
            self.target = (0.0, 0.0)
        if self.feedback != "none" and self.active and typical > 0:
            off = any(
                abs(real - told) > most
                for real, told, most in zip(self.measured, self.output, TRUST, strict=True)
            )
            if off:
                self.output = self.measured
        if self.output == self.target and not self.active:
            return None
        actual = self.measured if self.feedback == "odometry" else None
        self.output = towards(self.output, self.target, self.limits, self.period, actual)
        return self.output
