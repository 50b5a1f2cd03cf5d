"""What the filter held after each scan, so that one can watch a map grow and particles die."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.poses import Pose
from rosmini.core.graph.show import show

from .extent import known
from .slam import GridSlam, Report

OCCUPIED = 0.25
"""A cell is occupied if more than this share of its visits were ends: the default of `occ_thresh`."""


class Frame(NamedTuple):
    """One moment."""

    time: float
    """[s]"""
    pose: Pose
    """Of the robot, as the best particle has it."""
    cells: NDArray[np.int8]
    """(h, w), the best particle's map: 0 free, 100 occupied, -1 unknown."""
    corner: tuple[float, float]
    """Of cell (0, 0) [m]."""
    branches: tuple[NDArray[np.float64], ...]
    """The paths of all particles, as `GridSlam.branches` has them."""
    report: Report


class Film:
    """Frames of a filter: `take` one after each scan that was taken in."""

    def __init__(self, slam: GridSlam, threshold: float = OCCUPIED) -> None:
        self.slam, self.threshold = slam, threshold
        self.frames: list[Frame] = []

    def take(self, report: Report) -> None:
        """Keep how it is now, after the scan that `GridSlam.process` reported."""
        slam = self.slam
        shares, extent = known(slam, slam.best)
        cells = np.where(shares < 0, -1, np.where(shares > self.threshold, 100, 0)).astype(np.int8)
        x, y, heading = slam.poses[slam.best].tolist()
        delta = slam.settings.delta
        corner = extent.column * delta, extent.row * delta
        time = slam.path()[-1].time
        self.frames.append(Frame(time, (x, y, heading), cells, corner, slam.branches(), report))

    @property
    def effective(self) -> NDArray[np.float64]:
        """(frames,): how many particles counted at each scan, before any resampling (Neff)."""
        return np.array([frame.report.effective for frame in self.frames])

    def show(self, **options: Any) -> Any:
        """A player: the map grows, and paths fork and die; `options`: see `rosmini.viz.slam_pictures`."""
        return show("gmapping_film", self, **options)
