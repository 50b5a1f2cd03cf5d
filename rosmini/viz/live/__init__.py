"""Interactive views for a notebook, each with a scripted twin that calls the same callbacks."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .pad import TeleopPad
from .simulation_view import SimulationView
from .teleop import Limits, Teleop, TeleopError

if TYPE_CHECKING:
    from rosmini.core.graph import Graph
    from rosmini.sim.simulation import Simulation
    from rosmini.sim.turtlesim import TurtleSim

__all__ = ["Limits", "SimulationView", "Teleop", "TeleopError", "TeleopPad", "simulation_view", "teleop_pad"]


def teleop_pad(driven: Simulation | TurtleSim | Graph, **options: Any) -> TeleopPad:
    """The renderer "teleop_pad": a pad for a robot, a turtle, or the subscribers of a graph; see `TeleopPad`."""
    return TeleopPad(driven, **options)


def simulation_view(simulation: Simulation, **options: Any) -> SimulationView:
    """The renderer "simulation_view": a running world whose robots and boxes can be dragged; see `SimulationView`."""
    return SimulationView(simulation, **options)
