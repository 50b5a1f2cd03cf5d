"""The state of an engine: plain data that can be copied, pickled and restored."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from rosmini.sim.models import RobotModel
from rosmini.sim.world import World

from .bodies import Surface
from .trails import Leg


@dataclass(frozen=True)
class RobotState:
    """A robot's name, its model, and its `state`, as returned by `Robot.state`."""

    name: str
    model: RobotModel
    state: dict[str, Any]


@dataclass(frozen=True)
class EngineState:
    """The state of an engine: see `rosmini.sim.engine.Engine.state`."""

    now_ns: int
    """The time [ns] since the engine began."""
    now: float
    """The same [s]."""
    world: World
    noise: float
    surface: Surface
    slips_ns: int
    """Time of the next change of the wheels' slip [ns]."""
    robots: tuple[RobotState, ...]
    things: dict[str, tuple[Any, ...]]
    """Poses and velocities of the obstacles that can be pushed or put elsewhere."""
    movers: dict[str, tuple[int, float, bool, int]]
    """For each mover: time of its last start or stop [ns], its clock then [s], whether it waits, and its pace."""
    forces: tuple[float, list[tuple[str, str, float]]]
    """Time until which they apply [ns], and for each pair of bodies the force between them [N]."""
    trails: dict[str, tuple[Leg, ...]]
    """Recent poses of all bodies."""
