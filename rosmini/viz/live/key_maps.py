"""Key maps of ROS's teleoperation programs, for a pad.

The tables are read from the programs that rosmini supplies for terminals: keys, steps, factors and speeds are the
literals at the top of the scripts in `assets/ros`. rosmini adds the buttons, and the arrow keys if a program has
none.
"""

from __future__ import annotations

import ast
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from types import MappingProxyType
from typing import Any

from rosmini.core.errors import RosminiError, nearest
from rosmini.core.packages import assets_dir

Move = tuple[float, float, float, float]
"""Motion of a key: forward, left, up, and a turn to the left."""

ARROWS = {"up": "ArrowUp", "down": "ArrowDown", "left": "ArrowLeft", "right": "ArrowRight"}
SPOKEN = MappingProxyType({"space": " ", **ARROWS})
"""Names of the keys without a letter; browsers use the values."""


class TeleopError(RosminiError, ValueError):
    """An unknown key, invalid limits, or a robot that no longer exists."""


@dataclass(frozen=True)
class KeyMap:
    """The keys of one teleoperation program, under the names that browsers use, and their effects."""

    name: str
    """Name of the program, such as `turtlebot3_teleop_key`."""
    moves: Mapping[str, Move]
    """Motion per key: in steps if `adds`, else a direction with components from -1 to 1."""
    linear: float
    """Linear step, or initial linear speed [m/s]."""
    angular: float
    """Angular step, or initial angular speed [rad/s]."""
    stops: tuple[str, ...]
    """Keys that stop the robot."""
    buttons: tuple[str, ...]
    """Buttons of the page: three rows of three keys, "" for an empty place."""
    adds: bool = False
    """True if each key adds a step to the target; otherwise it sets the target."""
    others_stop: bool = False
    """True if an unassigned key stops the robot."""
    factors: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    """Factors by which keys multiply the linear and the angular speed."""
    holds: float | None = None
    """Time [s] for which the robot or turtle follows one message before it stops; None if the message is sent
    repeatedly."""

    @property
    def keys(self) -> tuple[str, ...]:
        """All assigned keys."""
        return (*self.moves, *self.factors, *self.stops)

    def named(self, name: str) -> str:
        """Return the key for `name`: the browser's name in any case, or "space", "up", "down", "left", "right".

        Raises `TeleopError` with the closest name, or with all names.
        """
        lower = name.lower()
        arrows = (arrow for arrow in ARROWS.values() if arrow.lower() == lower)
        for key in (name, lower, SPOKEN.get(lower), *arrows):
            if key in self.keys:
                return key
        if self.others_stop and len(name) == 1:
            return self.stops[0]
        spoken = {key: word for word, key in SPOKEN.items()}
        names = [spoken.get(key, key) for key in self.keys]
        guess = nearest(name, names) if len(name) > 1 else None
        raise TeleopError(
            f"the pad has no key {name!r}; {guess or 'it has ' + ', '.join(dict.fromkeys(names))}. {self.help}"
        )

    @property
    def help(self) -> str:
        """One sentence that describes the keys."""
        return _HELP[self.name]


_HELP = MappingProxyType(
    {
        "turtlebot3_teleop_key": "w and x: faster and slower, a and d: left and right, s or space: stop.",
        "teleop_twist_keyboard": "i and ,: ahead and back, j and l: turn, u, o, m and .: both, k or space: stop; "
        "with Shift sideways; t and b: up and down; q and z, w and x, e and c: faster and slower.",
        "turtle_teleop_key": "the arrow keys: ahead, back and turns, a second each; space: stop.",
    }
)
NAMES = tuple(_HELP)
"""Names of the programs whose keys a pad can use."""


@cache
def key_map(name: str = "turtlebot3_teleop_key") -> KeyMap:
    """Return the key map of a program. Raises `TeleopError` for an unknown name, with the closest one."""
    if name == "turtlebot3_teleop_key":
        told = _literals("turtlebot3_teleop", name)
        steps = {key: (ahead, 0.0, 0.0, turn) for key, (ahead, turn) in told["STEPS"].items()}
        linear = max(ahead for ahead, *_ in steps.values())
        angular = max(turn for *_, turn in steps.values())
        moves = {key: (v / linear, 0.0, 0.0, w / angular) for key, (v, _, _, w) in steps.items()}
        buttons = ("", "w", "", "a", "s", "d", "", "x", "")
        return KeyMap(name, _with_arrows(moves, "wxad"), linear, angular, told["STOP"][::-1], buttons, adds=True)
    if name == "teleop_twist_keyboard":
        told = _literals(name, f"{name}.py")
        return KeyMap(
            name, _with_arrows(told["MOVES"], "i,jl"), told["SPEED"], told["TURN"], ("k", " "), tuple("uiojklm,."),
            others_stop=True, factors=MappingProxyType(told["FACTORS"]),
        )  # fmt: skip
    if name == "turtle_teleop_key":
        told = _literals("turtlesim", name)
        codes = dict(zip("ABDC", ARROWS.values(), strict=True))  # the ends of what a terminal sends for arrow keys
        moves = {codes[key]: (ahead, 0.0, 0.0, turn) for key, (ahead, turn) in told["KEYS"].items()}
        buttons = ("", "ArrowUp", "", "ArrowLeft", " ", "ArrowRight", "", "ArrowDown", "")
        scale = told["SCALE"]
        return KeyMap(name, MappingProxyType(moves), scale, scale, (" ",), buttons, holds=told["HOLD"])
    guess = nearest(name, NAMES) or f"the programs are {', '.join(NAMES)}"
    raise TeleopError(f"no program {name!r} with keys is known; {guess}")


def burger_limits() -> tuple[float, float]:
    """Return the maximum speeds of a TurtleBot3 Burger: linear [m/s], angular [rad/s]."""
    linear, angular = _literals("turtlebot3_teleop", "turtlebot3_teleop_key")["LIMITS"]["burger"]
    return linear, angular


def _with_arrows(moves: Mapping[str, Any], keys: str) -> Mapping[str, Move]:
    """Give the up, down, left and right arrows the effects of these keys."""
    known = {key: tuple(float(part) for part in move) for key, move in moves.items()}
    arrows = {arrow: known[key] for arrow, key in zip(ARROWS.values(), keys, strict=True)}
    return MappingProxyType(known | arrows)  # type: ignore[arg-type]  # four parts each


@cache
def _literals(package: str, script: str) -> Mapping[str, Any]:
    """Return the literals that a packaged script assigns at its top, without running the script."""
    path = assets_dir() / "ros" / package / "nodes" / script
    found: dict[str, Any] = {}
    for statement in ast.parse(path.read_text(encoding="utf-8")).body:
        if not isinstance(statement, ast.Assign):
            continue
        try:
            value = ast.literal_eval(statement.value)
        except ValueError:
            continue
        for target in statement.targets:
            if isinstance(target, ast.Tuple):
                found.update(
                    (each.id, part) for each, part in zip(target.elts, value, strict=True) if isinstance(each, ast.Name)
                )
            elif isinstance(target, ast.Name):
                found[target.id] = value
    return found
