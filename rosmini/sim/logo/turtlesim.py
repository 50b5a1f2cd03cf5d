"""Turtles of turtlesim, driven through the services of every turtlesim.

Services are exact and velocities are not: turtlesim applies a Twist for a whole number of updates of 16 ms, so lines
and turns would be slightly too long, and a Koch curve would not close. `teleport_absolute` draws a straight line to
the new pose, in real ROS too. This module keeps the pose, so that rounding to the services' 32 bits does not add up.

A step is a pixel of the window, 45 of which make a metre there, and [0 0] is its middle.
"""

from __future__ import annotations

import math
from typing import Any

from rosmini.core.errors import ROSException, ServiceException
from rosmini.core.graph import Node
from rosmini.msgs import message_class, service_class

from .turtles import HOME, Flock, Pen, Pose, Stroke, Turtle
from .values import LogoError

METRE = Flock.metre
MIDDLE = Flock.middle
"""Initial position of turtlesim's first turtle, in x and y [m]."""

SIDE = 2 * MIDDLE
"""Width and height of the window [m]: 11.0889."""

NEAR = 1e-4
"""Tolerance when comparing poses, which have 32 bits in messages [m, rad]."""

PATIENCE = 5.0
"""Timeout for a turtle's pose [s]."""

TELEPORT = "/teleport_absolute"


def turtles_of(node: Node) -> list[str]:
    """Return the names of all turtles in the graph of a node, without the leading slash."""
    _, _, services = node.master.ask("getSystemState")
    return sorted(name[1 : -len(TELEPORT)] for name, _ in services if name.endswith(TELEPORT))


class WindowTurtle(Turtle):
    """A turtle of turtlesim. Raises ``LogoError`` if it would leave the window, or if turtlesim has exited."""

    def __init__(self, node: Node, name: str, strokes: list[Stroke]) -> None:
        super().__init__(name, strokes)
        self.node = node
        self._teleport = node.service_client(f"/{name}{TELEPORT}", service_class("turtlesim/TeleportAbsolute"))
        self._set_pen = node.service_client(f"/{name}/set_pen", service_class("turtlesim/SetPen"))
        self.refresh()
        if self.goal == Pose(HOME.x, HOME.y, 90.0):  # the initial pose in turtlesim
            self.set_pen(Pen(down=False))
            self.place(HOME)
            self.goal = HOME
            self.set_pen(Pen())

    def refresh(self) -> None:
        """Update the pose if another node has moved the turtle, and set the pen again."""
        try:
            found = self.node.wait_for_message(f"/{self.name}/pose", message_class("turtlesim/Pose"), PATIENCE)
        except ROSException as error:
            raise LogoError(f"the turtle {self.name} does not publish its pose: {error}") from error
        x, y, theta = self._window(self.goal)
        turned = math.remainder(found.theta - theta, math.tau)
        if max(abs(found.x - x), abs(found.y - y), abs(turned)) > NEAR:
            parts = ((found.x - MIDDLE) * METRE, (found.y - MIDDLE) * METRE, (90.0 - math.degrees(found.theta)) % 360.0)
            self.goal = Pose(*(round(part, 3) + 0.0 for part in parts))
        self.send_pen()

    def place(self, pose: Pose) -> None:
        """Teleport the turtle, which draws a line if its pen is down."""
        x, y, theta = self._window(pose)
        if not (-NEAR <= x <= SIDE + NEAR and -NEAR <= y <= SIDE + NEAR):
            raise LogoError(
                f"turtle out of bounds: {self.name} would leave the window at [{pose.x:.6g} {pose.y:.6g}]; x and y go "
                f"from {-MIDDLE * METRE:g} to {MIDDLE * METRE:g}"
            )
        self._call(self._teleport, x=x, y=y, theta=theta)

    def send_pen(self) -> None:
        """Send the pen to turtlesim's turtle."""
        red, green, blue = self.pen.colour
        self._call(self._set_pen, r=red, g=green, b=blue, width=self.pen.size, off=int(not self.pen.down))

    def _call(self, client: Any, **request: float) -> None:
        try:
            client(**request)
        except ServiceException as error:
            raise LogoError(f"the turtle {self.name} does not answer: {error}") from error

    @staticmethod
    def _window(pose: Pose) -> tuple[float, float, float]:
        """Return a pose in the window [m, m, rad]: x to the right, y up, angles counter-clockwise from x."""
        theta = math.radians((90.0 - pose.heading + 180.0) % 360.0 - 180.0)
        return MIDDLE + pose.x / METRE, MIDDLE + pose.y / METRE, theta


class WindowFlock(Flock):
    """The turtles of a turtlesim; those with these names, or the first one, are active."""

    def __init__(self, node: Node, names: list[str] | None = None) -> None:
        super().__init__()
        self.node = node
        self._update(turtles_of(node))
        self.active = [self.find(name) for name in names or self._first()]

    def _update(self, names: list[str]) -> None:
        known, self.turtles = self.turtles, {}
        for name in names:
            self.turtles[name] = known.get(name) or WindowTurtle(self.node, name, self.strokes)

    def refresh(self) -> None:
        """Update the turtles that other nodes have moved, spawned or killed."""
        names = turtles_of(self.node)
        for name, turtle in self.turtles.items():
            if name in names and isinstance(turtle, WindowTurtle):
                turtle.refresh()
        self._update(names)
        self.active = [turtle for turtle in self.active if turtle.name in names] or [
            self.find(name) for name in self._first()
        ]

    def _first(self) -> list[str]:
        """Return the initial turtle of turtlesim, or another one if it was killed."""
        return ["turtle1"] if "turtle1" in self.turtles else list(self.turtles)[:1]

    def make(self, name: str) -> WindowTurtle:
        """Spawn a turtle in the middle."""
        made = self._call("spawn", "turtlesim/Spawn", x=MIDDLE, y=MIDDLE, theta=math.pi / 2, name=name)
        return WindowTurtle(self.node, made.name, self.strokes)

    def clean(self) -> None:
        """Erase the drawing, in the window too."""
        super().clean()
        self._call("clear", "std_srvs/Empty")

    def _call(self, service: str, kind: str, **request: Any) -> Any:
        try:
            return self.node.service_client(service, service_class(kind))(**request)
        except ServiceException as error:
            raise LogoError(f"turtlesim refuses to {service}: {error}") from error
