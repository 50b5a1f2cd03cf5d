"""The sampled trajectories of one cycle, with what each critic gave them or why they were rejected."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.graph.show import show

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Samples:
    """n trajectories that were driven in thought, as arrays.

    A critic's number is what it gave before its scale; a negative one rejects the trajectory, and says why in ROS's
    codes. What a later critic gave a rejected trajectory is kept, too.
    """

    critics: tuple[str, ...]
    """Their names (k), in the order in which they are asked."""
    scales: Floats
    """Their weights (k); one of weight 0 is not asked."""
    velocities: Floats
    """What was sampled (n, 3): x [m/s], y [m/s], theta [rad/s]."""
    commands: Floats
    """What would be commanded (n, 3)."""
    points: Floats
    """The poses (n, s, 3) in the costmap's frame, of which the first `lengths[n]` count."""
    lengths: Ints
    """Points of each (n)."""
    raw: Floats
    """What each critic gave (n, k)."""
    where: Ints
    """At which point a critic rejected it (n, k), -1 if at none."""
    totals: Floats
    """The costs (n): the scaled sum, or the negative code of the critic that rejected it."""
    rejected_by: Ints
    """The number of that critic (n), or -1."""
    best: int | None = None
    """Which one was chosen."""
    refused: int = 0
    """How many velocities were not driven: too slow to be followed, or faster than the robot may be."""
    pose: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Where the robot was."""

    def __len__(self) -> int:
        return len(self.totals)

    def trajectory(self, number: int) -> Floats:
        """The poses (s, 3) of one."""
        return self.points[number, : self.lengths[number]]

    @property
    def accepted(self) -> NDArray[np.bool_]:
        """Which of them no critic rejected (n)."""
        return self.rejected_by < 0

    def counts(self) -> dict[str, int]:
        """How many each critic rejected; critics that rejected none are left out. `generator`: what was not driven."""
        found = {name: int((self.rejected_by == i).sum()) for i, name in enumerate(self.critics)}
        return {name: count for name, count in {**found, "generator": self.refused}.items() if count}

    def explain(self, number: int) -> dict[str, float | None]:
        """What each critic added to the cost of one, scaled; None from the critic that rejected it, and `total`."""
        row: dict[str, float | None] = {
            name: None if self.raw[number, i] < 0 else float(self.raw[number, i] * self.scales[i])
            for i, name in enumerate(self.critics)
            if self.scales[i] != 0
        }
        row["total"] = float(self.totals[number]) if self.rejected_by[number] < 0 else None
        return row

    def reason(self, number: int) -> str:
        """Why one was rejected, in words; empty if it was not."""
        critic = int(self.rejected_by[number])
        if critic < 0:
            return ""
        at = int(self.where[number, critic])
        place = f" at point {at + 1} of {int(self.lengths[number])}" if at >= 0 else ""
        words = REASONS.get((self.critics[critic], int(self.raw[number, critic])), "rejects it")
        return f"{self.critics[critic]}: {words}{place}"

    def table(self, count: int = 8) -> str:
        """The `count` cheapest, and of each critic that rejected any the first one, with what each critic added.

        Columns that are 0 in all these rows are left out; below are the reasons of those that were rejected.
        """
        accepted = np.flatnonzero(self.accepted)
        cheapest = accepted[np.argsort(self.totals[accepted].round(6), kind="stable")][:count]
        rejected = [np.flatnonzero(self.rejected_by == critic)[:1] for critic in range(len(self.critics))]
        asked = [name for name, scale in zip(self.critics, self.scales, strict=True) if scale]
        rows, reasons = [["number", "x", "y", "theta", *asked, "total"]], []
        for number in (int(n) for n in np.concatenate([cheapest, *rejected])):
            row = self.explain(number)
            costs = ["-" if row[name] is None else _shown(row[name]) for name in [*asked, "total"]]
            rows.append([str(number), *map(_shown, self.commands[number]), *costs])
            if row["total"] is None:
                reasons.append(f"{number}: {self.reason(number)}")
        columns = [column for column in zip(*rows, strict=True) if {*column[1:]} != {"0.00"}]
        widths = [max(map(len, column)) for column in columns]
        lines = ("  ".join(map(str.rjust, row, widths)) for row in zip(*columns, strict=True))
        return "\n".join([*lines, *reasons])

    def nearest(self, x: float, y: float, theta: float) -> int:
        """The number of the sample whose velocity is most like this one.

        Raises `IndexError` if there are no samples.
        """
        if not len(self):
            raise IndexError("no trajectory was sampled")
        return int(np.argmin(np.abs(self.velocities - (x, y, theta)).sum(axis=1)))

    def show(self, **options: Any) -> Any:
        """Show the trajectories in a stepped player: see `rosmini.viz.stepped_pictures.trajectory_steps`."""
        return show("trajectories", self, **options)


def _shown(value: float | None) -> str:
    """Two decimals. The boundaries lie a little off the halves, so that they are the same on every machine."""
    return f"{(value or 0.0) + 3.7e-7:.2f}".replace("-0.00", "0.00")


REASONS: dict[tuple[str, int], str] = {
    ("oscillation", -5): "it would go back where the robot has just come from",
    ("obstacle", -1): "the footprint meets an obstacle",
    ("obstacle", -2): "the footprint meets unknown cells",
    ("obstacle", -3): "the footprint leaves the local costmap",
    ("path", -2): "no way leads from there to the plan",
    ("path", -3): "its centre enters an obstacle",
    ("path", -4): "it leaves the local costmap",
    ("goal", -2): "no way leads from there to the local goal",
    ("goal", -3): "its centre enters an obstacle",
    ("goal", -4): "it leaves the local costmap",
    ("goal_front", -4): "its nose leaves the local costmap",
    ("alignment", -4): "its nose leaves the local costmap",
}
"""What a critic's negative number means. (An obstacle's is -6 in ROS, whatever it is; here it says what was met.)"""


def joined(first: Samples, *others: Samples, best: int | None = None) -> Samples:
    """All of them together, with the number `best` of the one that was chosen."""
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
