"""Costmaps: inflation, the obstacle layer and whole cycles, beside scipy's distance transform in the same run.

Worlds are squares with obstacles of random sizes, always as dense; the map of the depot is `ROSMINI_DEPOT`'s, a YAML
file. Times are CPU times in ms.
"""

from __future__ import annotations

import math
import os
import statistics
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from functools import cache, partial
from pathlib import Path
from typing import Any

import numpy as np

from rosmini import Graph
from rosmini.core.maps import load_map
from rosmini.core.tf import Buffer, StaticTransformBroadcaster, TransformListener
from rosmini.navigation.costmap_2d.costmap import LETHAL_OBSTACLE, Costs
from rosmini.navigation.costmap_2d.costmap_ros import Costmap2DROS
from rosmini.navigation.costmap_2d.inflation import cell_distance, cost_table, inflate
from rosmini.navigation.costmap_2d.layer import Bounds, Window
from rosmini.navigation.costmap_2d.observations import Observation

from . import Measure
from .sim_growth import exponent

INSCRIBED, RADIUS, SCALING, RESOLUTION = 0.105, 0.55, 10.0, 0.05
"""The inflation [m, m, 1/m, m]: as in the figures of the originals."""
SIDES = (200, 400, 800, 1600)
BEAMS = 360
REACH = 3.5
"""Of a scan [m]."""
CPP_DEPOT = 2.8
"""What costmap_2d's own InflationLayer takes for the depot, in C++ [ms]: shared/facts/kernels.md."""


@cache
def world(side: int, seed: int = 1) -> Costs:
    """Obstacles in a square of so many cells."""
    rng = np.random.default_rng(seed)
    costs = np.zeros((side, side), dtype=np.uint8)
    for _ in range(side * side // 2000):
        x, y = rng.integers(0, side, 2)
        width, height = rng.integers(3, 13, 2)
        costs[y : y + height, x : x + width] = LETHAL_OBSTACLE
    return costs


@cache
def depot() -> Costs | None:
    """The obstacles of the depot; None without its map."""
    path = Path(os.environ.get("ROSMINI_DEPOT", ""))
    if not path.is_file():
        return None
    return np.where(load_map(path).occupancy == 100, LETHAL_OBSTACLE, 0).astype(np.uint8)


def spent_ms(step: Callable[[], object], repeats: int = 5) -> float:
    """The milliseconds of CPU of a step: the median of a few."""
    step()
    spent = []
    for _ in range(repeats):
        begin = time.process_time()
        step()
        spent.append(time.process_time() - begin)
    return statistics.median(spent) * 1e3


def inflation_ms(costs: Costs) -> float:
    """The milliseconds of inflating a whole grid."""
    reach = cell_distance(RADIUS, RESOLUTION)
    table = cost_table(reach, RESOLUTION, INSCRIBED, SCALING)
    window = Window(0, 0, costs.shape[1], costs.shape[0])
    return spent_ms(lambda: inflate(costs.copy(), window, reach, table))


def scipy_inflation_ms(costs: Costs) -> float:
    """The same by scipy's exact distance transform and a table."""
    from scipy.ndimage import distance_transform_edt

    def step() -> None:
        away = distance_transform_edt(costs != LETHAL_OBSTACLE) * RESOLUTION
        found = np.where(away <= RADIUS, 252 * np.exp(-SCALING * (away - INSCRIBED)), 0)
        found[away <= INSCRIBED] = 253
        np.maximum(costs, found.astype(np.uint8))

    return spent_ms(step)


class Bench:
    """A rolling costmap with an obstacle layer and inflation, and a robot that drives a circle in a round room."""

    def __init__(self, side: int) -> None:
        self._stack = ExitStack()
        graph = self._stack.enter_context(Graph())
        node = graph.node("bench")
        node.logger.set_level("rosout", "error")
        buffer = Buffer(node)
        TransformListener(node, buffer)
        StaticTransformBroadcaster(node).send("odom", "base_link")
        metres = round(side * RESOLUTION)
        source = {"data_type": "LaserScan", "topic": "scan", "marking": True, "clearing": True}
        node.set_param(
            "~costmap",
            {
                "global_frame": "odom",
                "rolling_window": True,
                "width": metres,
                "height": metres,
                "resolution": RESOLUTION,
                "update_frequency": 0.0,
                "robot_radius": INSCRIBED,
                "obstacle_range": REACH,
                "raytrace_range": REACH,
                "inflation_radius": RADIUS,
                "observation_sources": "scan",
                "scan": source,
            },
        )
        self.costmap = Costmap2DROS("costmap", buffer, node)
        self.obstacles: Any = self.costmap.layers[0]
        self._turn = 0

    def look(self) -> tuple[float, float, float]:
        """Drive on by 5 cm, and see the room; returns the robot's pose."""
        self._turn += 1
        angle = 0.05 * self._turn
        x, y = math.cos(angle), math.sin(angle)
        beams = np.arange(BEAMS) * math.tau / BEAMS
        ranges = 2.5 + 0.9 * np.sin(5 * (beams + angle))
        points = np.stack([x + ranges * np.cos(beams), y + ranges * np.sin(beams), np.zeros(BEAMS)], axis=-1)
        observation = Observation((x, y, 0.1), points, self._turn, REACH, REACH)
        self.obstacles.sources[0].observations.add(observation, self._turn)
        return x, y, angle + math.pi / 2

    def close(self) -> None:
        """Leave the graph."""
        self._stack.close()


def scan_ms(side: int) -> float:
    """The milliseconds that the obstacle layer takes for a scan: clear, then mark."""
    bench = Bench(side)
    try:
        bench.costmap.layered.update_map(bench.look())
        observation = bench.obstacles.sources[0].observations.observations()[0]

        def step() -> None:
            bounds = Bounds()
            bench.obstacles.clear(observation, bounds)
            bench.obstacles.mark(observation, bounds)

        return spent_ms(step, 50)
    finally:
        bench.close()


def cycle_ms(side: int) -> float:
    """The milliseconds of an update of a whole rolling window while the robot drives: every second rolls it."""
    bench = Bench(side)
    try:
        spent = []
        for _ in range(40):
            pose = bench.look()
            begin = time.process_time()
            bench.costmap.layered.update_map(pose)
            spent.append(time.process_time() - begin)
        return statistics.fmean(spent[5:]) * 1e3
    finally:
        bench.close()


def measures(scale: float) -> Iterator[Measure]:
    """Yield everything that is measured; `scale` under 1 leaves out the largest."""
    small = partial(Measure, more_is_better=False, peer_name="scipy")
    for side in (400, 4000) if scale >= 1 else (400,):
        yield small(
            f"inflation, {side} x {side} cells, 0.55 m",
            "ms of CPU",
            partial(inflation_ms, world(side)),
            partial(scipy_inflation_ms, world(side)),
        )
    there = depot()
    if there is not None:
        yield small("inflation, depot, 0.55 m", "ms of CPU", partial(inflation_ms, there), lambda: CPP_DEPOT,
                    peer_name="C++ costmap_2d, elsewhere")  # fmt: skip
    yield small(f"obstacle layer, a scan of {BEAMS} beams", "ms of CPU", partial(scan_ms, 400))
    yield small("cycle of a rolling window of 400 x 400 cells", "ms of CPU", partial(cycle_ms, 400))
    sides = SIDES if scale >= 1 else SIDES[:3]
    yield small(
        f"inflation, growth with the side ({sides[0]} to {sides[-1]})",
        "exponent",
        lambda: exponent(list(sides), [inflation_ms(world(side)) for side in sides]),
        once=True,
    )
