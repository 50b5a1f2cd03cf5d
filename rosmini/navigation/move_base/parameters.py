"""The parameters of `move_base/move_base` (http://wiki.ros.org/move_base#Parameters).

Ranges are those of its dynamic_reconfigure. The original declares 5.0 s for `controller_patience` there but uses 15.0;
here both are 15.0.
"""

from __future__ import annotations

from dataclasses import dataclass

from rosmini.core.parameters import Parameters, parameter


@dataclass(frozen=True)
class MoveBaseConfig(Parameters):
    """The parameters of `move_base` that can change at run time."""

    dynamic = True

    base_global_planner: str = parameter("navfn/NavfnROS", "the plugin that plans through the whole map")
    base_local_planner: str = parameter("base_local_planner/TrajectoryPlannerROS", "the plugin that follows the plan")
    planner_frequency: float = parameter(
        0.0, "planning rate; 0: for a new goal, and when the robot is stuck", unit="Hz", minimum=0.0, maximum=100.0
    )
    controller_frequency: float = parameter(20.0, "rate of velocity commands", unit="Hz", minimum=0.0, maximum=100.0)
    planner_patience: float = parameter(
        5.0, "how long to try to plan before recovering", unit="s", minimum=0.0, maximum=100.0
    )
    controller_patience: float = parameter(
        15.0, "how long to go without a command before recovering", unit="s", minimum=0.0, maximum=100.0
    )
    max_planning_retries: int = parameter(
        -1, "number of times to retry planning before recovering; -1: no limit", minimum=-1, maximum=1000
    )
    conservative_reset_dist: float = parameter(
        3.0,
        "the default recoveries clear cells farther from the robot than half of this",
        unit="m",
        minimum=0.0,
        maximum=50.0,
    )
    recovery_behavior_enabled: bool = parameter(True, "try to free a robot that is stuck")
    clearing_rotation_allowed: bool = parameter(True, "the default recoveries rotate the robot once")
    shutdown_costmaps: bool = parameter(False, "stop the costmaps while there is no goal")
    oscillation_timeout: float = parameter(
        0.0, "how long the robot may stay within oscillation_distance; 0: no limit", unit="s", minimum=0.0, maximum=60.0
    )
    oscillation_distance: float = parameter(
        0.5, "a move over this distance counts as progress", unit="m", minimum=0.0, maximum=10.0
    )
    make_plan_clear_costmap: bool = parameter(True, "clear the costmaps around the robot before make_plan")
    make_plan_add_unreachable_goal: bool = parameter(
        True, "append the goal to plans of make_plan that only come near it"
    )
    restore_defaults: bool = parameter(False, "reset all parameters to their initial values")


@dataclass(frozen=True)
class MoveBaseParameters(MoveBaseConfig):
    """All parameters of the node itself; costmaps, planners and recoveries have theirs in separate namespaces."""

    shared = True
    allowed = ("recovery_behaviors", "global_frame", "robot_base_frame")

    clearing_radius: float | None = parameter(
        None,
        "make_plan clears a square of twice this around the robot; by default ~local_costmap/circumscribed_radius",
        unit="m",
    )
