"""`frontier_exploration/explore_client`: defines the area to explore from points clicked in RViz.

It subscribes to `/clicked_point`, shows the polygon on `exploration_polygon_marker` (blue while open, red when closed),
and sends it to `explore_server`. Unlike the original it rejects a polygon whose edges cross.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.core.actionlib import SimpleActionClient
from rosmini.msgs import message_class

from .polygon import Selection, Step

if TYPE_CHECKING:
    from rosmini.core.graph import Node

MARKER_PERIOD = 0.1
"""Interval between publications of the polygon [s]."""
WARN_PERIOD = 5.0
"""Interval between warnings while the server is missing [s]."""


class ExploreClient:
    """The `explore_client` node."""

    def __init__(self, node: Node) -> None:
        self.node = node
        self.selection = Selection()
        self.client: SimpleActionClient | None = None
        """The client of the server; created when the first area is complete."""
        self._marker = message_class("visualization_msgs/Marker")
        self._point = message_class("geometry_msgs/Point")
        self._markers = node.publisher("exploration_polygon_marker", self._marker, queue_size=10)
        self._markers.expect_nobody()
        node.subscriber("/clicked_point", message_class("geometry_msgs/PointStamped"), self._on_click, queue_size=10)
        node.timer(MARKER_PERIOD, self._show)
        node.loginfo("Please use the 'Point' tool in Rviz to select an exploration boundary.")

    def __repr__(self) -> str:
        return f"<ExploreClient {self.node.name}: {len(self.selection.vertices)} vertices>"

    def _on_click(self, point: Any) -> None:
        """Add a clicked point to the selection; send the goal once that is complete."""
        selection = self.selection
        step, text = selection.click(point.header.frame_id.lstrip("/"), point.point.x, point.point.y)
        if step is Step.REFUSED:
            self.node.logerr(text)
        elif step is Step.CLOSED:
            self.node.logwarn(text)
        elif step is Step.COMPLETE:
            goal = self._goal(point)
            selection.clear()
            self._send(goal, text)

    def _goal(self, center: Any) -> Any:
        goal = message_class("frontier_exploration/ExploreTaskGoal")()
        goal.explore_center = center
        goal.explore_boundary.header.frame_id = self.selection.frame
        goal.explore_boundary.header.stamp = self.node.now()
        corner = message_class("geometry_msgs/Point32")
        goal.explore_boundary.polygon.points = [corner(x=x, y=y) for x, y in self.selection.vertices]
        return goal

    def _send(self, goal: Any, text: str) -> None:
        if self.client is None:
            action = message_class("frontier_exploration/ExploreTaskAction")
            self.client = SimpleActionClient(self.node, "explore_server", action)
        while not self.client.wait_for_server(WARN_PERIOD):
            if self.node.is_shutdown():
                return
            self.node.logwarn("Waiting for the action server explore_server: start frontier_exploration/explore_server")
        self.node.loginfo(text)
        self.client.send_goal(goal)

    def _show(self, _: Any) -> None:
        """Publish the current vertices and edges."""
        if self._markers.num_connections():
            for number, (kind, size) in enumerate(
                ((self._marker.SPHERE_LIST, (0.1, 0.1, 0.1)), (self._marker.LINE_STRIP, (0.05, 0.0, 0.0)))
            ):
                self._markers.publish(self._drawn(number, kind, size))

    def _drawn(self, number: int, kind: int, size: tuple[float, float, float]) -> Any:
        selection, marker = self.selection, self._marker()
        marker.header.frame_id, marker.header.stamp = selection.frame, self.node.now()
        marker.ns, marker.id, marker.type = "explore_points", number, kind
        if not selection.vertices:
            marker.action = marker.DELETE
            return marker
        marker.pose.orientation.w = 1.0
        marker.scale.x, marker.scale.y, marker.scale.z = size
        vertices = selection.vertices
        if selection.is_closed and kind == marker.LINE_STRIP:
            vertices = [*vertices, vertices[0]]
        marker.points = [self._point(x=x, y=y) for x, y in vertices]
        marker.color.a = 1.0
        marker.color.r, marker.color.b = (1.0, 0.0) if selection.is_closed else (0.0, 1.0)
        return marker
