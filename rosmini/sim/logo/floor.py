"""Robots on the floor, which Logo drives by velocities, with feedback from odometry.

Each command moves a goal, exactly, and the robot drives until odometry reports that it has reached the goal, so an
error in one movement is corrected in the next. [0 0] and heading 0 are the initial pose. A hundred steps are a metre.

A movement has three parts: turn on the spot towards the goal (away from it, to go back), drive there while steering,
turn to the heading. A robot has no pen: its lines are the path that it drove, by its odometry.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from rosmini.core.errors import ROSException
from rosmini.core.geometry.angles import normalize_angle, yaw_from_quaternion
from rosmini.core.graph import Node
from rosmini.msgs import message_class

from .turtles import Flock, Pose, Stroke, Turtle
from .values import LogoError

METRE = 100.0
"""Steps in a metre."""

RATE = 20.0
"""Velocity commands per second."""

SPEED, SLOWEST = 0.18, 0.01
"""Maximum and minimum linear speed [m/s]; the maximum of a TurtleBot3 burger is 0.22."""

SPIN, SLOWEST_SPIN = 1.2, 0.05
"""Maximum and minimum angular speed on the spot [rad/s]; the maximum of a burger is 2.84."""

NEAR, NEAR_ANGLE = 0.003, math.radians(0.3)
"""Tolerances at the goal [m, rad]."""

TRACE = 1.0
"""Distance between recorded points of the path [steps]."""

PATIENCE = 5.0
"""Timeout for odometry, and for progress towards the goal [s]."""


def robots_of(node: Node) -> list[str]:
    """Return the namespaces with a published topic `odom` and a subscribed topic `cmd_vel`; "" is the global one."""
    published, subscribed, _ = node.master.ask("getSystemState")
    with_odometry = {name.removesuffix("/odom") for name, _ in published if name.endswith("/odom")}
    with_velocity = {name.removesuffix("/cmd_vel") for name, _ in subscribed if name.endswith("/cmd_vel")}
    return sorted(with_odometry & with_velocity)


class FloorTurtle(Turtle):
    """A robot with the topics `cmd_vel` and `odom` in a namespace.

    Raises ``LogoError`` if it publishes no odometry, or if it makes no progress.
    """

    def __init__(self, node: Node, namespace: str, strokes: list[Stroke]) -> None:
        super().__init__(namespace.strip("/") or "robot", strokes)
        self.node = node
        self._twist = message_class("geometry_msgs/Twist")
        topic = f"{namespace.rstrip('/')}/odom"
        self._publisher = node.publisher(f"{namespace.rstrip('/')}/cmd_vel", self._twist, queue_size=1)
        kind = message_class("nav_msgs/Odometry")
        try:
            self._update(node.wait_for_message(topic, kind, PATIENCE))
        except ROSException as error:
            raise LogoError(f"{self.name} publishes no odometry: {error}") from error
        self._origin = self._odom
        self._traced = self.pose
        node.subscriber(topic, kind, self._update, queue_size=1)

    @property
    def pose(self) -> Pose:
        """The pose according to odometry."""
        ahead, left, yaw = self._relative()
        return Pose(-METRE * left, METRE * ahead, math.degrees(-yaw) % 360.0)

    def right(self, degrees: float) -> None:
        """Turn clockwise, including whole turns."""
        halves = math.trunc(degrees / 180.0)  # the rest, less than half a turn, is the turn to the goal
        for _ in range(abs(halves)):
            yaw = self._relative()[2] - math.copysign(math.pi * 0.98, degrees)
            self._spin(normalize_angle(yaw), -math.copysign(1, degrees))
        self.face(self.goal.heading + degrees)

    def move(self, pose: Pose) -> None:
        """Drive to a pose, within the tolerances."""
        left, ahead = -pose.x / METRE, pose.y / METRE
        here = self._relative()
        if math.hypot(ahead - here[0], left - here[1]) > NEAR and pose[:2] != self.goal[:2]:
            bearing = math.atan2(left - here[1], ahead - here[0])
            backwards = abs(normalize_angle(bearing - here[2])) > math.pi / 2
            self._spin(normalize_angle(bearing + math.pi) if backwards else bearing)
            self._drive(ahead, left, -1.0 if backwards else 1.0)
        self._spin(normalize_angle(-math.radians(pose.heading)))
        self.goal = pose

    # -- movements -----------------------------------------------------------------------------------------------

    def _spin(self, yaw: float, sense: float = 0.0) -> None:
        """Turn on the spot to an angle: the shorter way, or in the direction of the sign of ``sense``."""

        def error() -> float:
            off = normalize_angle(yaw - self._relative()[2])
            return off if off * sense >= 0 or abs(off) < math.pi / 2 else off + math.copysign(math.tau, sense)

        def command(off: float) -> tuple[float, float]:
            return 0.0, _between(2.5 * off, SLOWEST_SPIN, SPIN)

        self._control(error, command, NEAR_ANGLE)

    def _drive(self, ahead: float, left: float, sign: float) -> None:
        """Drive towards a point [m] until it is beside the robot."""
        start = self._relative()
        course = math.atan2(left - start[1], ahead - start[0])

        def error() -> float:
            x, y, _ = self._relative()
            return math.cos(course) * (ahead - x) + math.sin(course) * (left - y)

        def command(off: float) -> tuple[float, float]:
            x, y, yaw = self._relative()
            across = math.cos(course) * (left - y) - math.sin(course) * (ahead - x)
            facing = course if sign > 0 else course + math.pi
            steer = normalize_angle(facing - yaw) * 2.0 + sign * 4.0 * across
            return sign * _between(1.5 * off, SLOWEST, SPEED), max(-0.8, min(0.8, steer))

        self._control(error, command, NEAR)

    def _control(
        self, error: Callable[[], float], command: Callable[[float], tuple[float, float]], near: float
    ) -> None:
        """Drive until the error is small, then stop. Raises ``LogoError`` if it no longer decreases."""
        best, since = math.inf, self.node.now().to_sec()
        twist = self._twist()
        try:
            while abs(off := error()) > near:
                now = self.node.now().to_sec()
                if abs(off) < 0.98 * best:
                    best, since = abs(off), now
                elif now - since > PATIENCE:
                    raise LogoError(f"{self.name} is stuck: it has made no progress for {PATIENCE:g} s")
                twist.linear.x, twist.angular.z = command(off)
                self._publisher.publish(twist)
                self.node.sleep(1.0 / RATE)
                self._trace(TRACE)
        finally:
            self._publisher.publish(self._twist())
            self._trace(1e-9)

    def _trace(self, least: float) -> None:
        """Add a stroke to the drawing if the robot has driven this distance [steps] or has turned."""
        here = self.pose
        turned = abs(math.remainder(here.heading - self._traced.heading, 360.0))
        if math.dist(here[:2], self._traced[:2]) >= least or turned > 10.0:
            self.strokes.append(Stroke(self.name, self._traced, here, self.pen))
            self._traced = here

    # -- odometry ------------------------------------------------------------------------------------------------

    def _update(self, message: Any) -> None:
        position, q = message.pose.pose.position, message.pose.pose.orientation
        self._odom = position.x, position.y, yaw_from_quaternion(q.x, q.y, q.z, q.w)

    def _relative(self) -> tuple[float, float, float]:
        """Return the pose [m, m, rad], ahead and to the left of the initial one."""
        x, y, yaw = self._odom
        x0, y0, yaw0 = self._origin
        c, s = math.cos(yaw0), math.sin(yaw0)
        return c * (x - x0) + s * (y - y0), c * (y - y0) - s * (x - x0), normalize_angle(yaw - yaw0)


class FloorFlock(Flock):
    """Robots on the floor, one for each namespace; all are active at first."""

    metre = METRE
    middle = 0.0
    place = "the floor"

    def __init__(self, node: Node, namespaces: list[str]) -> None:
        super().__init__()
        for namespace in namespaces:
            turtle = FloorTurtle(node, namespace, self.strokes)
            self.turtles[turtle.name] = turtle
        self.active = list(self.turtles.values())

    def make(self, name: str) -> FloorTurtle:
        """Raise ``LogoError``, because Logo cannot create robots."""
        raise LogoError(f"Logo cannot make the robot {name}: start a robot in the graph")


def _between(value: float, least: float, most: float) -> float:
    """Return a speed with the sign of ``value`` and a magnitude between these limits."""
    return math.copysign(min(max(abs(value), least), most), value)
