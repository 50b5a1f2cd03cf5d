"""The filter's state after each scan, to show how a map grows and particles die out."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.poses import Pose
from rosmini.core.graph.show import show

from .extent import known
from .slam import GridSlam, Report

OCCUPIED = 0.25
"""A cell is occupied if more than this fraction of its visits were beam ends: the default of `occ_thresh`."""


class Frame(NamedTuple):
    """The filter's state at one time."""

    time: float
    """Time [s]."""
    pose: Pose
    """The robot's pose according to the best particle."""
    cells: NDArray[np.int8]
    """The best particle's map (h, w): 0 free, 100 occupied, -1 unknown."""
    corner: tuple[float, float]
    """Lower left corner of cell (0, 0) [m]."""
    branches: tuple[NDArray[np.float64], ...]
    """The paths of all particles, from `GridSlam.branches`."""
    report: Report


class Film:
    """A sequence of frames of a filter; call `take` after each processed scan."""

    def __init__(self, slam: GridSlam, threshold: float = OCCUPIED) -> None:
        self.slam, self.threshold = slam, threshold
        self.frames: list[Frame] = []

    def take(self, report: Report) -> None:
        """Store the current state after a scan; `report` is the result of `GridSlam.process`."""
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
        """The effective number of particles at each scan (frames,), before any resampling (Neff)."""
        return np.array([frame.report.effective for frame in self.frames])

    def show(self, **options: Any) -> Any:
        """Return a player in which the map grows and paths fork and end; options as in `rosmini.viz.slam_pictures`."""
        return show("gmapping_film", self, **options)
