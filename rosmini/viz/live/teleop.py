"""Convert keys to velocities as ROS's teleoperation programs do, without a node or a clock.

With the keys of `turtlebot3_teleop_key` a key moves a *target*; the command approaches the target by half a step in
each cycle of 0.1 s. Its stop key sets both to zero at once. Each key starts a new cycle, because the original's
keyboard read returns on a key or after 0.1 s. With those of `teleop_twist_keyboard` a key sets the direction, at a
speed that other keys change. `rosmini.viz.live.key_maps` lists the keys.

The slopes and the cycle are those of `turtlebot3_teleop/nodes/turtlebot3_teleop_key` in
https://github.com/ROBOTIS-GIT/turtlebot3, branch noetic. rosmini adds rounding to a millionth, without which six steps
of 0.01 would give 0.060000000000000005.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from .key_maps import KeyMap, TeleopError, burger_limits, key_map

PERIOD = 0.1
"""Length of a cycle without a key [s]."""
SLOPE = 0.5
"""Change of the command per cycle, in steps."""
GRAIN = 1e6
"""Velocities are multiples of 1 / GRAIN."""

REST = (0.0, 0.0)
_LINEAR, _ANGULAR = burger_limits()


@dataclass(frozen=True)
class Limits:
    """Maximum speeds of a robot; by default those of a TurtleBot3 Burger.

    Raises `TeleopError` if a value is not positive.
    """

    linear: float = _LINEAR
    """Linear speed [m/s]."""
    angular: float = _ANGULAR
    """Angular speed [rad/s]."""

    def __post_init__(self) -> None:
        for name, value in (("linear", self.linear), ("angular", self.angular)):
            if not (math.isfinite(value) and value > 0):
                raise TeleopError(
                    f"the {name} limit of a pad must be a positive number, not {value!r}; Burger: 0.22 m/s, 2.84 rad/s"
                )


class Teleop:
    """Target and command velocities: linear [m/s] and angular [rad/s]."""

    def __init__(self, limits: Limits | None = None, keys: KeyMap | None = None) -> None:
        self.limits = limits or Limits()
        self.use(keys or key_map())

    def use(self, keys: KeyMap) -> None:
        """Switch to other keys, at their initial speed, and come to rest."""
        self.keys = keys
        self.speed = (_limited(keys.linear, self.limits.linear), _limited(keys.angular, self.limits.angular))
        """Speed that a key without steps sets."""
        self.stop()

    def stop(self) -> None:
        """Set target and command to zero."""
        self.target = REST
        """Velocities that the keys ask for."""
        self.command = REST
        """Velocities sent last."""
        self.aside = REST
        """Sideways and vertical velocities sent last [m/s], by `teleop_twist_keyboard` with Shift, t and b."""
        self._direction = (0.0, 0.0, 0.0, 0.0)
        self.is_steered = False
        """True if a gamepad, not a key, set the target last."""

    @property
    def at_rest(self) -> bool:
        """True if target and command are zero."""
        return self.target == self.command == self.aside == REST

    @property
    def repeats(self) -> bool:
        """True if the command is sent again in the next cycle; otherwise it lapses after `keys.holds`."""
        return self.keys.holds is None or self.is_steered

    def press(self, key: str) -> tuple[float, float]:
        """Apply a key, named as in the key map, and return the command. Raises `KeyError`."""
        if key in self.keys.stops:
            self.stop()
        elif key in self.keys.factors:
            for_linear, for_angular = self.keys.factors[key]
            linear, angular = self.speed
            self.speed = (
                _limited(linear * for_linear, self.limits.linear),
                _limited(angular * for_angular, self.limits.angular),
            )
            if not self.is_steered:
                self._aim()
        elif self.keys.adds:
            ahead, _, _, left = self.keys.moves[key]
            linear, angular = self.target
            self.target = (
                _limited(linear + ahead * self.keys.linear, self.limits.linear),
                _limited(angular + left * self.keys.angular, self.limits.angular),
            )
            self.is_steered = False
        else:
            self._direction = self.keys.moves[key]
            self.is_steered = False
            self._aim()
        return self.cycle()

    def steer(self, linear: float, angular: float) -> tuple[float, float]:
        """Set the target velocities, and return the command. Raises `TeleopError` unless they are finite."""
        if not (math.isfinite(linear) and math.isfinite(angular)):
            raise TeleopError(f"a pad is steered with finite velocities, not {linear!r} and {angular!r}")
        self.is_steered = True
        self.aside, self._direction = REST, (0.0, 0.0, 0.0, 0.0)
        self.target = _limited(linear, self.limits.linear), _limited(angular, self.limits.angular)
        return self.cycle()

    def cycle(self) -> tuple[float, float]:
        """Move the command towards the target, and return it."""
        slopes = slopes_of(self.keys)
        self.command = (
            _approach(self.command[0], self.target[0], slopes[0]),
            _approach(self.command[1], self.target[1], slopes[1]),
        )
        return self.command

    def _aim(self) -> None:
        ahead, left, up, turn = self._direction
        linear, angular = self.speed
        self.target = _rounded(ahead * linear), _rounded(turn * angular)
        self.aside = _rounded(left * linear), _rounded(up * linear)


def slopes_of(keys: KeyMap) -> tuple[float, float]:
    """Return the maximum change of the command per cycle: linear [m/s], angular [rad/s]."""
    return (SLOPE * keys.linear, SLOPE * keys.angular) if keys.adds else (math.inf, math.inf)


def table(limits: Limits, keys: KeyMap | None = None) -> dict[str, Any]:
    """Return all numbers of a pad for the equivalent script in the browser; None means unlimited."""
    keys = keys or key_map()
    slopes = [slope if math.isfinite(slope) else None for slope in slopes_of(keys)]
    return {
        "name": keys.name,
        "linear": {"step": keys.linear, "max": limits.linear, "slope": slopes[0]},
        "angular": {"step": keys.angular, "max": limits.angular, "slope": slopes[1]},
        "period": PERIOD,
        "grain": GRAIN,
        "adds": keys.adds,
        "holds": keys.holds,
        "others_stop": keys.others_stop,
        "moves": {key: [_number(part) for part in move] for key, move in keys.moves.items()},
        "factors": {key: list(factors) for key, factors in keys.factors.items()},
        "stops": list(keys.stops),
        "buttons": list(keys.buttons),
    }


def _number(value: float) -> float | int:
    return int(value) if value == int(value) else value


def _limited(value: float, limit: float) -> float:
    return _rounded(max(-limit, min(limit, value)))


def _approach(value: float, target: float, slope: float) -> float:
    return _rounded(min(target, value + slope) if target > value else max(target, value - slope))


def _rounded(value: float) -> float:
    # Not round(): the script in the browser must compute the same bits.
    return math.floor(value * GRAIN + 0.5) / GRAIN
