"""Stage's odometry: the truth, or a belief that drifts.

With `localization "gps"`, the default, a robot knows where it is in the world. With "odom" it adds up its own velocity (v, v_y, w) from where it started, and
is wrong by the same part of it all the time: with E its `odom_error`,

    e_x, e_y, e_a: even between -E/2 and E/2, drawn once, when it starts
    its belief goes on with ((1 + e_x) v, (1 + e_y) v_y, (1 + e_a) w)

as Stage's manual has it ("odom_error"). Stage adds up in steps of Euler's, one each `interval_sim`; here the arcs are exact. Two slips of Stage 4.3's
code are not followed: it takes the numbers of a file as e themselves, and the turn's as degrees; and it adds a way to the left as one to the right. As in
Stage, what counts is the velocity that the robot was told: when something holds it, its belief goes on.
"""

from __future__ import annotations

import numpy as np

from rosmini.geometry.poses import Pose, compose, inverse
from rosmini.sim.engine.drive import glide

from .robots import StageRobot

Velocity = tuple[float, float, float]
"""Ahead and to the left [m/s], and of turning to the left [rad/s]."""

STILL: Velocity = (0.0, 0.0, 0.0)


def draw_errors(robot: StageRobot, rng: np.random.Generator) -> Velocity:
    """The parts by which a robot's belief is wrong: e_x, e_y, e_a."""
    x, y, a = (rng.uniform(-0.5, 0.5, 3) * robot.odom_error).tolist()
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
        """Where the robot believes to be, if it is at `truth` really. The origin is the world's with "gps", whatever `localization_origin` says, as in Stage."""
        return truth if self.gps else self.belief
