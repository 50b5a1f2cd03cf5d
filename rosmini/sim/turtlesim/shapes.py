"""`turtle_actionlib`: a turtle draws a regular polygon as an action (http://wiki.ros.org/turtle_actionlib).

`Polygon` is the controller, without ROS; `ShapeServer` is `turtle_actionlib/shape_server` (the node and action
`turtle_shape`), `ShapeClient` is `turtle_actionlib/shape_client` (the node `test_shape`), which requests a pentagon.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from rosmini.core.actionlib import SimpleActionClient, SimpleActionServer
from rosmini.msgs import message_class

from .turtle import TurtleError

if TYPE_CHECKING:
    from rosmini.core.graph import Node

GAIN = 6.0
"""Speed per remaining distance or angle [1/s]."""
TOLERANCE = 1e-5
"""Tolerance at the end of an edge or a turn [m, rad]."""
EDGES, RADIUS_M, PATIENCE_S = 5, 1.3, 40.0
"""The client's goal, and its timeout."""

Pose = tuple[float, float, float]


class Polygon:
    """Steers along the edges of a regular polygon, and turns left at each corner.

    Args:
        edges: number of edges.
        radius: radius of the circle through the corners [m].

    Raises:
        TurtleError: there are fewer than three edges, or the radius is not a positive number.

    """

    def __init__(self, edges: int, radius: float) -> None:
        if edges < 3 or not 0 < radius < math.inf:
            raise TurtleError(
                f"a polygon has three edges at least, and a radius above 0 m: not {edges} edges and {radius} m"
            )
        self.edges = edges
        self.interior_angle = (edges - 2) * math.pi / edges
        """Angle between two edges [rad]."""
        self.apothem = radius * math.cos(math.pi / edges)
        """Distance from the centre to an edge [m]."""
        self.side = 2 * self.apothem * math.tan(math.pi / edges)
        """The length of an edge [m]."""
        self.done = 0
        """Number of finished edges, each with the turn after it."""
        self._start: Pose | None = None

    def steer(self, pose: Pose) -> tuple[float, float] | None:
        """Return the velocities [m/s, rad/s] at a pose, or None when all edges are drawn."""
        if self.done >= self.edges:
            return None
        if self._start is None:
            self._start = pose
        left = self.side - math.dist(self._start[:2], pose[:2])
        if left > TOLERANCE:
            return GAIN * left, 0.0
        turn = (math.pi - self.interior_angle - (pose[2] - self._start[2])) % (2 * math.pi)
        if turn > TOLERANCE:
            return 0.0, GAIN * turn
        self._start = None
        self.done += 1
        return 0.0, 0.0


class ShapeServer:
    """The node: draws with turtle1, one goal at a time."""

    node_name = "turtle_shape"

    def __init__(self, node: Node) -> None:
        self.node = node
        self.polygon: Polygon | None = None
        self._twist = message_class("geometry_msgs/Twist")()
        self._result = message_class("turtle_actionlib/ShapeResult")
        self._commands = node.publisher("/turtle1/cmd_vel", type(self._twist), queue_size=1)
        action = message_class("turtle_actionlib/ShapeAction")
        self.server = SimpleActionServer(node, node.name, action, auto_start=False)
        self.server.register_goal_callback(self._begin)
        self.server.register_preempt_callback(self._stop)
        node.subscriber("/turtle1/pose", message_class("turtlesim/Pose"), self._heard, queue_size=1)
        self.server.start()

    def _begin(self) -> None:
        goal = self.server.accept_new_goal()
        try:
            self.polygon = Polygon(goal.edges, goal.radius)
        except TurtleError as error:
            self.polygon = None
            self.node.logerr(f"{self.node.name}: {error}")
            self.server.set_aborted(text=str(error))

    def _stop(self) -> None:
        self.node.loginfo(f"{self.node.name}: Preempted")
        self.polygon = None
        self.server.set_preempted()

    def _heard(self, pose: Any) -> None:
        polygon = self.polygon
        if polygon is None or not self.server.is_active():
            return
        command = polygon.steer((pose.x, pose.y, pose.theta))
        if command is not None:
            self._twist.linear.x, self._twist.angular.z = command
            self._commands.publish(self._twist)
            return
        self.polygon = None
        self.node.loginfo(f"{self.node.name}: Succeeded")
        self.server.set_succeeded(self._result(interior_angle=polygon.interior_angle, apothem=polygon.apothem))


class ShapeClient:
    """The node: sends a goal, waits for the result, logs it, and shuts down."""

    node_name = "test_shape"

    def __init__(self, node: Node) -> None:
        self.node = node
        node.spawn(f"{node.name} main", self._ask)

    def _ask(self) -> None:
        node = self.node
        client = SimpleActionClient(node, "turtle_shape", message_class("turtle_actionlib/ShapeAction"))
        node.loginfo("Waiting for action server to start.")
        client.wait_for_server()
        node.loginfo("Action server started, sending goal.")
        client.send_goal(message_class("turtle_actionlib/ShapeGoal")(edges=EDGES, radius=RADIUS_M))
        if client.wait_for_result(PATIENCE_S):
            node.loginfo(f"Action finished: {client.get_state().name}")
        else:
            node.loginfo("Action did not finish before the time out.")
        node.shutdown("done")
