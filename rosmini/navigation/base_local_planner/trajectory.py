"""The sampled trajectories of one cycle, with each critic's scores and the reasons for rejection."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Samples:
    """n simulated trajectories, as arrays.

    A critic's raw score is its score before scaling; a negative one rejects the trajectory and is one of ROS's codes.
    The scores of later critics for a rejected trajectory are kept.
    """

    critics: tuple[str, ...]
    """Names of the critics (k), in order of application."""
    scales: Floats
    """Weights of the critics (k); a critic with weight 0 is not applied."""
    velocities: Floats
    """The sampled velocities (n, 3): x [m/s], y [m/s], theta [rad/s]."""
    commands: Floats
    """The commands for these samples (n, 3)."""
    points: Floats
    """The poses (n, s, 3) in the costmap's frame; only the first `lengths[n]` are valid."""
    lengths: Ints
    """Number of points of each trajectory (n)."""
    raw: Floats
    """The raw score from each critic (n, k)."""
    where: Ints
    """The point at which a critic rejected the trajectory (n, k), or -1."""
    totals: Floats
    """The costs (n): the weighted sum, or the negative code of the critic that rejected the trajectory."""
    rejected_by: Ints
    """The index of that critic (n), or -1."""
    best: int | None = None
    """Index of the chosen trajectory."""
    refused: int = 0
    """Number of velocities that were not simulated because they are too slow or too fast for the robot."""
    pose: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """The robot's pose in the costmap's frame."""

    def __len__(self) -> int:
        return len(self.totals)

    def trajectory(self, number: int) -> Floats:
        """Return the poses (s, 3) of a trajectory."""
        return self.points[number, : self.lengths[number]]

    @property
    def accepted(self) -> NDArray[np.bool_]:
        """True for each trajectory (n) that no critic rejected."""
        return self.rejected_by < 0

    def counts(self) -> dict[str, int]:
        """Return each critic's number of rejections, if not 0; `generator` counts the velocities not simulated."""
        found = {name: int((self.rejected_by == i).sum()) for i, name in enumerate(self.critics)}
        return {name: count for name, count in {**found, "generator": self.refused}.items() if count}

    def reason(self, number: int) -> str:
        """Return the reason why a trajectory was rejected; empty if it was not."""
        critic = int(self.rejected_by[number])
        if critic < 0:
            return ""
        at = int(self.where[number, critic])
        place = f" at point {at + 1} of {int(self.lengths[number])}" if at >= 0 else ""
        words = REASONS.get((self.critics[critic], int(self.raw[number, critic])), "rejected")
        return f"{self.critics[critic]}: {words}{place}"


REASONS: dict[tuple[str, int], str] = {
    ("oscillation", -5): "it would go back where the robot has just come from",
    ("obstacle", -1): "the footprint meets an obstacle",
    ("obstacle", -2): "the footprint meets unknown cells",
    ("obstacle", -3): "the footprint leaves the local costmap",
    ("path", -2): "no path leads from there to the plan",
    ("path", -3): "its centre enters an obstacle",
    ("path", -4): "it leaves the local costmap",
    ("goal", -2): "no path leads from there to the local goal",
    ("goal", -3): "its centre enters an obstacle",
    ("goal", -4): "it leaves the local costmap",
    ("goal_front", -4): "its nose leaves the local costmap",
    ("alignment", -4): "its nose leaves the local costmap",
}
"""Meanings of the critics' negative scores. (ROS has -6 for every obstacle; here the code names its kind.)"""


def concatenated(first: Samples, *others: Samples, best: int | None = None) -> Samples:
    """Return all samples in one object; `best` is the index of the chosen one in the result."""
    parts = [first, *others]
    most = max(part.points.shape[1] for part in parts)
    points = [np.pad(part.points, ((0, 0), (0, most - part.points.shape[1]), (0, 0))) for part in parts]

    def stacked(name: str) -> Any:
        return np.concatenate([getattr(part, name) for part in parts])

    return Samples(
        first.critics,
        first.scales,
        stacked("velocities"),
        stacked("commands"),
        np.concatenate(points),
        stacked("lengths"),
        stacked("raw"),
        stacked("where"),
        stacked("totals"),
        stacked("rejected_by"),
        best,
        sum(part.refused for part in parts),
        first.pose,
    )
