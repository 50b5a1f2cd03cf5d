"""The parameters of `explore`."""

from __future__ import annotations

from dataclasses import dataclass

from rosmini.core.parameters import Parameters, parameter


@dataclass(frozen=True)
class ExploreParameters(Parameters):
    """The private parameters of the node."""

    robot_base_frame: str = parameter("base_link", "the robot's frame")
    costmap_topic: str = parameter("costmap", "the topic of a map or costmap")
    costmap_updates_topic: str = parameter("costmap_updates", "and its updates")
    visualize: bool = parameter(False, "whether frontiers are published on ~frontiers")
    planner_frequency: float = parameter(1.0, "how often a goal is chosen", unit="Hz", minimum=1e-3)
    progress_timeout: float = parameter(30.0, "a goal without progress for this time is given up", unit="s")
    potential_scale: float = parameter(1e-3, "the weight of a frontier's distance")
    orientation_scale: float = parameter(0.0, "has no effect, as in ROS")
    gain_scale: float = parameter(1.0, "the weight of a frontier's size")
    transform_tolerance: float = parameter(0.3, "how old the robot's pose may be", unit="s")
    min_frontier_size: float = parameter(0.5, "smaller frontiers are ignored", unit="m")
    return_to_init: bool = parameter(False, "whether the robot finally returns to its start")
