"""How well hector_mapping knows where it is, with and without odometry, and what a scan costs, beside gmapping.

`python -m rosmini_bench.nav_hector`. The original, on `log_house`: 0.021 m RMS with the odometry as start, lost at the
first turn on the spot without it, and 0.10 to 0.13 ms a scan. Drives through our own house are recorded when needed.
"""

from __future__ import annotations

import argparse
import math
import os
import time
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.poses import Pose, compose, inverse
from rosmini.core.tf.rigid import from_yaw
from rosmini.navigation.gmapping import GridSlam
from rosmini.navigation.gmapping import Settings as GmappingSettings
from rosmini.navigation.hector_mapping import HectorSlam, Limits, Settings, scan_ends

from . import Measure
from .nav_drives import Drive, drive

Floats = NDArray[np.float64]

DATA = Path(os.environ.get("ROSMINI_SHARED_DATA", Path(__file__).resolve().parents[4] / "shared" / "data"))
LIMITS = Limits(0.12, 3.5)
"""As ROBOTIS's launch file has them."""
CHOSEN = Settings(
    map_resolution=0.05, map_size=1024, map_update_distance_thresh=0.2, map_update_angle_thresh=0.2
)
"""Parameters of our choice for a TurtleBot3."""
LOST = 0.5
"""A pose that is farther off is lost [m]."""


@dataclass(frozen=True)
class Result:
    """What a mapper made of a drive."""

    errors: Floats
    """(n,) distances [m] from the truth, at each scan; paths begin alike."""
    cpu: Floats
    """(n,) seconds of the processor, for each scan."""
    within: float = math.nan
    """How often the true place was in the 95 % ellipse of the covariance."""

    def __str__(self) -> str:
        lost = np.flatnonzero(self.errors > LOST)
        text = (
            f"{np.sqrt(np.mean(self.errors**2)):6.3f} m RMS, {self.errors.max():6.2f} m at most, "
            f"{1e3 * np.median(self.cpu):.2f} ms of CPU a scan (mean {1e3 * self.cpu[1:].mean():.2f})"
        )
        text += "" if math.isnan(self.within) else f", {100 * self.within:.0f} % in the 95 % ellipse"
        return text + (f"; lost at scan {lost[0]}" if len(lost) else "")


def house() -> Drive | None:
    """The burger's drive through the house, turning at 1.2 rad/s, if shared data are there."""
    path = DATA / "log_house.npz"
    if not path.is_file():
        return None
    log = np.load(path)
    ranges = np.where(log["ranges_mm"] == 0, math.inf, log["ranges_mm"] / 1000.0)
    ranges[log["ranges_mm"] == 65535] = 0.0
    steps = np.arange(ranges.shape[1], dtype=np.float64)
    bearings: Floats = float(log["angle_min"]) + float(log["angle_increment"]) * steps
    poses = log["odom"].astype(float), log["truth"].astype(float)
    laser = tuple(log["laser_in_base"].tolist())
    return Drive("house", log["t"], *poses, ranges, bearings, float(log["range_max"]), laser)


def hector(one: Drive, settings: Settings = CHOSEN, *, odometry: bool = False) -> Result:
    """Map a drive; with `odometry` each search begins where that has the robot."""
    slam, mount = HectorSlam(settings), from_yaw(*one.laser)
    errors, cpu, within = [], [], []
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
        off = np.array([slam.pose[0] - real[0], slam.pose[1] - real[1]])
        errors.append(float(np.hypot(*off)))
        if slam.matched is not None:
            within.append(off @ np.linalg.solve(slam.matched.covariance[:2, :2], off) < 5.991)
    return Result(np.array(errors), np.array(cpu), float(np.mean(within)))


def gmapping(one: Drive, *, odometry: bool = True) -> Result:
    """The same by gmapping, with the node's defaults; without `odometry` it hears that the robot stands still."""
    reach, moves = one.range_max - 0.01, one.odometry if odometry else np.zeros_like(one.odometry)
    start: Pose = tuple(moves[0].tolist())
    slam = GridSlam(
        GmappingSettings(max_range=reach, max_urange=reach, temporal_update=-1.0 if odometry else 0.1),
        laser=one.laser,
        start=start,
        random=np.random.default_rng(1),
    )
    errors, cpu = [], []
    align = compose(one.truth[0], inverse(moves[0]))
    last = np.asarray(start)
    for index, move in enumerate(moves):
        begin = time.process_time()
        found = slam.process(one.ranges[index], one.bearings, tuple(move.tolist()), float(one.times[index]))
        cpu.append(time.process_time() - begin)
        if found is not None:
            last, at = slam.poses[slam.best], index
        here = compose(last, compose(inverse(moves[at]), move))
        errors.append(float(np.hypot(*(compose(align, here) - one.truth[index])[:2])))
    return Result(np.array(errors), np.array(cpu))


def study(seeds: int, seconds: float) -> None:
    """Print how well both know where they are: so many drives of each kind, of so many seconds."""
    log = house()
    if log is not None:
        print("log_house (turns of 1.2 rad/s, the laser sweeps)")
        print("  hector, defaults, odometry as start:  ", hector(log, Settings(), odometry=True))
        print("  hector, our choice, odometry as start:", hector(log, odometry=True))
        print("  hector, our choice, no odometry:      ", hector(log))
        print("  gmapping, defaults:                   ", gmapping(log))
    for turn, sweep in ((0.5, False), (0.5, True), (1.2, False), (1.2, True)):
        for seed in range(1, seeds + 1):
            one = drive("house", seed, seconds, turn=turn, sweep=sweep)
            print(
                f"house, seed {seed}, turns of {turn} rad/s, the laser {'sweeps' if sweep else 'does not sweep'}"
            )
            print("  hector, no odometry:      ", hector(one))
            print("  hector, odometry as start:", hector(one, odometry=True))
            if seed == 1 and sweep:
                print("  gmapping, defaults:       ", gmapping(one))


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


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--seconds", type=float, default=120.0)
    given = parser.parse_args()
    study(given.seeds, given.seconds)
