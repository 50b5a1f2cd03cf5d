"""The initial robots of a simulator and their poses, from its parameters."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import ParameterError, RosminiError, nearest, shown
from rosmini.core.geometry.poses import Pose
from rosmini.core.names import check_name

from .models import RobotModel
from .models import model as model_called
from .world import World, WorldError

if TYPE_CHECKING:
    from rosmini.core.graph import Node

    from .engine.engine import Engine
    from .engine.robot import Robot

KEYS = ("name", "model", "x", "y", "yaw", "namespace", "tf_prefix")
"""Possible keys in an entry of the parameter `~robots`."""

MAX_ROBOTS = 1000
"""Maximum number of initial robots."""

START_HELP = "Say where with the arguments x:=, y:= and yaw:= of the launch file, or the parameters ~x, ~y and ~yaw"
"""Advice to the user if a start is occupied."""

GAP, RINGS = 0.05, 60
"""Spacing of the grid around the first start that is searched for a free pose [m], and its half-width in cells."""


@dataclass(frozen=True)
class Start:
    """An initial robot."""

    name: str
    model: RobotModel
    pose: Pose | None = None
    """None: it starts at the world's first free start, or nearby."""
    namespace: str = ""
    tf_prefix: str = ""


def read_starts(node: Node, model: RobotModel, world: World, pose: Pose | None, tf_prefix: str) -> list[Start]:
    """Return the robots of the parameter `~robots`, or the one described by the other parameters.

    `~robots` is a number n, for robots tb3_0 ... tb3_(n-1); or a list of names or of mappings with the keys `KEYS`.
    The namespace of a robot's topics and the prefix of its frames are its name if not given.
    Raises `ParameterError`.
    """
    given = node.get_param("~robots", None)
    if given is None:
        return [Start(model.name, model, pose, "", tf_prefix)]
    where = node.resolve_parameter("~robots")
    if isinstance(given, int) and not isinstance(given, bool) and 0 < given <= MAX_ROBOTS:
        given = [f"tb3_{i}" for i in range(given)]
    if not isinstance(given, list) or not 0 < len(given) <= MAX_ROBOTS:
        msg = (
            f"parameter {where} is {shown(given)}; it must be a number of robots, up to {MAX_ROBOTS}, or a list of "
            "their names or of what is to be known of each"
        )
        raise ParameterError(msg)
    starts = [_read(f"{where}[{i}]", entry, model, world) for i, entry in enumerate(given)]
    names = [start.name for start in starts]
    for name in names:
        if names.count(name) > 1:
            raise ParameterError(f"parameter {where}: two robots are called {name!r}; give them different names")
    return starts


def _read(where: str, entry: Any, model: RobotModel, world: World) -> Start:
    if isinstance(entry, str):
        entry = {"name": entry}
    if not isinstance(entry, dict) or not isinstance(entry.get("name"), str) or not entry["name"]:
        msg = (
            f"parameter {where} is {shown(entry)}; it must be the name of a robot, or a mapping "
            f"with a 'name' and any of {', '.join(KEYS[1:])}"
        )
        raise ParameterError(msg)
    for key, value in entry.items():
        if key not in KEYS:
            hint = nearest(key, KEYS) or f"the keys are {', '.join(KEYS)}"
            raise ParameterError(f"parameter {where}: a robot has no {key!r}; {hint}")
        number = key in ("x", "y", "yaw")
        if not isinstance(value, (int, float) if number else str) or isinstance(value, bool):
            kind = "a number" if number else "a string"
            raise ParameterError(f"parameter {where}/{key} is {shown(value)}; it must be {kind}")
    name = entry["name"]
    space = str(entry.get("namespace", name))
    return Start(
        name,
        model_called(entry["model"]) if "model" in entry else model,
        start_pose(world, entry.get("x"), entry.get("y"), entry.get("yaw")),
        space,
        str(entry.get("tf_prefix", space.strip("/"))),
    )


def start_pose(world: World, x: float | None, y: float | None, yaw: float | None) -> Pose | None:
    """Return a pose completed from the world's first start; None if all parts are None."""
    given = (x, y, yaw)
    if given == (None, None, None):
        return None
    px, py, theta = (own if part is None else float(part) for part, own in zip(given, world.starts[0], strict=True))
    return (px, py, theta)


def add(engine: Engine, start: Start) -> Robot:
    """Add a robot to the engine.

    Without a pose it gets a free start of the world, or else a free position near the first one.

    Raises `WorldError`, with the nearest free position, `RosminiError` for a name that is used, and `IllegalName` for
    an invalid namespace.
    """
    _check(start.name)
    check_name(start.namespace, f"namespace of the robot {start.name!r}")
    model = start.model
    if model.drive is None:
        msg = (
            f"{model.name!r} cannot be a robot of the simulator: its model has no drive. "
            "Add it to the engine, as a thing"
        )
        raise RosminiError(msg)
    if start.pose is None and start.name not in engine.robots:
        for pose in chain(engine.world.starts, _around(engine.world, 2 * model.reach + GAP)):
            if engine.obstruction(model, pose) is None:
                return engine.add(start.name, model, pose)
    outside = None if start.pose is None else engine.world.outside(start.pose)
    if outside and start.name not in engine.robots:
        raise WorldError(f"the robot {start.name!r} cannot start there: {outside}")
    return engine.add(start.name, model, start.pose)


def displacement(engine: Engine, start: Start) -> str:
    """Return a warning if a robot could not start at the world's first start because something is there."""
    first, model = engine.world.starts[0], start.model
    blocked = None if start.pose else engine.world.blocked(first, model.footprint, model.height)
    if blocked is None:
        return ""
    x, y, theta = engine.robot(start.name).pose
    wanted = f"({first[0]:.2f}, {first[1]:.2f})"
    there = f"the robot {start.name!r} cannot start at {wanted} in the world {engine.world.name!r}: {blocked} is there"
    return f"{there}. It starts at ({x:.2f}, {y:.2f}) with heading {theta:.2f}. {START_HELP}"


def _check(name: str) -> None:
    if not name or name.strip("/") != name or any(part.isspace() for part in name):
        msg = f"a robot cannot be called {name!r}: a name has letters, digits and underscores, as tb3_0"
        raise RosminiError(msg)


def _around(world: World, spacing: float) -> Iterator[Pose]:
    """Yield positions around the first start, `spacing` [m] apart, within the world's bounds, the nearest first."""
    x, y, theta = world.starts[0]
    x0, y0, x1, y1 = world.bounds
    cells = [(i, j) for i in range(-RINGS, RINGS + 1) for j in range(-RINGS, RINGS + 1)]
    for i, j in sorted(cells, key=lambda cell: math.hypot(*cell)):
        px, py = x + i * spacing, y + j * spacing
        if (x0 <= px <= x1 and y0 <= py <= y1) or x0 == x1:
            yield (px, py, theta)
