"""The base class of grid planners: checks of poses, conversion of plans, the topic `plan` and service `make_plan`."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.time import Time
from rosmini.msgs import message_class, service_class
from rosmini.navigation.nav_core import BaseGlobalPlanner, OutsideMap, PlanningFailure

from .search import Search

Poses = list[Any]

OFF_MAP_START = (
    "The robot's start position is off the global costmap. Planning will always fail, are you sure the robot has been "
    "properly localized?"
)
OFF_MAP_GOAL = "The goal sent to the {} planner is off the global costmap. Planning will always fail to this goal."
"""Messages of both planners in ROS."""


class GridPlanner(BaseGlobalPlanner):
    """A global planner that searches the costmap; it publishes `~name/plan` and offers `~name/make_plan`."""

    search: Search | None = None
    """The latest search, for pictures."""
    default_tolerance: float = 0.0

    def initialize(self, name: str, costmap: Any) -> None:
        """Read the parameters in `~name/`, and advertise the topic and the service."""
        super().initialize(name, costmap)
        self.node = costmap.node
        self.grid = costmap.grid
        self._read_parameters()
        self._path = message_class("nav_msgs/Path")
        self._pose = message_class("geometry_msgs/PoseStamped")
        self._plans = self.node.publisher(f"~{name}/plan", self._path, queue_size=1)
        self._plans.expect_nobody()
        self.node.service(f"~{name}/make_plan", service_class("nav_msgs/GetPlan"), self._serve)

    @abstractmethod
    def _read_parameters(self) -> None: ...

    @abstractmethod
    def _plan(self, start: Any, goal: Any, tolerance: float) -> Poses: ...

    def make_plan(self, start: Any, goal: Any, tolerance: float | None = None) -> Sequence[Any]:
        """Return poses from start to goal, or to the nearest point within `tolerance` [m] (default: the parameter).

        Raises a `PlanningFailure` with the reason if there is no plan. The plan is published, even if it is empty.
        """
        self.search = None
        for what, pose in (("goal", goal), ("start", start)):
            frame = pose.header.frame_id.lstrip("/")
            if frame != self.costmap.global_frame:
                text = (
                    f"The {what} pose passed to this planner must be in the {self.costmap.global_frame} frame.  "
                    f"It is instead in the {frame} frame."
                )
                self.node.logerr(text)
                raise PlanningFailure(text, frame=frame, expected=self.costmap.global_frame)
        try:
            plan = self._plan(start, goal, self.default_tolerance if tolerance is None else tolerance)
        except PlanningFailure:
            self._publish([])
            raise
        self._publish(plan)
        return plan

    def now(self) -> Time:
        """Return the graph's time."""
        return Time.from_nsec(self.node.clock.now_ns())

    def point(self, pose: Any, off_map: str, offset: float) -> tuple[float, float]:
        """Return a pose's position on the grid (column, row); with an offset of 0.5 whole numbers are cell centres.

        Raises `OutsideMap` if it is outside the grid or not finite; the message starts with `off_map`.
        """
        x, y = pose.pose.position.x, pose.pose.position.y
        finite = math.isfinite(x) and math.isfinite(y)
        if not finite or self.grid.world_to_map(x, y) is None:
            left, bottom = self.grid.origin
            width, height = self.grid.size_m
            self.node.logwarn(off_map, throttle=1.0)
            raise OutsideMap(
                f"{off_map} It is at ({x:.2f}, {y:.2f}), and the costmap is from ({left:.2f}, {bottom:.2f}) to "
                f"({left + width:.2f}, {bottom + height:.2f}).",
                point=(x, y),
                map=(left, bottom, left + width, bottom + height),
            )
        column = (x - self.grid.origin[0]) / self.grid.resolution - offset
        row = (y - self.grid.origin[1]) / self.grid.resolution - offset
        return column, row

    def poses(self, path: NDArray[np.float64], offset: float) -> Poses:
        """Return `PoseStamped` messages for a path (n, 2) of columns and rows, stamped with the current time.

        `offset` is that of `point`.
        """
        made, stamp, frame = [], self.now(), self.costmap.global_frame
        for x, y in (path + offset) * self.grid.resolution + np.asarray(self.grid.origin):
            pose = self._pose()
            pose.header.stamp, pose.header.frame_id = stamp, frame
            pose.pose.position.x, pose.pose.position.y = float(x), float(y)
            pose.pose.orientation.w = 1.0
            made.append(pose)
        return made

    def pose_like(self, goal: Any, x: float, y: float) -> Any:
        """Return a copy of a goal at another point, stamped with the current time."""
        pose = self._pose()
        pose.header.stamp, pose.header.frame_id = self.now(), self.costmap.global_frame
        pose.pose.position.x, pose.pose.position.y, pose.pose.position.z = x, y, goal.pose.position.z
        q, given = pose.pose.orientation, goal.pose.orientation
        q.x, q.y, q.z, q.w = given.x, given.y, given.z, given.w
        return pose

    def _publish(self, plan: Poses) -> None:
        if not self._plans.num_connections():
            return
        message = self._path()
        message.header.frame_id = self.costmap.global_frame
        message.header.stamp = plan[0].header.stamp if plan else self.now()
        message.poses = plan
        self._plans.publish(message)

    def _serve(self, request: Any) -> Any:
        response = service_class("nav_msgs/GetPlan")._response_class()
        try:
            response.plan.poses = list(self.make_plan(request.start, request.goal))
        except PlanningFailure as failure:
            self.node.logwarn(f"make_plan: {failure}")
        response.plan.header.stamp, response.plan.header.frame_id = self.now(), self.costmap.global_frame
        return response
