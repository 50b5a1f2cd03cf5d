"""The critics that look at velocities alone, and how the numbers of all are put together.

Those that look at the points (obstacle, map grids) are in the kernel: `rosmini.navigation.base_local_planner.rollout`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.poses import Pose

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

GOES_BACK = -5.0
"""What the oscillation critic gives what it rejects."""


@dataclass
class Oscillation:
    """Rejects what goes back where the robot has just come from: forwards and backwards, left and right.

    As soon as the sign of a velocity has changed twice, only the later sign is allowed, until the robot has moved by
    `reset_distance` [m] or turned by `reset_angle` [rad].
    """

    reset_distance: float = 0.05
    reset_angle: float = 0.2
    last: list[int] = field(default_factory=lambda: [0, 0, 0])
    """The sign of the last velocity that was not 0, of x, y and theta; 0: forgotten."""
    allowed: list[int] = field(default_factory=lambda: [0, 0, 0])
    """The only sign that is allowed; 0: both."""
    stood_at: Pose = (0.0, 0.0, 0.0)

    def score(self, commands: Floats) -> Floats:
        """0 or `GOES_BACK` for each command (n, 3)."""
        wrong = (np.sign(commands) * np.asarray(self.allowed) < 0).any(axis=1)
        return np.where(wrong, GOES_BACK, 0.0)

    def update(self, pose: Pose, command: Floats, min_vel_trans: float) -> None:
        """Note the command that was chosen at `pose`."""
        if self._note(command, min_vel_trans):
            self.stood_at = pose
        if any(self.allowed):
            x, y, theta = (now - then for now, then in zip(pose, self.stood_at, strict=True))
            if math.hypot(x, y) > self.reset_distance or abs(theta) > self.reset_angle:
                self.reset()

    def _note(self, command: Floats, min_vel_trans: float) -> bool:
        changed = self._turned(0, command[0])
        if abs(command[0]) <= min_vel_trans:
            # Turns and steps aside count only while it does not drive on.
            changed = self._turned(1, command[1]) | self._turned(2, command[2]) | changed
        return changed

    def _turned(self, axis: int, velocity: float) -> bool:
        sign = int(np.sign(velocity))
        if sign == 0:
            return False
        turned = self.last[axis] == -sign
        if turned:
            self.allowed[axis] = sign
        self.last[axis] = sign
        return turned

    def reset(self) -> None:
        """Allow everything."""
        self.last, self.allowed = [0, 0, 0], [0, 0, 0]


def twirling(commands: Floats) -> Floats:
    """How fast each command (n, 3) turns [rad/s]."""
    return np.abs(commands[:, 2])


def prefer_forward(commands: Floats, penalty: float = 1.0) -> Floats:
    """`penalty` for commands (n, 3) that reverse or hardly move; for others ten times how fast they turn."""
    x, turn = commands[:, 0], np.abs(commands[:, 2])
    return np.where((x < 0) | ((x < 0.1) & (turn < 0.2)), penalty, turn * 10)


def together(raw: Floats, scales: Floats) -> tuple[Floats, Ints]:
    """Costs (n) and the number of the critic that rejected each (n), -1 if none did, from what each gave (n, k).

    Critics are asked in order, and those of scale 0 are not: `SimpleScoredSamplingPlanner::scoreTrajectory`. The cost
    of a rejected one is what its critic gave.
    """
    asked = np.flatnonzero(scales != 0)
    if not len(asked):
        return np.zeros(len(raw)), np.full(len(raw), -1)
    given = raw[:, asked]
    against = given < 0
    first = np.argmax(against, axis=1)
    rejected = against.any(axis=1)
    totals = np.where(rejected, given[np.arange(len(raw)), first], (given * scales[asked]).sum(axis=1))
    return totals, np.where(rejected, asked[first], -1)
