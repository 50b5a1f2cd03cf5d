"""What is measured of navigation: planners, costmaps and controllers alone, and the whole loop with a robot in a house.

How well it navigates, which takes many goals, is `nav_quality`'s affair: `rosmini bench nav` prints both.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import Any

from rosmini.core.errors import RosminiError

from . import Measure, nav_amcl, nav_control, nav_costmap, nav_gmapping, nav_hector, nav_planners, nav_trial
from .nav_trial import Setup

ROBOTIS_RATES: tuple[tuple[str, Any], ...] = (
    ("controller_frequency", 10.0), ("planner_frequency", 5.0), ("global_costmap/update_frequency", 10.0),
    ("global_costmap/publish_frequency", 10.0), ("local_costmap/update_frequency", 10.0),
    ("local_costmap/publish_frequency", 10.0), ("DWAPlannerROS/vx_samples", 20), ("DWAPlannerROS/vth_samples", 40),
)  # fmt: skip
"""The rates of the files that ROBOTIS publishes, and 800 samples."""


def loop(overrides: tuple[tuple[str, Any], ...], goals: int, seed: int) -> float:
    """Return seconds of the graph a second of the processor, while a burger drives to some goals in the house."""
    setup = Setup("house", overrides=overrides, seed=seed)
    found = [nav_trial.run(setup, errand, watched=False) for errand in nav_trial.drawn(setup, goals)]
    lost = [one for one in found if one.status == "LOST"]
    if lost:
        raise RosminiError(f"{len(lost)} of {goals} goals ended without a result: there is no figure")
    return sum(one.seconds for one in found) / max(sum(one.cpu for one in found), 1e-6)


def measures(scale: float, seed: int = 1) -> Iterator[Measure]:
    """Yield what is measured; `scale` under 1 leaves out what is large."""
    yield from nav_planners.measures((400, 4000) if scale >= 1 else (100,))
    yield from nav_costmap.measures(scale)
    times = 40 if scale >= 1 else 2
    for side in (60, 400) if scale >= 1 else (60,):
        yield Measure(
            f"DWA, 800 samples of 30 points, window of {side} x {side} cells",
            "ms of CPU",
            partial(nav_control.cycle_cost, side, seed, times),
            more_is_better=False,
        )
    yield Measure(
        "Trajectory Rollout, 800 samples", "ms of CPU", partial(nav_control.rollout_cost, 60, seed, times),
        more_is_better=False,
    )  # fmt: skip
    yield from nav_amcl.measures(scale)
    yield from nav_hector.measures(scale)
    yield from nav_gmapping.measures(scale)
    goals = 4 if scale >= 1 else 1
    for name, rates in (("ROBOTIS's rates", ROBOTIS_RATES), ("our file", ())):
        yield Measure(
            f"whole loop, burger in the house, {name}", "x real time", partial(loop, rates, goals, seed), once=True
        )
