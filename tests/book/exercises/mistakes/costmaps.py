"""Wrong answers to the exercises of the chapter Costmaps: right ones with a fault put in."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

FILE = """
global_frame: odom
robot_base_frame: base_footprint
update_frequency: 5.0
publish_frequency: 2.0
rolling_window: true
width: 3
height: 3
resolution: 0.05
robot_radius: 0.11
plugins:
  - {name: obstacle_layer, type: "costmap_2d::ObstacleLayer"}
  - {name: inflation_layer, type: "costmap_2d::InflationLayer"}
obstacle_layer:
  observation_sources: scan
  scan: {data_type: LaserScan, topic: scan, marking: true, clearing: true}
inflation_layer:
  inflation_radius: 0.5
  cost_scaling_factor: 5.0
"""

LAYERS = """  - {name: obstacle_layer, type: "costmap_2d::ObstacleLayer"}
  - {name: inflation_layer, type: "costmap_2d::InflationLayer"}
"""
SWAPPED = "".join(reversed(LAYERS.splitlines(keepends=True)))


def _file(old: str, new: str) -> Callable[[], str]:
    assert old in FILE
    return lambda: FILE.replace(old, new)


def _cost(rounded: Callable[[float], Any] = int, *, lethal: int = 254, top: int = 252) -> Callable[[], Any]:
    def cost(d: float, r: float, R: float, s: float) -> Any:
        if d == 0:
            return lethal
        if d > R:
            return 0
        return 253 if d <= r else rounded(top * math.exp(-s * (d - r)))

    return lambda: cost


def _endless(d: float, r: float, R: float, s: float) -> int:
    del R
    return 254 if d == 0 else 253 if d <= r else int(252 * math.exp(-s * (d - r)))


def _open_end(d: float, r: float, R: float, s: float) -> int:
    return 254 if d == 0 else 0 if d >= R else 253 if d <= r else int(252 * math.exp(-s * (d - r)))


def _inscribed_first(d: float, r: float, R: float, s: float) -> int:
    return 254 if d == 0 else 253 if d <= r else 0 if d > R else int(252 * math.exp(-s * (d - r)))


def _numbers(radius: Any, reach: Any, scaling: Any) -> Callable[[], dict[str, Any]]:
    return lambda: {
        "robot_radius": radius, "inflation_radius": reach, "cost_scaling_factor": scaling,
    }  # fmt: skip


def _blocker(
    values: tuple[int, ...] = (253, 254), *, last: bool = False, names: tuple[str, ...] = ()
) -> Callable[[], Any]:
    def blocker(costmap: Any, x: float, y: float) -> str | None:
        cell = costmap.grid.world_to_map(x, y)
        if cell is None:
            return None
        found = [n for n, c in costmap.explain(*cell).items() if c in values and (not names or n in names)]
        return None if not found else found[-1] if last else found[0]

    return lambda: blocker


def _everywhere(costmap: Any, x: float, y: float) -> str | None:
    cell = costmap.grid.world_to_map(x, y)
    return next((n for n, c in costmap.explain(*cell).items() if c in (253, 254)), None)


def _one_cell(costmap: Any, x: float, y: float) -> str | None:
    del x, y
    return next((n for n, c in costmap.explain(5, 3).items() if c in (253, 254)), None)


MISTAKES: dict[str, list[Callable[[], object]]] = {
    "cost": [
        _cost(round),
        _cost(float),
        _cost(lethal=253),
        _cost(top=253),
        lambda: _endless,
        lambda: _open_end,
        lambda: _inscribed_first,
    ],
    "door": [
        lambda: (0.12, 0.6, 5.0),
        lambda: {"robot_radius": 0.12, "inflation_radius": 0.6},
        _numbers(0.051, 0.6, 5.0),
        _numbers(0.12, 0.2, 5.0),
        _numbers(0.12, 0.6, 40.0),
        _numbers(0.35, 0.6, 5.0),
        _numbers("0.12", 0.6, 5.0),
    ],
    "blocker": [
        _blocker((254,)),
        _blocker((200, 253, 254)),
        _blocker(last=True),
        _blocker(names=("static_layer", "obstacle_layer", "inflation_layer")),
        lambda: _everywhere,
        lambda: _one_cell,
        lambda: print,
    ],
    "params": [
        lambda: {"rolling_window": True},
        lambda: "rolling_window: [true",
        lambda: "true",
        _file("rolling_window: true", "rolling_window: false"),
        _file("clearing: true", "clearing: false"),
        _file("marking: true", "marking: false"),
        _file("observation_sources: scan", "observation_sources: laser"),
        _file("inflation_radius: 0.5", "inflation_radius: 0.1"),
        _file("robot_radius: 0.11\n", ""),
        _file("data_type: LaserScan", "data_type: PointCloud"),
        _file("global_frame: odom", "global_frame: map"),
        _file("update_frequency: 5.0", "update_frequency: 0.0"),
        _file(LAYERS, SWAPPED),
    ],
}
