"""Stage's odometry: the true pose, or an estimate that drifts.

With `localization "gps"`, the default, a robot knows its pose in the world. With "odom" it integrates its own velocity
(v, v_y, w) from its start, with a constant relative error:

  the estimate advances with ((1 + e_x) v, (1 + e_y) v_y, (1 + e_a) w)

The numbers of `odom_error [x y z a]` are these e; Stage treats a as an angle, so in a file in degrees 0.05 means e_a =
0.00087. A robot without them in the file draws them once, at its start, uniformly between -E/2 and E/2 with E =
0.03, 0.03 and 0.05. Stage 4.3 does this (model_position.cc); its manual says that a file's numbers are E too.

Stage integrates by Euler's method, once per `interval_sim`; here the arcs are exact. One mistake in its code is not
reproduced: it adds a motion to the left as one to the right. As in Stage, the commanded velocity is used: if an
obstacle stops the robot, the estimate continues.
"""

from __future__ import annotations

import numpy as np

from rosmini.core.geometry.poses import Pose, compose, inverse
from rosmini.sim.engine.free_motion import glide

from .robots import StageRobot

Velocity = tuple[float, float, float]
"""Speeds ahead and to the left [m/s], and rate of turn to the left [rad/s]."""

STILL: Velocity = (0.0, 0.0, 0.0)


MAX_ERRORS = (0.03, 0.03, 0.05)
"""E ahead, to the left and in turns: errors are drawn up to half of it in either direction."""


def draw_errors(robot: StageRobot, rng: np.random.Generator) -> Velocity:
    """Return the relative errors of a robot's estimate: e_x, e_y, e_a."""
    drawn = (rng.uniform(-0.5, 0.5, 3) * MAX_ERRORS).tolist()
    x, y, a = (own if told is None else told for told, own in zip(robot.odom_error, drawn, strict=True))
    return (x, y, a)


class StageOdometry:
    """The estimated pose of one robot."""

    def __init__(self, robot: StageRobot, rng: np.random.Generator) -> None:
        self.gps = robot.localization == "gps"
        self.errors = draw_errors(robot, rng)
        self.velocity: Velocity = STILL
        """The commanded velocity, within its bounds."""
        self.belief: Pose = compose(inverse(robot.localization_origin), robot.pose)
        self._since = 0.0

    def advance(self, now: float) -> None:
        """Integrate the motion until `now` [s]."""
        if now > self._since:
            if any(self.velocity):
                e = self.errors
                v, aside, w = self.velocity
                real = (v * (1 + e[0]), aside * (1 + e[1]), w * (1 + e[2]))
                self.belief = glide(self.belief, real, STILL, now - self._since)
            self._since = now

    def set_velocity(self, velocity: Velocity, now: float) -> None:
        """Continue with another velocity from `now` on."""
        self.advance(now)
        self.velocity = velocity

    def pose(self, truth: Pose) -> Pose:
        """Return the robot's estimated pose, given its true pose `truth`.

        With "gps" the origin is the world's, whatever `localization_origin` is: as in Stage's code, but not as in its
        manual.
        """
        return truth if self.gps else self.belief
