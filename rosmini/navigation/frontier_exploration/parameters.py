"""Parameters of the layer and the server; the client has none."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from rosmini.core.parameters import Parameters, parameter
from rosmini.navigation.costmap_2d.parameters import LayerConfig

CLOSEST, MIDDLE, CENTROID = "closest", "middle", "centroid"


@dataclass(frozen=True)
class BoundedExploreParameters(LayerConfig):
    """Parameters of `frontier_exploration::BoundedExploreLayer`."""

    explore_clear_space: bool = parameter(
        True,
        "whether everything inside the boundary is unknown initially, so that known space is explored again",
    )
    resize_to_boundary: bool = parameter(True, "whether the costmap gets the size of the boundary")
    frontier_travel_point: str = parameter(
        CLOSEST,
        "the point of a frontier to drive to",
    )


@dataclass(frozen=True)
class ExploreServerParameters(Parameters):
    """Parameters of `explore_server`."""

    allowed: ClassVar[tuple[str, ...]] = ("explore_costmap",)

    frequency: float = parameter(
        0.0, "how often to look for the next frontier; 0: when the last is reached", unit="Hz"
    )
    goal_aliasing: float = parameter(
        0.1, "a goal within half of this distance of the last one is not sent", unit="m"
    )
