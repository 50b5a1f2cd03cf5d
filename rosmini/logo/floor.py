"""The floor turtle: a robot that Logo drives by velocities, and that finds out by odometry how far it has come.

The robot goes where it is told as nearly as it can. Each command moves a goal, without error, and the robot drives to
the goal until odometry says that it is there: so what one movement is off by, the next one mends. The paper begins
where the robot stood: [0 0] is there, and heading 0 is where it looked. A hundred steps are a metre.

A movement is three: turn on the spot towards the goal (away from it, to go back), drive there while steering, turn to
the heading. A robot has no pen: the lines are where it drove, by its odometry.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from rosmini.errors import ROSException
from rosmini.geometry.angles import normalize_angle, yaw_from_quaternion
from rosmini.msgs import message_class

from .errors import LogoError
from .turtles import ExactTurtle, Flock, Pen, Pose, Sheet

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.graph import Node

METRE = 100.0
"""Steps in a metre."""

RATE = 20.0
"""Commands in a second."""

SPEED, SLOWEST = 0.18, 0.01
"""The linear speed is between these [m/s]; a TurtleBot3 burger may have 0.22."""

SPIN, SLOWEST_SPIN = 1.2, 0.05
"""The angular speed on the spot is between these [rad/s]; a burger may have 2.84."""

NEAR, NEAR_ANGLE = 0.003, math.radians(0.3)
"""A goal that is as near as this is reached [m, rad]."""

TRACE = 1.0
"""Where it drove is noted at such distances [steps]."""

PATIENCE = 5.0
"""A robot that has come no nearer for so long is stuck; so long is odometry waited for [s]."""


class FloorTurtle(ExactTurtle):
    """A robot with the topics `cmd_vel` and `odom` in a namespace, driven from ``node``.

    Raises ``LogoError`` where there is no odometry, and where it does not get on.
    """

    def __init__(self, node: Node, namespace: str, sheet: Sheet) -> None:
        super().__init__(namespace.strip("/") or "robot", sheet)
        self.node = node
        self._twist = message_class("geometry_msgs/Twist")
        topic = f"{namespace.rstrip('/')}/odom"
        self._publisher = node.publisher(f"{namespace.rstrip('/')}/cmd_vel", self._twist, queue_size=1)
        kind = message_class("nav_msgs/Odometry")
        try:
            self._hear(node.wait_for_message(topic, kind, PATIENCE))
        except ROSException as error:
            raise LogoError(f"{self.name} does not say where it is: {error}") from error
        self._origin = self._odom
        self._noted = self.pose
        node.subscriber(topic, kind, self._hear, queue_size=1)

    @property
    def pose(self) -> Pose:
        """Where it is, by its odometry."""
        ahead, left, yaw = self._relative()
        return Pose(-METRE * left, METRE * ahead, math.degrees(-yaw) % 360.0)

    def right(self, degrees: float) -> None:
        """Turn clockwise, all the way round if that is asked."""
        goal = Pose(self._pose.x, self._pose.y, (self._pose.heading + degrees) % 360.0)
        turns = math.trunc(degrees / 180.0)  # the last turn, of less than half a round, is that to the goal
        for _ in range(abs(turns)):
            self._spin(
                normalize_angle(self._relative()[2] - math.copysign(math.pi * 0.98, degrees)),
                -math.copysign(1, degrees),
            )
        self._move(goal)

    def place(self, pose: Pose) -> None:
        """Drive to a pose, as near as odometry can tell."""
        left, ahead = -pose.x / METRE, pose.y / METRE
        here = self._relative()
        if math.hypot(ahead - here[0], left - here[1]) > NEAR and pose[:2] != self._pose[:2]:
            bearing = math.atan2(left - here[1], ahead - here[0])
            backwards = abs(normalize_angle(bearing - here[2])) > math.pi / 2
            self._spin(normalize_angle(bearing + math.pi) if backwards else bearing)
            self._drive(ahead, left, -1.0 if backwards else 1.0)
        self._spin(normalize_angle(-math.radians(pose.heading)))

    def take(self, pen: Pen) -> None:
        """Note it: a robot has no pen."""

    def stop(self) -> None:
        """Stand still."""
        self._publisher.publish(self._twist())

    # -- movements -----------------------------------------------------------------------------------------------

    def _spin(self, yaw: float, sense: float = 0.0) -> None:
        """Turn on the spot to an angle; if ``sense`` is given, that way round."""

        def error() -> float:
            off = normalize_angle(yaw - self._relative()[2])
            return off if off * sense >= 0 or abs(off) < math.pi / 2 else off + math.copysign(math.tau, sense)

        def command(off: float) -> tuple[float, float]:
            return 0.0, _between(2.5 * off, SLOWEST_SPIN, SPIN)

        self._control(error, command, NEAR_ANGLE)

    def _drive(self, ahead: float, left: float, sign: float) -> None:
        """Drive to a point [m]; at the point's height, not at the point, it is there."""
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
        """Drive until the error is small. Stops in any case; raises ``LogoError`` if it no longer shrinks."""
        best, since = math.inf, self.node.now().to_sec()
        twist = self._twist()
        try:
            while abs(off := error()) > near:
                now = self.node.now().to_sec()
                if abs(off) < 0.98 * best:
                    best, since = abs(off), now
                elif now - since > PATIENCE:
                    raise LogoError(
                        f"{self.name} is stuck: for {PATIENCE:g} s it has come no nearer to its goal"
                    )
                twist.linear.x, twist.angular.z = command(off)
                self._publisher.publish(twist)
                self.node.sleep(1.0 / RATE)
                self._trail(TRACE)
        finally:
            self.stop()
            self._trail(0.0)

    def _trail(self, least: float) -> None:
        """Note the line from where it was noted last, if it is as long as that [steps], or the robot has turned."""
        here = self.pose
        turned = abs(math.remainder(here.heading - self._noted.heading, 360.0))
        if math.dist(here[:2], self._noted[:2]) >= max(least, 1e-9) or turned > 10.0:
            self.trace(self._noted)
            self._noted = here

    def _move(self, pose: Pose) -> None:
        self.place(pose)
        self._pose = pose

    # -- odometry ------------------------------------------------------------------------------------------------

    def _hear(self, message: Any) -> None:
        place, turned = message.pose.pose.position, message.pose.pose.orientation
        self._odom = place.x, place.y, yaw_from_quaternion(turned.x, turned.y, turned.z, turned.w)

    def _relative(self) -> tuple[float, float, float]:
        """Where it is [m, m, rad], ahead and to the left of where it began."""
        x, y, yaw = self._odom
        x0, y0, yaw0 = self._origin
        c, s = math.cos(yaw0), math.sin(yaw0)
        return c * (x - x0) + s * (y - y0), c * (y - y0) - s * (x - x0), normalize_angle(yaw - yaw0)


class FloorFlock(Flock):
    """Robots on the floor, one for each namespace; all of them listen at first."""

    metre = METRE
    middle = 0.0
    place = "the floor"

    def __init__(self, node: Node, namespaces: list[str]) -> None:
        super().__init__()
        for namespace in namespaces:
            turtle = FloorTurtle(node, namespace, self.sheet)
            self.turtles[turtle.name] = turtle
        self.tell(list(self.turtles.values()))

    def make(self, name: str) -> FloorTurtle:
        """Raises ``LogoError``: Logo builds no robots."""
        raise LogoError(f"Logo makes no robot {name}: start one in the graph, and name it")


def _between(value: float, least: float, most: float) -> float:
    """A speed in the direction of ``value``, of at least and at most these."""
    return math.copysign(min(max(abs(value), least), most), value)
