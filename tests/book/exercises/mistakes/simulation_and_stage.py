"""Wrong answers to the exercises of the chapter Simulation and Stage."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from rosmini.book.exercises.simulation_and_stage import _belief
from rosmini.msgs import message_class

if TYPE_CHECKING:
    from collections.abc import Callable


def _counting(rule: Callable[[Any, Any], Any]) -> Callable[[], Any]:
    return lambda: lambda scan: int(np.sum(rule(np.array(scan.ranges), scan)))


# ---- mole_world: a world file ----

_MOLE = """
position( name "{name}" pose [{pose}] size [{size}] drive "{drive}"
  ranger( pose [0 0 {z} 0] sensor( range [0 {reach}] fov {fov} samples {samples} ) ) )
model( name "wall" pose [{wall}] size [3 0.2 {top}] {more} )
"""
_RIGHT = {
    "name": "mole",
    "pose": "1 2 0 90",
    "size": "0.5 0.5 0.3",
    "drive": "omni",
    "z": "-0.15",
    "reach": "4",
    "fov": "90",
    "samples": "91",
    "wall": "1 3.6 0 0",
    "top": "0.6",
    "more": "",
}


def _mole(**other: str) -> Callable[[], str]:
    return lambda: _MOLE.format(**{**_RIGHT, **other})


# ---- world_velocity: a velocity of the world ----


def _velocity(turn: Callable[[float, float, float], tuple[float, float]]) -> Callable[[], Any]:
    def make(vx: float, vy: float, heading: float) -> Any:
        twist = message_class("geometry_msgs/Twist")()
        twist.linear.x, twist.linear.y = turn(vx, vy, heading)
        return twist

    return lambda: make


def _wrapped(*of: float) -> tuple[float, float, float]:
    x, y, heading = _belief(*of)
    return x, y, math.remainder(heading, 2 * math.pi)


MISTAKES = {
    "count_hits": [
        _counting(lambda r, _: np.isfinite(r)),
        _counting(lambda r, s: r < s.range_max),
        _counting(lambda r, s: (r >= s.range_min) & (r <= s.range_max)),
        _counting(lambda r, s: (r >= s.range_min) & (r < s.range_max)),
        _counting(lambda r, s: (r > 0) & (r < s.range_max)),
        lambda: lambda scan: [r for r in scan.ranges if scan.range_min <= r < scan.range_max and r > 0],
    ],
    "mole_world": [
        lambda: 'scout( name "mole" )',
        _mole(name="vole"),
        _mole(pose="1 2 0 0"),
        _mole(pose="1 2 0 1.5708"),
        _mole(drive="diff"),
        _mole(size="0.5 0.5 0.5"),
        _mole(z="0"),
        _mole(z="-0.29"),
        _mole(reach="5"),
        _mole(fov="180"),
        _mole(samples="90"),
        _mole(wall="1 3.5 0 0"),
        _mole(wall="2.6 2 0 90"),
        _mole(top="0.5"),
        _mole(more="gripper_return 1"),
        lambda: _MOLE.format(**_RIGHT) * 2,
        lambda: 'model( name "wall" pose [1 3.6 0 0] size [3 0.2 0.6] )',
    ],
    "world_velocity": [
        _velocity(lambda vx, vy, _: (vx, vy)),
        _velocity(lambda vx, vy, a: (math.cos(a) * vx - math.sin(a) * vy, math.sin(a) * vx + math.cos(a) * vy)),
        _velocity(lambda vx, vy, a: (math.cos(a) * vx + math.sin(a) * vy, math.sin(a) * vx - math.cos(a) * vy)),
        _velocity(lambda vx, vy, _: (math.hypot(vx, vy), 0.0)),
        lambda: lambda vx, vy, _heading: (vx, vy),
    ],
    "belief": [
        lambda: lambda v, w, seconds, _x, _a: _belief(v, w, seconds, 0.0, 0.0),
        lambda: lambda v, w, seconds, e_x, e_a: _belief(v, w, seconds, e_a, e_x),
        lambda: lambda v, w, seconds, e_x, e_a: _belief(v, w, seconds, e_x / 2, e_a / 2),
        lambda: lambda v, w, seconds, e_x, e_a: _belief(v, w, seconds, -e_x, -e_a),
        lambda: lambda v, w, seconds, e_x, e_a: (v * seconds * (1 + e_x), 0.0, w * seconds * (1 + e_a)),
        lambda: (
            lambda v, w, seconds, e_x, _a: (
                (1 + e_x) * v / w * math.sin(w * seconds),
                (1 + e_x) * v / w * (1 - math.cos(w * seconds)),
                w * seconds,
            )
        ),
        lambda: _wrapped,
    ],
}
