"""`carrot_planner/CarrotPlanner` (http://wiki.ros.org/carrot_planner)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from rosmini.core.parameters import Parameters, parameter
from rosmini.core.time import Time
from rosmini.navigation.base_local_planner.costmap_model import footprint_cost
from rosmini.navigation.nav_core import BaseGlobalPlanner, GoalBlocked, PlanningFailure, planar_pose, pose_stamped

from .carrot import nearest_legal_pose


@dataclass(frozen=True)
class CarrotParameters(Parameters):
    """The parameters of `carrot_planner/CarrotPlanner`, in `~CarrotPlanner/`."""

    step_size: float | None = parameter(
        None, "has no effect, as in ROS: a step is a hundredth of the distance", unit="m"
    )
    min_dist_from_robot: float = parameter(0.10, "has no effect, as in ROS", unit="m")


class CarrotPlanner(BaseGlobalPlanner, plugin="carrot_planner/CarrotPlanner"):
    """Plans two poses: the start, and the pose nearest to the goal on the line to it where the footprint fits.

    Obstacles along the line are ignored; avoiding them is the task of the local planner.
    """

    def initialize(self, name: str, costmap: Any) -> None:
        """Read the parameters in `~name/`."""
        super().initialize(name, costmap)
        self.node = costmap.node
        self.parameters = CarrotParameters.read(self.node, f"~{name}")

    def make_plan(self, start: Any, goal: Any) -> Sequence[Any]:
        """Return the start and the carrot. Raises a `PlanningFailure` if the footprint fits nowhere on the line."""
        frame = goal.header.frame_id.lstrip("/")
        if frame != self.costmap.global_frame:
            text = (
                f"This planner as configured will only accept goals in the {self.costmap.global_frame} frame, but a "
                f"goal was sent in the {frame} frame."
            )
            self.node.logerr(text)
            raise PlanningFailure(text, frame=frame, expected=self.costmap.global_frame)
        begin, end = planar_pose(start), planar_pose(goal)
        footprint = self.costmap.footprint
        target = nearest_legal_pose(
            begin, end, lambda pose: len(footprint) > 2 and footprint_cost(self.costmap.grid, pose, footprint) >= 0
        )
        if target is None:
            text = "The carrot planner could not find a valid plan for this goal"
            self.node.logwarn(text)
            raise GoalBlocked(
                f"{text}: on the line from ({begin[0]:.2f}, {begin[1]:.2f}) to ({end[0]:.2f}, {end[1]:.2f}) the "
                "footprint touches an obstacle everywhere, even at the start",
                start=begin[:2],
                goal=end[:2],
            )
        stamp = Time.from_nsec(self.node.clock.now_ns())
        return [start, pose_stamped(self.costmap.global_frame, stamp, target)]
