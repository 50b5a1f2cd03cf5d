"""Stage's odometry: the truth, or a belief that drifts.

With `localization "gps"`, the default, a robot knows where it is in the world. With "odom" it adds up its own velocity (v, v_y, w) from where it started, and
is wrong by the same part of it all the time:

    its belief goes on with ((1 + e_x) v, (1 + e_y) v_y, (1 + e_a) w)

The numbers of `odom_error [x y z a]` are these e, each time the same; a is an angle to Stage, so that in a file in degrees 0.05 is e_a = 0.00087. A robot of which the
file does not say it draws them once, when it starts, even between -E/2 and E/2 with E = 0.03, 0.03 and 0.05. That is what Stage 4.3 does
(model_position.cc); its manual tells otherwise, that a file's numbers are E too.

Stage adds up in steps of Euler's, one each `interval_sim`; here the arcs are exact. One slip of its code is not followed: it adds a way to the left as one to
the right. As in Stage, what counts is the velocity that the robot was told: when something holds it, its belief goes on.
"""

from __future__ import annotations

import numpy as np

from rosmini.geometry.poses import Pose, compose, inverse
from rosmini.sim.engine.drive import glide

from .robots import StageRobot

Velocity = tuple[float, float, float]
"""Ahead and to the left [m/s], and of turning to the left [rad/s]."""

STILL: Velocity = (0.0, 0.0, 0.0)


LARGEST = (0.03, 0.03, 0.05)
"""E ahead, to the left and around: what is drawn is up to the half of it, to either side."""


def draw_errors(robot: StageRobot, rng: np.random.Generator) -> Velocity:
    """The parts by which a robot's belief is wrong: e_x, e_y, e_a."""
    drawn = (rng.uniform(-0.5, 0.5, 3) * LARGEST).tolist()
    x, y, a = (own if told is None else told for told, own in zip(robot.odom_error, drawn, strict=True))
    return (x, y, a)


class StageOdometry:
    """What one robot believes about where it is."""

    def __init__(self, robot: StageRobot, rng: np.random.Generator) -> None:
        self.gps = robot.localization == "gps"
        self.errors = draw_errors(robot, rng)
        self.velocity: Velocity = STILL
        """What it was told, within its bounds."""
        self.belief: Pose = compose(inverse(robot.localization_origin), robot.pose)
        self._since = 0.0

    def advance(self, now: float) -> None:
        """Add up the way until `now` [s]."""
        if now > self._since:
            if any(self.velocity):
                e = self.errors
                v, aside, w = self.velocity
                real = (v * (1 + e[0]), aside * (1 + e[1]), w * (1 + e[2]))
                self.belief = glide(self.belief, real, STILL, now - self._since)
            self._since = now

    def told(self, velocity: Velocity, now: float) -> None:
        """Go on with another velocity from `now` on."""
        self.advance(now)
        self.velocity = velocity

    def pose(self, truth: Pose) -> Pose:
        """Where the robot believes to be, if it is at `truth` really. The origin is the world's with "gps", whatever `localization_origin` says, as in Stage's code, but not in its manual."""
        return truth if self.gps else self.belief
