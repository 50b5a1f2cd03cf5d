"""Maps on several scales and their updates: hector_mapping without a graph."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.poses import Pose, transform_points

from .grid import OccupancyGrid
from .matching import Matched, match

Floats = NDArray[np.float64]

FINE, COARSE = 5, 3
"""Numbers of iterations on the finest map, and on each of the others."""
START: Pose = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Settings:
    """The parameters, named as in http://wiki.ros.org/hector_mapping#Parameters."""

    map_resolution: float = 0.025
    map_size: int = 1024
    map_start_x: float = 0.5
    map_start_y: float = 0.5
    map_multi_res_levels: int = 3
    update_factor_free: float = 0.4
    update_factor_occupied: float = 0.9
    map_update_distance_thresh: float = 0.4
    map_update_angle_thresh: float = 0.9


class HectorSlam:
    """Maps, the finest first, and the robot's pose on them.

    There is no level of less than two cells: the original creates it, but cannot match a scan there.
    Raises `RosminiError` for parameters that give no valid map.
    """

    def __init__(self, settings: Settings) -> None:
        s = self.settings = settings
        if not (s.map_resolution > 0 and s.map_size > 1 and s.map_multi_res_levels > 0):
            raise RosminiError(
                f"a map of {s.map_size} cells of {s.map_resolution} m on {s.map_multi_res_levels} levels: all must "
                "be greater than 0"
            )
        self.reset()

    def reset(self) -> None:
        """Clear the maps, and reset the pose to their origin."""
        s = self.settings
        side = s.map_size * s.map_resolution
        levels = min(s.map_multi_res_levels, s.map_size.bit_length() - 1)
        corner = (-s.map_start_x * side, -s.map_start_y * side)
        self.maps = [
            OccupancyGrid(
                (s.map_size >> level, s.map_size >> level),
                s.map_resolution * 2**level,
                corner,
                free=s.update_factor_free,
                occupied=s.update_factor_occupied,
            )
            for level in range(levels)
        ]
        self.pose = START
        self.matched: Matched | None = None
        """The result on the finest map; None before there is a map to match."""
        self.updates = 0
        self._last_update: Pose | None = None

    def update(
        self,
        points: Floats,
        laser: tuple[float, float] = (0.0, 0.0),
        *,
        guess: Pose | None = None,
        matching: bool = True,
    ) -> Pose:
        """Process the beam ends of a scan (b, 2) [m] in the robot's frame; return the robot's pose.

        Args:
            points: the beam ends.
            laser: the laser's position in the robot's frame [m].
            guess: the start of the search; the last pose by default.
            matching: False uses the guess as the pose, and updates the maps with every scan.

        """
        pose = self.pose if guess is None else guess
        if matching and self.updates and len(points):
            for level in range(len(self.maps) - 1, -1, -1):
                self.matched = match(self.maps[level], points, pose, COARSE if level else FINE)
                pose = self.matched.pose
        self.pose = pose
        if len(points) and (not matching or self._has_moved(pose)):
            self._last_update = pose
            ends = transform_points(pose, points)
            x, y = transform_points(pose, np.array([laser]))[0]
            for grid in self.maps:
                grid.update((float(x), float(y)), ends)
            self.updates += 1
        return pose

    def _has_moved(self, pose: Pose) -> bool:
        last = self._last_update
        return (
            last is None
            or math.dist(pose[:2], last[:2]) > self.settings.map_update_distance_thresh
            or abs(math.remainder(pose[2] - last[2], math.tau)) > self.settings.map_update_angle_thresh
        )
