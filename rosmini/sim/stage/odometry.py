"""Stage's odometry: the truth, or a belief that drifts.

With `localization "gps"`, the default, a robot knows its pose in the world. With "odom" it integrates its own velocity
(v, v_y, w) from where it started, and is wrong by a constant part of it:

    its belief goes on with ((1 + e_x) v, (1 + e_y) v_y, (1 + e_a) w)

The numbers of `odom_error [x y z a]` are these e; a is an angle to Stage, so that in a file in degrees 0.05 is e_a =
0.00087. A robot without them in the file draws them once, when it starts, uniformly between -E/2 and E/2 with E =
0.03, 0.03 and 0.05. That is what Stage 4.3 does (model_position.cc); its manual says that a file's numbers are E too.

Stage integrates by Euler's method, once each `interval_sim`; here the arcs are exact. One slip of its code is not
followed: it adds a way to the left as one to the right. As in Stage, the commanded velocity counts: when something
holds the robot, its belief goes on.
"""

from __future__ import annotations

import numpy as np

from rosmini.core.geometry.poses import Pose, compose, inverse
from rosmini.sim.engine.free_motion import glide

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
        """Where the robot believes it is, if it really is at `truth`.

        With "gps" the origin is the world's, whatever `localization_origin` says: as in Stage's code, not as in its
        manual.
        """
        return truth if self.gps else self.belief
