"""How well the stack navigates: many goals in several worlds, and a table of what came of them.

Success is SUCCEEDED and the true pose within the tolerances; contacts are counted by the engine. Rows are kept as
data, with the seed and the commit, and the book's tables are printed from them.
"""

from __future__ import annotations

import itertools
import os
import statistics
import subprocess
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from rosmini.sim.models import model as model_called

from . import nav_crossing, nav_trial
from .nav_goals import wilson
from .nav_trial import FIELD, Outcome, Setup

XY, YAW = 0.10 + 0.02, 0.17 + 0.05
"""The tolerances [m, rad] of the parameter files, and what a pose may be off from the decision to standing still."""

WORLDS = ("house", "maze", "office")
GAPS = (1.2, 1.4, 1.6, 1.8, 2.0, 2.5, 3.0)
TRAJECTORY = (("base_local_planner", "base_local_planner/TrajectoryPlannerROS"),)
PLANNERS = tuple((("base_global_planner", name),) for name in ("global_planner/GlobalPlanner", "navfn/NavfnROS"))


@dataclass(frozen=True)
class Row:
    """One line of the table."""

    what: str
    count: int
    reached: int
    low: float
    high: float
    """The 95 % interval of the share (Wilson)."""
    contacts: int
    """Goals on whose way the robot drove into something."""
    bumped: int
    """Goals on whose way something walked into the robot."""
    stretch: float
    stretch95: float
    """Median and 95th percentile of the driven length over the shortest at a clearance of 0.15 m."""
    slowness: float
    slowness95: float
    """Median and 95th percentile of the time over that of the shortest path at full speed, turns included."""
    faster: float
    """Seconds of the graph a second of the processor."""
    failures: dict[str, int]
    off: float
    """The median of the true distance from the goal in the end [m]."""


def setups(seed: int, *, quick: bool) -> Iterator[tuple[Setup, int]]:
    """What is tried, and with how many goals."""
    many, some, few = (12, 6, 4) if quick else (200, 100, 50)
    for world in WORLDS:
        yield Setup(world, seed=seed), many
    for world in WORLDS:
        yield Setup(world, sweep=False, seed=seed), some
        yield Setup(world, model="waffle", seed=seed), some
    for overrides in (TRAJECTORY, *PLANNERS[:1]):
        yield Setup("house", overrides=overrides, seed=seed), some
    for gap in GAPS:
        yield Setup(FIELD, gap=gap, seed=seed), few


def outcomes(setup: Setup, count: int, pool: ProcessPoolExecutor) -> list[Outcome]:
    """Send a robot to so many goals."""
    return list(pool.map(nav_trial.run, itertools.repeat(setup), list(nav_trial.drawn(setup, count))))


def tolerances(setup: Setup) -> tuple[float, float]:
    """How far a true pose may be off [m, rad]: with amcl as much as where several robots have it."""
    return (nav_crossing.XY, nav_crossing.YAW) if setup.localization == "amcl" else (XY, YAW)


def row(setup: Setup, found: list[Outcome]) -> Row:
    """Sum up."""
    xy, yaw = tolerances(setup)
    good = [one for one in found if one.reached(xy, yaw)]
    low, high = wilson(len(good), len(found))
    stretches = sorted(one.stretch for one in good) or [float("nan")]
    top = setup_speed(setup)
    least = [one.errand.shortest / top[0] + one.errand.turning / top[1] for one in good]
    times = sorted(one.seconds / ideal for one, ideal in zip(good, least, strict=True)) or [float("nan")]
    why = Counter(reason(one, xy, yaw) for one in found if one not in good)
    return Row(
        setup.words,
        len(found),
        len(good),
        low,
        high,
        sum(bool(one.contacts) for one in found),
        sum(bool(one.bumps) for one in found),
        statistics.median(stretches),
        stretches[min(len(stretches) - 1, int(0.95 * len(stretches)))],
        statistics.median(times),
        times[min(len(times) - 1, int(0.95 * len(times)))],
        sum(one.seconds for one in found) / max(sum(one.cpu for one in found), 1e-9),
        dict(why.most_common()),
        statistics.median([one.off for one in good] or [float("nan")]),
    )


def setup_speed(setup: Setup) -> tuple[float, float]:
    """The highest speeds [m/s, rad/s] of a robot."""
    model = model_called(setup.model)
    return model.max_linear, model.max_angular


def reason(one: Outcome, xy: float, yaw: float) -> str:
    """Why a goal does not count as reached."""
    if one.status != "SUCCEEDED":
        return f"{one.status}: {one.text}"
    return f"{one.off:.2f} m off" if one.off > xy else f"{one.turned_off:.2f} rad off"


def driven(seed: int, *, quick: bool, tell: Callable[[str], object]) -> Iterator[tuple[Setup, list[Outcome]]]:
    """Try everything, one row after another."""
    with ProcessPoolExecutor(min(os.cpu_count() or 1, 8)) as pool:
        for setup, count in setups(seed, quick=quick):
            found = outcomes(setup, count, pool)
            tell(line(row(setup, found)))
            yield setup, found


HEAD = (
    f"{'':<44} {'reached':>9} {'95 %':>13} {'contacts':>8} {'bumped':>6} "
    f"{'length':>6} {'95th':>5} {'time':>5} {'x real':>6}"
)


def line(one: Row) -> str:
    """One row as text."""
    text = (
        f"{one.what:<44} {one.reached:>4}/{one.count:<4} {one.low:6.1%}-{one.high:6.1%} {one.contacts:>8} "
        f"{one.bumped:>6} {one.stretch:6.2f} {one.stretch95:5.2f} {one.slowness:5.2f} {one.faster:6.1f}"
    )
    return text + "".join(f"\n    {count} x {why}" for why, count in one.failures.items())


def run(seed: int, *, quick: bool) -> list[tuple[Setup, list[Outcome]]]:
    """Try everything, and print the table."""
    print(HEAD)
    found = list(driven(seed, quick=quick, tell=lambda text: print(text, flush=True)))
    crossed = [nav_crossing.run(4, number) for number in range(seed, seed + (1 if quick else 20))]
    print(*nav_crossing.table(crossed), sep="\n")
    return found


def commit() -> str:
    """The commit that is checked out, in short."""
    return subprocess.run(
        ["git", "rev-parse", "--short", "HEAD"],
        capture_output=True,
        encoding="utf-8",
        check=False,
        cwd=Path(__file__).parent,
    ).stdout.strip()
