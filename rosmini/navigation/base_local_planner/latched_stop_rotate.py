"""Commands at the goal: stop, then turn to its heading. The algorithm of `LatchedStopRotateController`."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.poses import Pose
from rosmini.navigation.nav_core import ControlFailure

from .goal_functions import distance_to_goal, is_stopped, turn_to_goal
from .limits import LocalPlannerLimits

Floats = NDArray[np.float64]
Check = Callable[[Floats], str]
"""Returns the reason why a velocity (3) is not allowed; empty if it is allowed."""


@dataclass
class LatchedStopRotate:
    """Decides whether the goal is reached, and commands the stop and the final rotation."""

    latch: bool = False
    """`latch_xy_goal_tolerance`: having reached the position once is sufficient."""
    reached: bool = False
    rotating: bool = False

    def reset(self) -> None:
        """Forget that the position was reached, for a new plan."""
        self.reached = False

    def is_position_reached(self, pose: Pose, goal: Pose, limits: LocalPlannerLimits) -> bool:
        """Return whether the robot is within tolerance of the goal's position or, with `latch`, has been."""
        if (self.latch and self.reached) or distance_to_goal(pose, goal) <= limits.xy_goal_tolerance:
            self.reached = True
            return True
        return False

    def is_goal_reached(self, pose: Pose, velocity: Floats, goal: Pose, limits: LocalPlannerLimits) -> bool:
        """Return whether the robot, moving at `velocity` (3,), has reached position and heading and has stopped."""
        if not ((self.latch and self.reached) or distance_to_goal(pose, goal) <= limits.xy_goal_tolerance):
            return False
        self.reached = self.reached or self.latch
        return abs(turn_to_goal(pose, goal)) <= limits.yaw_goal_tolerance and is_stopped(
            velocity, limits.theta_stopped_vel, limits.trans_stopped_vel
        )

    def command(
        self, pose: Pose, velocity: Floats, goal: Pose, limits: LocalPlannerLimits, period: float, why_not: Check
    ) -> Floats:
        """Return the velocity (3) to command at the goal; `period` [s] is the time between two commands.

        Raises `ControlFailure` if the robot cannot brake or turn there without a collision.
        """
        turn = turn_to_goal(pose, goal)
        if abs(turn) <= limits.yaw_goal_tolerance:
            self.rotating = False
            return np.zeros(3)
        if not self.rotating and not is_stopped(velocity, limits.theta_stopped_vel, limits.trans_stopped_vel):
            return checked(decelerated(velocity, limits.accelerations, period), why_not, "Stopping cmd in collision")
        self.rotating = True
        most, least = limits.max_vel_theta, limits.min_vel_theta
        speed = min(most, max(least, abs(turn)))
        speed = reachable_turn_speed(speed, turn, float(velocity[2]), limits.acc_lim_theta, period)
        speed = min(most, max(least, speed))
        return checked(np.array([0.0, 0.0, math.copysign(speed, turn)]), why_not, "Rotation cmd in collision")


def decelerated(velocity: Floats, accelerations: Floats, period: float) -> Floats:
    """Return the velocity (3) after braking at the maximum deceleration for one period."""
    return np.sign(velocity) * np.maximum(0.0, np.abs(velocity) - accelerations * period)


def reachable_turn_speed(speed: float, turn: float, now: float, acceleration: float, period: float) -> float:
    """Return the turning speed nearest to `speed` within reach in one period, limited so that the robot can still stop.

    `turn` [rad] is the rotation left, at the end of which the robot must stop; `now` [rad/s] is its turning speed.
    """
    speed = min(max(abs(speed), abs(now) - acceleration * period), abs(now) + acceleration * period)
    return min(math.sqrt(2 * acceleration * abs(turn)), abs(speed))


def checked(command: Floats, why_not: Check, text: str) -> Floats:
    """Return the command (3,) if `why_not(command)` returns no reason against it.

    Raises `ControlFailure` otherwise, with a message that consists of `text`, the command and the reason.
    """
    reason = why_not(command)
    if not reason:
        return command
    x, y, theta = (round(float(value), 3) + 0.0 for value in command)
    raise ControlFailure(
        f"{text}: at the goal the robot would drive {x} m/s ahead, {y} m/s to the left and turn by {theta} rad/s, but "
        f"{reason}",
        command=(x, y, theta),
    )
