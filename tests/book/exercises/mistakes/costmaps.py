"""Wrong answers to the exercises of the chapter Costmaps: right ones with a fault put in."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Script

from .file_system import wrong
from .published import solution

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


DOOR = """
global_costmap:
  footprint: "[]"
  robot_radius: 0.12
"""

COST_THERE = solution("costmaps", "cost_there")


def _script(old: str, new: str) -> Callable[[], Script]:
    assert old in COST_THERE, old
    return lambda: Script("cost_there.py", COST_THERE.replace(old, new))


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
        lambda: {"global_costmap": {"robot_radius": 0.12}},
        lambda: "",
        wrong(DOOR, '  footprint: "[]"\n'),
        wrong(DOOR, "0.12", "0.05"),
        wrong(DOOR, "0.12", "0.35"),
        wrong(DOOR, "0.12", "0.12\n  inflation_radius: 0.2"),
        wrong(DOOR, "0.12", "0.12\n  cost_scaling_factor: 40.0"),
        wrong(DOOR, "0.12", "0.12\n  inflation_layer: {inflation_radius: 0.6}"),
        wrong(DOOR, "0.12", "wide"),
    ],
    "cost_there": [
        _script("row * info.width + column", "column * info.height + row"),
        _script("(question.point.x - corner.x)", "question.point.x"),
        _script("math.floor((question.point.y", "int((question.point.y"),
        _script("        cost.publish(-1)", "        pass"),
        _script("0 <= column < info.width and 0 <= row < info.height", "True"),
        _script(" / info.resolution", " / 0.05"),
        _script("row * info", "(info.height - 1 - row) * info"),
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
