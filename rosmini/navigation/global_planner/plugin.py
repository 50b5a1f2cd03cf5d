"""`global_planner/GlobalPlanner` (http://wiki.ros.org/global_planner)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from rosmini.core.dynamic_reconfigure import Server
from rosmini.core.geometry.angles import quaternion_from_yaw, yaw_from_quaternion
from rosmini.core.parameters import Parameters, parameter
from rosmini.msgs import message_class
from rosmini.navigation.nav_core import PlanningFailure
from rosmini.navigation.navfn.planning import OFF_MAP_GOAL, OFF_MAP_START, GridPlanner, Poses
from rosmini.navigation.navfn.search import Search, cell_of

from .orientations import orient
from .search import COST_FACTOR, LETHAL_COST, NEUTRAL_COST, GlobalAStar, GlobalDijkstra


@dataclass(frozen=True)
class GlobalPlannerConfig(Parameters):
    """The parameters of `global_planner/GlobalPlanner` that can change at run time."""

    dynamic = True

    lethal_cost: int = parameter(LETHAL_COST, "the lowest cost that no plan enters", minimum=1, maximum=255)
    neutral_cost: int = parameter(NEUTRAL_COST, "the cost of each step", minimum=1, maximum=255)
    cost_factor: float = parameter(
        COST_FACTOR, "the factor of the costmap's costs (Dijkstra)", minimum=0.01, maximum=5.0
    )
    publish_potential: bool = parameter(True, "whether to publish the potential")
    orientation_mode: int = parameter(
        1,
        "headings of the plan: 0 None, 1 Forward, 2 Interpolate, 3 ForwardThenInterpolate, 4 Backward, 5 Leftward, "
        "6 Rightward",
        minimum=0,
        maximum=6,
    )
    orientation_window_size: int = parameter(
        1, "number of points before and after that give the path's direction", minimum=1, maximum=255
    )


@dataclass(frozen=True)
class GlobalPlannerParameters(GlobalPlannerConfig):
    """All parameters of `global_planner/GlobalPlanner`, in `~GlobalPlanner/`."""

    old_navfn_behavior: bool = parameter(
        False, "plan between cell centres and shift points by half a cell to the lower left, as navfn does"
    )
    use_quadratic: bool = parameter(True, "interpolate the potential between two neighbours")
    use_dijkstra: bool = parameter(True, "Dijkstra, or else A*")
    use_grid_path: bool = parameter(False, "a path from cell to cell, or else down the gradient")
    allow_unknown: bool = parameter(True, "whether plans may lead through unknown cells")
    planner_window_x: float = parameter(0.0, "has no effect, as in ROS", unit="m")
    planner_window_y: float = parameter(0.0, "has no effect, as in ROS", unit="m")
    default_tolerance: float = parameter(0.0, "has no effect, as in ROS: a plan ends at the goal", unit="m")
    publish_scale: int = parameter(100, "the published value of the highest potential")
    outline_map: bool = parameter(True, "treat the outermost cells as lethal")


class GlobalPlanner(GridPlanner, plugin="global_planner/GlobalPlanner"):
    """Computes a potential with Dijkstra's algorithm or A*, and a path by gradient descent or from cell to cell.

    With `use_quadratic`, the potential of a cell is interpolated between two neighbours.

    Topics: `~NAME/plan` (nav_msgs/Path), `~NAME/potential` (nav_msgs/OccupancyGrid; -1 for cells that were not
    reached). Service: `~NAME/make_plan` (nav_msgs/GetPlan). The parameters of `GlobalPlannerConfig` can be
    changed with dynamic_reconfigure.
    """

    def _read_parameters(self) -> None:
        self.parameters = GlobalPlannerParameters.read(self.node, f"~{self.name}")
        self._offset = 0.0 if self.parameters.old_navfn_behavior else 0.5
        self._grid_message = message_class("nav_msgs/OccupancyGrid")
        self._potentials = self.node.publisher(f"~{self.name}/potential", self._grid_message, queue_size=1)
        self._potentials.expect_nobody()
        self._server = Server(self.node, GlobalPlannerConfig, self._reconfigure, namespace=f"~{self.name}/")

    def _reconfigure(self, config: Any, _: int) -> Any:
        self.config = config
        return config

    def _plan(self, start: Any, goal: Any, tolerance: float) -> Poses:  # noqa: ARG002 - as in the original
        begin = self.point(start, OFF_MAP_START, 0.5)
        end = self.point(goal, OFF_MAP_GOAL.format("global"), 0.5)
        if self.parameters.old_navfn_behavior:
            begin, end = cell_of(begin), cell_of(end)
        self.search = search = self._search(begin, end)
        search.expand()
        if self.config["publish_potential"]:
            self._publish_potential(search)
        if not search.arrived:
            self.node.logerr("Failed to get a plan.")
            raise search.failure(self.grid)
        try:
            path = search.path()
        except PlanningFailure:
            self.node.logerr(
                "Failed to get a plan from potential when a legal potential was found. This shouldn't happen."
            )
            raise
        plan = self.poses(path, self._offset)
        plan.append(self.pose_like(goal, goal.pose.position.x, goal.pose.position.y))
        self._set_headings(plan, start)
        return plan

    def _search(self, begin: tuple[float, float], end: tuple[float, float]) -> Search:
        own, config = self.parameters, self.config
        options: dict[str, Any] = {
            "allow_unknown": own.allow_unknown,
            "quadratic": own.use_quadratic,
            "grid_path": own.use_grid_path,
            "precise": not own.old_navfn_behavior,
            "outline": own.outline_map,
            "lethal_cost": config["lethal_cost"],
            "neutral_cost": config["neutral_cost"],
        }
        if own.use_dijkstra:
            return GlobalDijkstra(self.grid.costs, begin, end, cost_factor=config["cost_factor"], **options)
        return GlobalAStar(self.grid.costs, begin, end, **options)

    def _set_headings(self, plan: Poses, start: Any) -> None:
        """Set the headings of all poses but the last, as `orientation_mode` specifies."""
        poses = np.zeros((len(plan), 3))
        poses[:, :2] = [(each.pose.position.x, each.pose.position.y) for each in plan]
        poses[-1, 2] = _yaw(plan[-1])
        turned = orient(poses, self.config["orientation_mode"], _yaw(start), self.config["orientation_window_size"])
        for each, yaw in zip(plan[:-1], turned[:-1, 2], strict=True):
            q = each.pose.orientation
            q.x, q.y, q.z, q.w = quaternion_from_yaw(float(yaw))

    def _publish_potential(self, search: Search) -> None:
        """Publish the potential as a map: the highest one becomes `publish_scale`, unreached cells -1."""
        message = self._grid_message()
        message.header.stamp, message.header.frame_id = self.now(), self.costmap.global_frame
        message.info.resolution = self.grid.resolution
        message.info.width, message.info.height = search.width, search.height
        origin = message.info.origin
        origin.position.x, origin.position.y = self.grid.origin
        origin.orientation.w = 1.0
        highest = max(1.0, float(np.max(search.potential, where=search.reached, initial=0.0)))
        scaled = np.full(search.potential.shape, -1, dtype=np.int8)
        shares = search.potential[search.reached] * (self.parameters.publish_scale / highest)
        scaled[search.reached] = shares.astype(np.int64).astype(np.int8)  # a scale above 127 wraps, as in ROS
        message.data = scaled.ravel()
        self._potentials.publish(message)


def _yaw(pose: Any) -> float:
    q = pose.pose.orientation
    length = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w
    return yaw_from_quaternion(q.x, q.y, q.z, q.w) if 0 < length < float("inf") else 0.0
