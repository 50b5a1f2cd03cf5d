"""`explore_lite/explore`: drives to the cheapest frontier until none is left, or all have been given up.

It subscribes to a map and its updates, sends goals to `move_base`, and shows frontiers on `~frontiers`: blue, or red if
given up, with a green ball that is smaller for higher costs. Unlike in the original, a frontier that was given up is
tried once more when no other is left.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from rosmini.core.actionlib import SimpleActionClient, Status
from rosmini.core.graph import Node
from rosmini.core.parameters import Parameters, parameter
from rosmini.msgs import message_class
from rosmini.navigation.frontier_exploration.search import Blacklist, Frontier, find_frontiers, formatted_points
from rosmini.navigation.nav_core import TransformMissing, pose_stamped

from .costs import Weights, ranked
from .map_client import WARN_PERIOD, MapClient

Ranked = Sequence[tuple[float, Frontier]]

NEXT_GOAL_DELAY = 1e-3
"""Delay between the end of a goal and the choice of the next one [s]."""
BLUE, RED, GREEN = (0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)


@dataclass(frozen=True)
class ExploreParameters(Parameters):
    """The private parameters of `explore`."""

    robot_base_frame: str = parameter("base_link", "the robot's frame")
    costmap_topic: str = parameter("costmap", "the topic of a map or costmap")
    costmap_updates_topic: str = parameter("costmap_updates", "the topic of the updates of that map")
    visualize: bool = parameter(False, "whether frontiers are published on ~frontiers")
    planner_frequency: float = parameter(1.0, "rate at which a goal is chosen", unit="Hz", minimum=1e-3)
    progress_timeout: float = parameter(30.0, "the node gives up a goal after this time without progress", unit="s")
    potential_scale: float = parameter(1e-3, "the weight of a frontier's distance")
    orientation_scale: float = parameter(0.0, "has no effect, as in ROS")
    gain_scale: float = parameter(1.0, "the weight of a frontier's size")
    transform_tolerance: float = parameter(0.3, "how old the robot's pose may be", unit="s")
    min_frontier_size: float = parameter(0.5, "smaller frontiers are ignored", unit="m")


class Explore:
    """The `explore` node."""

    def __init__(self, node: Node) -> None:
        self.node = node
        self.parameters = own = ExploreParameters.read(node)
        self.weights = Weights(own.potential_scale, own.gain_scale, own.min_frontier_size)
        self.blacklist = Blacklist()
        self.frontiers: Ranked = ()
        """Cost and frontier of those found last, cheapest first."""
        self.goal: tuple[float, float] | None = None
        """The last goal sent [m]."""
        self.sent = 0
        """Number of goals sent."""
        self.is_exploring = False
        self._distance, self._progress_ns, self._shown = math.inf, 0, 0
        self._marker = message_class("visualization_msgs/Marker")
        self._array = message_class("visualization_msgs/MarkerArray")
        self._markers = node.publisher("~frontiers", self._array, queue_size=10) if own.visualize else None
        if self._markers is not None:
            self._markers.expect_nobody()
        self.map = MapClient(node, own)
        self.move_base = SimpleActionClient(node, "move_base", message_class("move_base_msgs/MoveBaseAction"))
        node.loginfo("Waiting to connect to move_base server")
        while not self.move_base.wait_for_server(WARN_PERIOD):
            if node.is_shutdown():
                return
            node.logwarn("Still waiting for the action server move_base: start move_base")
        node.loginfo("Connected to move_base server")
        self.is_exploring = True
        node.timer(1 / own.planner_frequency, lambda _: self.make_plan())

    def __repr__(self) -> str:
        doing = "explores" if self.is_exploring else "has stopped"
        return f"<Explore {self.node.name}: {doing}, {self.sent} goals sent, {len(self.blacklist.points)} given up>"

    # -- the goal ------------------------------------------------------------------------------------------------

    def make_plan(self) -> None:
        """Choose the frontier to drive to, and send it as the goal unless the robot is already driving there."""
        if not self.is_exploring or not self._update_frontiers():
            return
        while (frontier := self._cheapest()) is not None:
            is_new = self.goal != frontier.centroid
            now = self.node.clock.now_ns()
            if is_new or frontier.min_distance < self._distance:
                self._distance, self._progress_ns = frontier.min_distance, now
            self.goal = frontier.centroid
            if (now - self._progress_ns) * 1e-9 <= self.parameters.progress_timeout:
                if is_new:
                    self._send(frontier.centroid)
                return
            self._blacklist_goal(frontier.centroid, f"no progress for {self.parameters.progress_timeout:g} s")
        what = "All frontiers traversed/tried out" if self.frontiers else "No frontiers found"
        self.node.loginfo(f"{what}, stopping.")
        if self.frontiers:
            given_up = formatted_points(one.centroid for _, one in self.frontiers)
            self.node.logwarn(f"{len(self.frontiers)} frontiers were given up, at {given_up}")
        self.is_exploring = False
        self.move_base.cancel_all_goals()
        self.node.loginfo("Exploration stopped.")

    def _update_frontiers(self) -> bool:
        """Find and publish the frontiers; return False if the robot's pose is unknown or outside the map."""
        try:
            x, y = self.map.robot()
            found = find_frontiers(self.map.grid, x, y)
        except (TransformMissing, IndexError) as error:
            self.node.logwarn(f"Exploration waits for the robot's pose: {error}", throttle=WARN_PERIOD)
            return False
        self.frontiers = ranked(found, self.weights, self.map.grid.resolution)
        if self._markers is not None and self._markers.num_connections():
            self._markers.publish(self._array(markers=list(self._markers_of_frontiers())))
        return True

    def _cheapest(self) -> Frontier | None:
        """Return the cheapest of the frontiers with the fewest failures, or None if all were given up permanently."""
        resolution = self.map.grid.resolution
        left = [one for _, one in self.frontiers if not self.blacklist.is_given_up(one.centroid, resolution)]
        return min(left, key=lambda one: self.blacklist.count(one.centroid, resolution), default=None)

    def _blacklist_goal(self, point: tuple[float, float], why: str) -> None:
        self.node.logdebug(f"Adding ({point[0]:.2f}, {point[1]:.2f}) to black list: {why}")
        self.blacklist.points.append(point)
        self.goal, self._distance = None, math.inf

    def _send(self, point: tuple[float, float]) -> None:
        self.sent += 1
        goal = message_class("move_base_msgs/MoveBaseGoal")()
        goal.target_pose = pose_stamped(self.map.global_frame, self.node.now(), (*point, 0.0))
        self.move_base.send_goal(goal, done_cb=lambda state, _: self._on_done(state, point))

    def _on_done(self, state: int, point: tuple[float, float]) -> None:
        """Blacklist the goal if it was aborted, and choose the next one."""
        if state == Status.ABORTED:
            self._blacklist_goal(point, self.move_base.get_goal_status_text())
        if self.is_exploring:
            # Not in the client's callback, where the next goal would be taken for the old one's end.
            self.node.timer(NEXT_GOAL_DELAY, lambda _: self.make_plan(), oneshot=True)

    # -- pictures ------------------------------------------------------------------------------------------------

    def _markers_of_frontiers(self) -> Iterator[Any]:
        """Yield two markers for each frontier, its cells and a ball, and deletions of old markers."""
        resolution = self.map.grid.resolution
        least = self.frontiers[0][0] if self.frontiers else 0.0
        point = message_class("geometry_msgs/Point")
        number = 0
        for cost, frontier in self.frontiers:
            is_given_up = self.blacklist.is_given_up(frontier.centroid, resolution)
            cells = self._new_marker(number, self._marker.POINTS, 0.1, RED if is_given_up else BLUE)
            cells.points = [point(x=x, y=y) for x, y in frontier.points.tolist()]
            size = min(abs(least * 0.4 / cost), 0.5) if cost else 0.5
            ball = self._new_marker(number + 1, self._marker.SPHERE, size, GREEN)
            ball.pose.position.x, ball.pose.position.y = frontier.initial
            yield from (cells, ball)
            number += 2
        for old in range(number, self._shown):
            gone = self._new_marker(old, self._marker.SPHERE, 0.1, BLUE)
            gone.action = gone.DELETE
            yield gone
        self._shown = number

    def _new_marker(self, number: int, kind: int, size: float, colour: tuple[float, float, float]) -> Any:
        marker = self._marker()
        marker.header.frame_id, marker.header.stamp = self.map.global_frame, self.node.now()
        marker.ns, marker.id, marker.type, marker.frame_locked = "frontiers", number, kind, True
        marker.pose.orientation.w = 1.0
        marker.scale.x = marker.scale.y = marker.scale.z = size
        marker.color.r, marker.color.g, marker.color.b = colour
        marker.color.a = 1.0
        return marker
