"""`navfn/navfn_node` and `global_planner/planner`: a planner with a costmap, but without driving.

| | |
|---|---|
| parameters | `~costmap/` (those of costmap_2d), `~navfn_planner/` or `~planner/` (those of the planner) |
| service | `~make_plan` (navfn/MakeNavPlan), with start and goal in the costmap's frame |
| topic | `~goal` (geometry_msgs/PoseStamped): plans from the robot's pose, and the planner publishes `plan` |
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from rosmini.core.tf import TransformListener
from rosmini.msgs import message_class, service_class
from rosmini.navigation.costmap_2d.costmap_ros import Costmap2DROS
from rosmini.navigation.nav_core import BaseGlobalPlanner, NavigationFailure

if TYPE_CHECKING:
    from rosmini.core.graph import Node


class PlannerNode:
    """`navfn/navfn_node`."""

    plugin: ClassVar[str] = "navfn/NavfnROS"
    name: ClassVar[str] = "navfn_planner"

    def __init__(self, node: Node) -> None:
        self.node = node
        self.costmap = Costmap2DROS("costmap", TransformListener(node).buffer, node)
        self.planner = BaseGlobalPlanner.create(self.plugin)
        self.planner.initialize(self.name, self.costmap)
        self._response = service_class("navfn/MakeNavPlan")._response_class
        node.service("~make_plan", service_class("navfn/MakeNavPlan"), self._serve)
        node.subscriber("~goal", message_class("geometry_msgs/PoseStamped"), self._goal, queue_size=1)

    def _serve(self, request: Any) -> Any:
        for pose in (request.start, request.goal):
            pose.header.frame_id = self.costmap.global_frame
        response = self._response()
        try:
            response.path = list(self.planner.make_plan(request.start, request.goal))
            response.plan_found = 1
        except NavigationFailure as failure:
            response.error_message = str(failure)
        return response

    def _goal(self, goal: Any) -> None:
        try:
            self.planner.make_plan(self.costmap.robot_pose(), goal)
        except NavigationFailure as failure:
            self.node.logwarn(f"no plan to ({goal.pose.position.x:.2f}, {goal.pose.position.y:.2f}): {failure}")
