"""Things to touch in a notebook, each with a scripted twin that calls the same callbacks."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .pad import TeleopPad
from .teleop import Limits, Teleop, TeleopError

if TYPE_CHECKING:
    from rosmini.graph import Graph
    from rosmini.sim.simulator import Simulator

__all__ = ["Limits", "Teleop", "TeleopError", "TeleopPad", "teleop_pad"]


def teleop_pad(driven: Simulator | Graph, **options: Any) -> TeleopPad:
    """The renderer "teleop_pad": a pad for a simulator's robot, or for whatever listens on a graph; see `TeleopPad`."""
    return TeleopPad(driven, **options)
