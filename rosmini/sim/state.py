"""Everything that is and moves in an engine at one moment: plain data, which may be copied, pickled, and brought back."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from rosmini.geometry.poses import Pose

from .models import RobotModel
from .world import World

if TYPE_CHECKING:
    from .physics import RoverMemory, Surface


@dataclass(frozen=True)
class RobotState:
    """A robot: its model, its place, its wheels, and the generator of their slips."""

    name: str
    model: RobotModel
    state: dict[str, Any]


@dataclass(frozen=True)
class EngineState:
    """An engine: see `rosmini.sim.engine.Engine.state`."""

    now: float
    world: World
    noise: float
    step: float
    surface: Surface
    slips: float
    """When the wheels' slip changes next [s]."""
    moving: bool
    """Whether something that was pushed still moves."""
    robots: tuple[RobotState, ...]
    things: dict[str, tuple[Pose, tuple[float, float, float]]]
    """What is not fixed: where it is, and how fast it moves."""
    movers: dict[str, tuple[float, Pose, float, bool]]
    """What moves by itself: its clock, its place, its room, and whether it waits."""
    bodies: dict[str, RoverMemory]
    """What the bodies of robots have that may touch something."""
