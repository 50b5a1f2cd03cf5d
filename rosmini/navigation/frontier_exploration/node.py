"""`frontier_exploration/explore_server`: drives to one frontier after another until none is left in an area.

It offers an action with the node's name (`frontier_exploration/ExploreTask`), has a separate costmap,
`~explore_costmap`, with a `BoundedExploreLayer` called `explore_boundary`, and sends goals to `move_base`.

Differences from the original: there the exploration ends with the first goal that move_base aborts ("Failed to move").
Here such a goal is tried once more when no other is left, and then ignored. The result names the goals that were given
up, and is a failure if the robot has been stuck for several goals. A goal that was replaced several times by a nearer
one is kept: in a maze each of two may become the nearer one while the robot drives to the other. Before it asks again
for a frontier, it waits for an update of the costmap; each goal has five attempts; and the task ends if the robot's
pose stays unknown.
"""

from __future__ import annotations

import math
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from rosmini.core.actionlib import SimpleActionClient, SimpleActionServer, Status
from rosmini.core.errors import ROSException, ServiceException
from rosmini.core.graph import Node
from rosmini.core.parameters import Parameters, parameter
from rosmini.core.tf import TransformException, TransformListener
from rosmini.msgs import message_class, service_class
from rosmini.navigation.costmap_2d.costmap_ros import Costmap2DROS
from rosmini.navigation.costmap_2d.footprint import points_of
from rosmini.navigation.nav_core import TransformMissing, planar_pose, pose_stamped

from .plugin import BoundedExploreLayer, points_in_frame
from .polygon import contains
from .search import Blacklist

ATTEMPTS = 5
"""Number of repeated requests for a frontier before the exploration ends."""
RETRY_PERIOD = 0.2
"""Interval between two requests [s]."""
WARN_PERIOD = 5.0
"""Interval between warnings while move_base is missing [s]."""
STUCK_GOALS = 3
"""The robot counts as stuck after this number of consecutive aborted goals within `STUCK_DISTANCE`."""
STUCK_DISTANCE = 0.3
"""Maximum distance between the positions of a robot that is stuck [m]."""
MAX_REPLACEMENTS = 3
"""A goal replaced this many times is kept until the robot arrives or move_base aborts it."""
POSE_TIMEOUT = 30.0
"""Time [s] after which an unknown pose ends the task."""


@dataclass(frozen=True)
class ExploreServerParameters(Parameters):
    """Parameters of `explore_server`."""

    allowed: ClassVar[tuple[str, ...]] = ("explore_costmap",)

    frequency: float = parameter(
        0.0, "rate of the search for the next frontier; 0: when the last is reached", unit="Hz"
    )
    goal_aliasing: float = parameter(0.1, "a goal within half of this distance of the last one is not sent", unit="m")


class ExploreServer:
    """The `explore_server` node."""

    def __init__(self, node: Node) -> None:
        self.node = node
        self.parameters = ExploreServerParameters.read(node)
        self.buffer = TransformListener(node).buffer
        self.move_base = SimpleActionClient(node, "move_base", message_class("move_base_msgs/MoveBaseAction"))
        self.costmap = Costmap2DROS("explore_costmap", self.buffer, node)
        self.sent = 0
        """Number of goals sent."""
        self._moving = self._found_frontier = False
        self._last = (math.inf, math.inf)
        self._replaced = Blacklist()
        """Goals that were replaced by others."""
        self._abort_positions: list[tuple[float, float]] = []
        """The robot's positions when goals were aborted since the last one reached [m]."""
        self._feedback = message_class("frontier_exploration/ExploreTaskFeedback")()
        services = "~explore_costmap/explore_boundary/"
        self._set_boundary, self._next_frontier = (
            node.service_client(services + name, service_class(f"frontier_exploration/{kind}"))
            for name, kind in (
                ("update_boundary_polygon", "UpdateBoundaryPolygon"),
                ("get_next_frontier", "GetNextFrontier"),
            )
        )
        self.action = SimpleActionServer(
            node,
            node.name,
            message_class("frontier_exploration/ExploreTaskAction"),
            execute_cb=self._execute,
            auto_start=False,
        )
        self.action.register_preempt_callback(self._preempt)
        self.action.start()

    def __repr__(self) -> str:
        doing = "explores" if self.action.is_active() else "waits for an area"
        return f"<ExploreServer {self.node.name}: {doing}, {self.sent} goals sent>"

    # -- the task ------------------------------------------------------------------------------------------------

    def _execute(self, task: Any) -> None:
        """Explore an area until no frontier is left."""
        self._found_frontier = self._moving = False
        self._replaced.points.clear()
        self._abort_positions.clear()
        self.costmap.reset_layers()
        try:
            self._wait_for_others()
            self._set_boundary(task.explore_boundary)
        except (ServiceException, ROSException) as error:
            self._fail(f"Failed to set region boundary: {error}")
            return
        self.node.loginfo("Region boundary set")
        left, known_ns = ATTEMPTS, self.node.clock.now_ns()
        while not self.node.is_shutdown() and self.action.is_active():
            try:
                goal = self._next_goal(task)
                left, known_ns = ATTEMPTS, self.node.clock.now_ns()
            except ServiceException as error:
                if left == 0:
                    self._finish(str(error))
                    return
                left -= 1
                self.node.sleep(RETRY_PERIOD)
                continue
            except (TransformMissing, TransformException) as error:
                if (self.node.clock.now_ns() - known_ns) * 1e-9 > POSE_TIMEOUT:
                    self._fail(f"Failed exploration: the robot's pose has been unknown for {POSE_TIMEOUT:g} s: {error}")
                    return
                self.node.logwarn(f"Exploration waits for the robot's pose: {error}", throttle=WARN_PERIOD)
                self.node.sleep(RETRY_PERIOD)
                continue
            self._send_goal(goal)
            self._wait()

    def _wait_for_others(self) -> None:
        while self.action.is_active() and not self.move_base.wait_for_server(WARN_PERIOD):
            if self.node.is_shutdown():
                return
            self.node.logwarn("Exploration waits for the action server move_base: start move_base")
        for client in (self._set_boundary, self._next_frontier):
            try:
                self.node.wait_for_service(client.name, WARN_PERIOD)
            except ROSException as error:
                raise ROSException(
                    f"{error}: the costmap ~explore_costmap needs a layer named explore_boundary of the type "
                    "frontier_exploration::BoundedExploreLayer"
                ) from error

    def _next_goal(self, task: Any) -> Any:
        """Return the next goal: a frontier, or a point inside if the robot has left the area.

        Raises `ServiceException` if there is no frontier, and `TransformMissing` or `TransformException` if the robot's
        pose is unknown.
        """
        robot = self.costmap.robot_pose()
        x, y, _ = planar_pose(robot)
        boundary = task.explore_boundary
        if len(boundary.polygon.points):
            vertices = points_in_frame(
                self.buffer, self.costmap.global_frame, boundary.header.frame_id, points_of(boundary.polygon)
            )
            if not contains(vertices, (x, y)):
                return self._return_goal(task.explore_center, x, y)
        goal = self._next_frontier(robot).next_frontier
        self._found_frontier = True
        self._feedback.next_frontier = goal
        return goal

    def _return_goal(self, center: Any, x: float, y: float) -> Any:
        """Return the given point inside the area, facing away from the robot's current position."""
        if self._found_frontier:
            self.node.logwarn("Robot left exploration boundary, returning to center", throttle=WARN_PERIOD)
        else:
            self.node.logdebug("Robot not initially in exploration boundary, traveling to center")
        point = np.array([[center.point.x, center.point.y]])
        frame = self.costmap.global_frame
        cx, cy = points_in_frame(self.buffer, frame, center.header.frame_id, point)[0].tolist()
        return pose_stamped(frame, self.node.now(), (cx, cy, math.atan2(cy - y, cx - x)))

    # -- driving -------------------------------------------------------------------------------------------------

    def _send_goal(self, pose: Any) -> None:
        """Send a goal, unless it is close to the last one, or the last one was replaced too often."""
        x, y, _ = planar_pose(pose)
        if not self.action.is_active():
            return
        if self._moving:
            resolution = self.costmap.layered.grid.resolution
            is_same = math.dist((x, y), self._last) < self.parameters.goal_aliasing / 2
            if is_same or self._replaced.count(self._last, resolution) >= MAX_REPLACEMENTS:
                return
            self._replaced.points.append(self._last)
        self._last, self._moving = (x, y), True
        self.sent += 1
        goal = message_class("move_base_msgs/MoveBaseGoal")(target_pose=pose)
        self.move_base.send_goal(goal, done_cb=self._on_done, feedback_cb=self._on_feedback)

    def _wait(self) -> None:
        """Wait until the next search is due: for a period, or until the robot has arrived."""
        frequency = self.parameters.frequency
        if frequency > 0:
            self.node.sleep(1 / frequency)
            return
        while not self.node.is_shutdown() and self.action.is_active() and self._moving:
            self.node.sleep(RETRY_PERIOD)

    def _on_feedback(self, feedback: Any) -> None:
        self._feedback.base_position = feedback.base_position
        if self.action.is_active():
            self.action.publish_feedback(self._feedback)

    def _on_done(self, state: int, _: Any) -> None:
        if state == Status.SUCCEEDED:
            self._moving = False
            self._abort_positions.clear()
        elif state == Status.ABORTED and self.action.is_active():
            self._moving = False
            with suppress(TransformMissing, TransformException):
                self._abort_positions.append(planar_pose(self.costmap.robot_pose())[:2])
            x, y = self._last
            self.node.logwarn(f"Failed to move to ({x:.2f}, {y:.2f}): {self.move_base.get_goal_status_text()}")
            for layer in self._boundaries():
                layer.given_up.points.append(self._last)

    # -- result --------------------------------------------------------------------------------------------------

    def _finish(self, reason: str) -> None:
        """End the task when no frontier is left; it fails if there never was one or if the robot is stuck."""
        if not self._found_frontier:
            self._fail(f"Failed exploration: {reason}")
            return
        given_up = "".join(layer.given_up_text for layer in self._boundaries())
        last = self._abort_positions[-STUCK_GOALS:]
        if given_up and len(last) == STUCK_GOALS and all(math.dist(one, last[-1]) < STUCK_DISTANCE for one in last):
            (x, y), text = last[-1], self.move_base.get_goal_status_text()
            self._fail(f"Failed exploration: the robot is stuck at ({x:.2f}, {y:.2f}){given_up}. Last: {text}")
            return
        text = f"Finished exploring room{given_up}"
        self.node.logwarn(text)
        self.action.set_succeeded(None, text)
        self._cancel()

    def _boundaries(self) -> list[BoundedExploreLayer]:
        return [layer for layer in self.costmap.layers if isinstance(layer, BoundedExploreLayer)]

    def _fail(self, text: str) -> None:
        self.node.logerr(text)
        if self.action.is_active():
            self.action.set_aborted(None, text)
        self._cancel()

    def _preempt(self) -> None:
        self._cancel()
        self.node.logwarn("Current exploration task cancelled")
        if self.action.is_active():
            self.action.set_preempted()

    def _cancel(self) -> None:
        """Cancel the current goal, if this node has sent one."""
        if self._moving:
            self._moving = False
            self.move_base.cancel_goals_at_and_before_time(self.node.now())
