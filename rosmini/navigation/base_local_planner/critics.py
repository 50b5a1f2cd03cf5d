"""The critics that depend on velocities alone, and the combination of all critics' costs.

The critics of points (obstacle, map grids) are in the kernel: `rosmini.navigation.base_local_planner.rollout`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.poses import Pose

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

OSCILLATING = -5.0
"""The score of trajectories that the oscillation critic rejects."""


@dataclass
class Oscillation:
    """Rejects velocities that undo the previous motion: forwards and backwards, left and right.

    Once the sign of a velocity has changed twice, only the later sign is allowed until the robot has moved by
    `reset_distance` [m] or turned by `reset_angle` [rad].
    """

    reset_distance: float = 0.05
    reset_angle: float = 0.2
    last: list[int] = field(default_factory=lambda: [0, 0, 0])
    """The sign of the last non-zero velocity in x, y and theta; 0 initially."""
    allowed: list[int] = field(default_factory=lambda: [0, 0, 0])
    """The only allowed sign in x, y and theta; 0 allows both."""
    reset_pose: Pose = (0.0, 0.0, 0.0)

    def score(self, commands: Floats) -> Floats:
        """Return 0 or `OSCILLATING` for each command (n, 3)."""
        forbidden = (np.sign(commands) * np.asarray(self.allowed) < 0).any(axis=1)
        return np.where(forbidden, OSCILLATING, 0.0)

    def update(self, pose: Pose, command: Floats, min_vel_trans: float) -> None:
        """Record the command (3) that was chosen at `pose`; allow all velocities if the robot has moved far enough.

        Sideways velocities and turns only count while the speed ahead is at most `min_vel_trans` [m/s].
        """
        if self._record(command, min_vel_trans):
            self.reset_pose = pose
        if any(self.allowed):
            x, y, theta = (now - then for now, then in zip(pose, self.reset_pose, strict=True))
            if math.hypot(x, y) > self.reset_distance or abs(theta) > self.reset_angle:
                self.reset()

    def _record(self, command: Floats, min_vel_trans: float) -> bool:
        changed = self._sign_changed(0, command[0])
        if abs(command[0]) <= min_vel_trans:
            # Turns and sideways steps count only while the robot is not driving ahead.
            changed = self._sign_changed(1, command[1]) | self._sign_changed(2, command[2]) | changed
        return changed

    def _sign_changed(self, axis: int, velocity: float) -> bool:
        sign = int(np.sign(velocity))
        if sign == 0:
            return False
        turned = self.last[axis] == -sign
        if turned:
            self.allowed[axis] = sign
        self.last[axis] = sign
        return turned

    def reset(self) -> None:
        """Allow all velocities, and forget the last signs."""
        self.last, self.allowed = [0, 0, 0], [0, 0, 0]


def twirling(commands: Floats) -> Floats:
    """Return the turning speed of each command (n, 3) [rad/s]."""
    return np.abs(commands[:, 2])


def combined_scores(raw: Floats, scales: Floats) -> tuple[Floats, Ints]:
    """Return the costs (n) for raw scores (n, k) of k critics, and the index (n) of the critic that rejects, or -1.

    Critics are applied in order, skipping those with scale 0 (`SimpleScoredSamplingPlanner::scoreTrajectory`). The cost
    of a rejected trajectory is the score of its critic.
    """
    used = np.flatnonzero(scales != 0)
    if not len(used):
        return np.zeros(len(raw)), np.full(len(raw), -1)
    given = raw[:, used]
    negative = given < 0
    first = np.argmax(negative, axis=1)
    rejected = negative.any(axis=1)
    totals = np.where(rejected, given[np.arange(len(raw)), first], (given * scales[used]).sum(axis=1))
    return totals, np.where(rejected, used[first], -1)
