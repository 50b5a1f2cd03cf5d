"""From keys to velocities, as TurtleBot3's own `turtlebot3_teleop_key` does it. No node and no clock is in here.

A key moves a *target*; what is sent approaches the target, by half a step in each cycle of 0.1 s. The space bar and
`s` set both to zero at once. Each key begins a cycle of its own, as the read of the keyboard there ends with a key or
after 0.1 s.

The facts (keys, steps, slopes, cycle, limits) are those of `turtlebot3_teleop/nodes/turtlebot3_teleop_key` in
https://github.com/ROBOTIS-GIT/turtlebot3, branch noetic. The arrow keys are ours, and so is the rounding to a
millionth, without which six steps of 0.01 would give 0.060000000000000005.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from rosmini.errors import RosminiError, nearest

LINEAR_STEP = 0.01
"""What `w` and `x` add to the target [m/s]."""
ANGULAR_STEP = 0.1
"""What `a` and `d` add to the target [rad/s]."""
PERIOD = 0.1
"""How long a cycle is without a key [s]."""
SLOPE = 0.5
"""How far what is sent moves in a cycle, in steps."""
GRAIN = 1e6
"""Velocities are multiples of a part of this many."""

STOP = (0, 0)
KEYS: Mapping[str, tuple[int, int]] = MappingProxyType(
    {
        "w": (1, 0),
        "x": (-1, 0),
        "a": (0, 1),
        "d": (0, -1),
        "s": STOP,
        " ": STOP,
        "ArrowUp": (1, 0),
        "ArrowDown": (-1, 0),
        "ArrowLeft": (0, 1),
        "ArrowRight": (0, -1),
    }
)
"""Steps ahead and to the left for each key, named as browsers name them; no step at all is the stop."""

_NAMES: Mapping[str, str] = MappingProxyType(
    {key.lower(): key for key in KEYS}
    | {"space": " ", "up": "ArrowUp", "down": "ArrowDown", "left": "ArrowLeft", "right": "ArrowRight"}
)


class TeleopError(RosminiError, ValueError):
    """A key that the pad does not know, invalid limits, or a robot that is no longer there."""


@dataclass(frozen=True)
class Limits:
    """How fast a robot may be sent: those of the TurtleBot3 Burger if nothing else is given.

    Raises `TeleopError` if one of them is not a positive number.
    """

    linear: float = 0.22
    """[m/s]"""
    angular: float = 2.84
    """[rad/s]"""

    def __post_init__(self) -> None:
        for name, value in (("linear", self.linear), ("angular", self.angular)):
            if not (math.isfinite(value) and value > 0):
                raise TeleopError(
                    f"the {name} limit of a pad must be a positive number, not {value!r}; Burger: 0.22 m/s, 2.84 rad/s"
                )


def key_named(name: str) -> str:
    """The key that `name` means: as browsers name it, in any case, or "space", "up", "down", "left", "right".

    Raises `TeleopError` with the nearest name, or with all of them.
    """
    key = _NAMES.get(name.lower())
    if key is None:
        names = ["w", "x", "a", "d", "s", "space", "up", "down", "left", "right"]
        guess = nearest(name, names)
        raise TeleopError(
            f"the pad has no key {name!r}; {guess or 'it has ' + ', '.join(names)}. "
            "w and x: faster and slower, a and d: left and right, s or space: stop."
        )
    return key


class Teleop:
    """The velocities that are wanted, and those that are sent: linear [m/s] and angular [rad/s]."""

    def __init__(self, limits: Limits | None = None) -> None:
        self.limits = limits or Limits()
        self.target = (0.0, 0.0)
        """What the keys ask for."""
        self.command = (0.0, 0.0)
        """What was sent last."""

    @property
    def at_rest(self) -> bool:
        """Whether nothing is wanted and nothing is sent."""
        return self.target == self.command == (0.0, 0.0)

    def press(self, key: str) -> tuple[float, float]:
        """Take a key, named as in `KEYS`, and return what is to be sent. Raises `KeyError`."""
        ahead, left = KEYS[key]
        if (ahead, left) == STOP:
            self.target = self.command = (0.0, 0.0)
        else:
            linear, angular = self.target
            self.target = (
                _limited(linear + ahead * LINEAR_STEP, self.limits.linear),
                _limited(angular + left * ANGULAR_STEP, self.limits.angular),
            )
        return self.cycle()

    def cycle(self) -> tuple[float, float]:
        """Come nearer to the target by half a step, and return what is to be sent."""
        self.command = (
            _approach(self.command[0], self.target[0], SLOPE * LINEAR_STEP),
            _approach(self.command[1], self.target[1], SLOPE * ANGULAR_STEP),
        )
        return self.command


def table(limits: Limits) -> dict[str, Any]:
    """All numbers of this module, for the script that does the same in the browser."""
    return {
        "linear": {"step": LINEAR_STEP, "max": limits.linear},
        "angular": {"step": ANGULAR_STEP, "max": limits.angular},
        "slope": SLOPE,
        "period": PERIOD,
        "grain": GRAIN,
        "keys": {key: list(steps) for key, steps in KEYS.items()},
    }


def _limited(value: float, limit: float) -> float:
    return _rounded(max(-limit, min(limit, value)))


def _approach(value: float, target: float, slope: float) -> float:
    return _rounded(min(target, value + slope) if target > value else max(target, value - slope))


def _rounded(value: float) -> float:
    # Not round(): a script in the browser has to come to the same bits.
    return math.floor(value * GRAIN + 0.5) / GRAIN
