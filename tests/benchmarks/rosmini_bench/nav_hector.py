"""How hector_mapping follows a drive, with and without odometry, and what a scan costs.

The original, on `log_house`: 0.021 m RMS with the odometry as start, lost at the first turn on the spot without it,
and 0.10 to 0.13 ms a scan. `nav_located` makes studies of it.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.poses import Pose, compose, inverse
from rosmini.core.tf.rigid import from_yaw
from rosmini.navigation.hector_mapping.scans import Limits, scan_ends
from rosmini.navigation.hector_mapping.slam import HectorSlam, Settings

from . import Measure, nav_gmapping
from .nav_drives import Drive, drive

Floats = NDArray[np.float64]

LIMITS = Limits(0.12, 3.5)
"""As ROBOTIS's launch file has them."""
CHOSEN = Settings(map_resolution=0.05, map_size=1024, map_update_distance_thresh=0.2, map_update_angle_thresh=0.2)
"""Parameters of our choice for a TurtleBot3."""


@dataclass(frozen=True)
class Result:
    """What a mapper made of a drive."""

    errors: Floats
    """(n,) distances [m] from the truth, at each scan; paths begin alike."""
    cpu: Floats
    """(n,) seconds of the processor, for each scan."""


def house() -> Drive | None:
    """The burger's drive through the house, turning at 1.2 rad/s, if shared data are there."""
    log = nav_gmapping.house()
    if log is None:
        return None
    poses = log.times, log.odometry, log.truth
    return Drive("house", *poses, log.ranges, log.bearings, log.range_max, log.laser)


def hector(one: Drive, settings: Settings = CHOSEN, *, odometry: bool = False) -> Result:
    """Map a drive; with `odometry` each search begins where that has the robot."""
    slam, mount = HectorSlam(settings), from_yaw(*one.laser)
    errors: list[float] = []
    cpu: list[float] = []
    start: Pose = tuple(one.truth[0].tolist())
    for index, truth in enumerate(one.truth):
        begin = time.process_time()
        ends = scan_ends(one.ranges[index], one.bearings, (0.12, one.range_max), mount, LIMITS)
        guess = None
        if odometry and index:
            moved = compose(inverse(one.odometry[index - 1]), one.odometry[index])
            guess = compose(slam.pose, (float(moved[0]), float(moved[1]), float(moved[2])))
        slam.update(ends, one.laser[:2], guess=guess)
        cpu.append(time.process_time() - begin)
        real = compose(inverse(start), (float(truth[0]), float(truth[1]), float(truth[2])))
        errors.append(math.dist(slam.pose[:2], real[:2]))
    return Result(np.array(errors), np.array(cpu))


def scan_cost(seconds: float) -> float:
    """Return milliseconds of the processor for the median scan of a drive."""
    return float(1e3 * np.median(hector(drive("house", 1, seconds, turn=0.5)).cpu))


def measures(scale: float) -> Iterator[Measure]:
    """Yield what a scan costs."""
    yield Measure(
        "hector_mapping, a scan of 360 beams on three maps of 5 cm and more",
        "ms of CPU",
        partial(scan_cost, 20.0 if scale >= 1 else 4.0),
        more_is_better=False,
        once=True,
    )
