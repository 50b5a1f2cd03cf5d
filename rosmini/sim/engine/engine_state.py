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
    """A robot: its model, its place, its wheels, and the generator of their slips."""

    name: str
    model: RobotModel
    state: dict[str, Any]


@dataclass(frozen=True)
class EngineState:
    """An engine: see `rosmini.sim.engine.Engine.state`."""

    now_ns: int
    """The time [ns] since the engine began."""
    now: float
    """The same [s]."""
    world: World
    noise: float
    surface: Surface
    slips_ns: int
    """When the wheels' slip changes next."""
    robots: tuple[RobotState, ...]
    things: dict[str, tuple[Any, ...]]
    """What can be pushed, or put elsewhere: where it is, and how fast it moves."""
    movers: dict[str, tuple[int, float, bool, int]]
    """What moves by itself: since when it goes or waits, at which time of its own, which of the two, and its pace."""
    forces: tuple[float, list[tuple[str, str, float]]]
    """Until when which bodies push which others, and how hard."""
    trails: dict[str, tuple[Leg, ...]]
    """Where all were lately."""
