"""`navfn/NavfnROS`, the default global planner of `move_base` (http://wiki.ros.org/navfn)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from rosmini.core.parameters import Parameters, parameter
from rosmini.msgs import message_class
from rosmini.navigation.nav_core import OutsideMap
from rosmini.navigation.nav_core.clouds import point_cloud

from .planning import OFF_MAP_GOAL, OFF_MAP_START, GridPlanner, Poses
from .search import NavfnSearch, cell_of
from .wave import HIGH


@dataclass(frozen=True)
class NavfnParameters(Parameters):
    """The parameters of `navfn/NavfnROS`, in `~NavfnROS/`."""

    allow_unknown: bool = parameter(True, "whether plans may lead through unknown cells")
    planner_window_x: float = parameter(0.0, "has no effect, as in ROS", unit="m")
    planner_window_y: float = parameter(0.0, "has no effect, as in ROS", unit="m")
    default_tolerance: float = parameter(
        0.0, "maximum distance along each axis from a plan's end to the goal", unit="m"
    )
    visualize_potential: bool = parameter(False, "whether to publish the potential as a cloud of points")


class NavfnROS(GridPlanner, plugin="navfn/NavfnROS"):
    """Dijkstra's algorithm with an interpolated potential, and a path down its gradient.

    Topics: `~NAME/plan` (nav_msgs/Path), `~NAME/potential` (sensor_msgs/PointCloud2) with `visualize_potential`.
    Service: `~NAME/make_plan` (nav_msgs/GetPlan). Two differences from the original are intentional: the points of
    the plan are cell centres, where the original's are shifted by half a cell to the lower left; and the goal itself
    is tried before other points within the tolerance.
    """

    def _read_parameters(self) -> None:
        own = NavfnParameters.read(self.node, f"~{self.name}")
        self.parameters = own
        self.default_tolerance = own.default_tolerance
        self._potentials = (
            self.node.publisher(f"~{self.name}/potential", message_class("sensor_msgs/PointCloud2"), queue_size=1)
            if own.visualize_potential
            else None
        )

    def _plan(self, start: Any, goal: Any, tolerance: float) -> Poses:
        begin = cell_of(self.point(start, OFF_MAP_START, 0.5))
        try:
            end = cell_of(self.point(goal, OFF_MAP_GOAL.format("navfn"), 0.5))
        except OutsideMap:
            if tolerance <= 0:
                raise
            end = cell_of(self.grid.world_to_map_clamped(goal.pose.position.x, goal.pose.position.y))
        self.search = search = NavfnSearch(self.grid.costs, begin, end, allow_unknown=self.parameters.allow_unknown)
        search.expand()
        x, y = self._reachable(search, goal.pose.position.x, goal.pose.position.y, tolerance)
        cell = self.grid.world_to_map_clamped(x, y)
        self._publish_potential(search, cell)
        return [*self.poses(search.path_to(cell), 0.5), self.pose_like(goal, x, y)]

    def _reachable(self, search: NavfnSearch, x: float, y: float, tolerance: float) -> tuple[float, float]:
        """Return the goal or else the nearest reachable point on a lattice of cell size within the tolerance."""
        offsets = np.arange(-tolerance, tolerance + 1e-9, self.grid.resolution)
        offsets = np.concatenate([[0.0], offsets])
        points = [(x + dx, y + dy) for dy in offsets for dx in offsets]
        points.sort(key=lambda point: math.hypot(point[0] - x, point[1] - y))
        for point in points:
            cell = self.grid.world_to_map(*point)
            if cell is not None and search.potential_at(cell) < HIGH:
                return point
        self._publish_potential(search, None)
        raise search.failure(self.grid)

    def _publish_potential(self, search: NavfnSearch, goal: tuple[int, int] | None) -> None:
        """Publish the reached cells: x, y, height (20 at the goal) and potential."""
        if self._potentials is None:
            return
        rows, columns = np.nonzero(search.reached)
        potential = search.potential[rows, columns]
        at_goal = max(1.0, float(potential.max()) if goal is None else search.potential_at(goal))
        points = np.empty((len(rows), 4))
        points[:, 0] = self.grid.origin[0] + (columns + 0.5) * self.grid.resolution
        points[:, 1] = self.grid.origin[1] + (rows + 0.5) * self.grid.resolution
        points[:, 2] = potential / at_goal * 20
        points[:, 3] = potential
        self._potentials.publish(point_cloud(self.costmap.global_frame, self.now(), ("x", "y", "z", "pot"), points))
