"""Turtles of turtlesim, driven by Logo: exactly, by the services that every turtlesim has.

Why services and no velocities: a Twist of turtlesim holds for a whole number of updates of 16 ms, so what it draws is
never quite as long or as far round as it should be, and a Koch curve would not close. `teleport_absolute` draws a
straight line to where the turtle is to be, on real ROS too. This module keeps the pose, so that the 32 bits of the
services add no error up. Robots, which cannot be teleported, are in `rosmini.logo.floor`.

A step is a pixel of the window, 45 of which make a metre there, and [0 0] is its middle.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from rosmini.errors import ROSException, ServiceException
from rosmini.msgs import message_class, service_class

from .errors import LogoError
from .turtles import HOME, Colour, ExactTurtle, Flock, Pen, Pose, Sheet

if TYPE_CHECKING:
    from typing import Any

    from rosmini.graph import Node

METRE = Flock.metre
MIDDLE = Flock.middle
"""Where turtlesim's first turtle begins, too [m]."""

SIDE = 2 * MIDDLE
"""The width and height of the window [m]: 11.0889."""

NEAR = 1e-4
"""Poses that differ by less are the same: what the window tells has 32 bits [m, rad]."""

PATIENCE = 5.0
"""How long a turtle's pose is waited for [s]."""

TELEPORT = "/teleport_absolute"


def turtles_of(node: Node) -> list[str]:
    """The names of all turtles that the graph of a node has, without the slash in front."""
    _, _, services = node.master.ask("getSystemState")
    return sorted(name[1 : -len(TELEPORT)] for name, _ in services if name.endswith(TELEPORT))


class WindowTurtle(ExactTurtle):
    """A turtle of turtlesim. Raises ``LogoError`` where it would leave the window, and if the window is gone."""

    def __init__(self, node: Node, name: str, sheet: Sheet) -> None:
        super().__init__(name, sheet)
        self.node = node
        self._teleport = node.service_client(
            f"/{name}{TELEPORT}", service_class("turtlesim/TeleportAbsolute")
        )
        self._set_pen = node.service_client(f"/{name}/set_pen", service_class("turtlesim/SetPen"))
        self.look()
        if (self._pose.x, self._pose.y, self._pose.heading) == (
            HOME.x,
            HOME.y,
            90.0,
        ):  # where turtlesim begins
            self.take(Pen(down=False))
            self.place(HOME)
            self._pose = HOME
            self.take(self.pen)

    def look(self) -> None:
        """Find out where the turtle is, if somebody else has moved it, and give it the pen that it is to have."""
        try:
            found = self.node.wait_for_message(
                f"/{self.name}/pose", message_class("turtlesim/Pose"), PATIENCE
            )
        except ROSException as error:
            raise LogoError(f"the turtle {self.name} does not say where it is: {error}") from error
        known = self._window(self._pose)
        if max(abs(found.x - known[0]), abs(found.y - known[1]), _apart(found.theta, known[2])) > NEAR:
            x, y = ((part - MIDDLE) * METRE for part in (found.x, found.y))
            heading = (90.0 - math.degrees(found.theta)) % 360.0
            self._pose = Pose(_whole(x), _whole(y), _whole(heading))
        self.take(self.pen)

    def place(self, pose: Pose) -> None:
        """Put it there, drawing a line if its pen is down."""
        x, y, theta = self._window(pose)
        if not (-NEAR <= x <= SIDE + NEAR and -NEAR <= y <= SIDE + NEAR):
            raise LogoError(
                f"turtle out of bounds: {self.name} would leave the window at [{pose.x:.6g} {pose.y:.6g}]; x and y go "
                f"from {-MIDDLE * METRE:g} to {MIDDLE * METRE:g}"
            )
        self._call(self._teleport, x=x, y=y, theta=theta)

    def take(self, pen: Pen) -> None:
        """Give the turtle another pen."""
        red, green, blue = pen.colour
        self._call(self._set_pen, r=red, g=green, b=blue, width=pen.size, off=int(not pen.down))

    def _call(self, client: Any, **request: float) -> None:
        try:
            client(**request)
        except ServiceException as error:
            raise LogoError(f"the turtle {self.name} does not answer: {error}") from error

    @staticmethod
    def _window(pose: Pose) -> tuple[float, float, float]:
        """A pose in the window [m, m, rad], x to the right, y up, angles counter-clockwise from x."""
        return (
            MIDDLE + pose.x / METRE,
            MIDDLE + pose.y / METRE,
            math.radians((90.0 - pose.heading + 180.0) % 360.0 - 180.0),
        )


class WindowFlock(Flock):
    """Turtles in the window of a turtlesim: those of these names listen at first, or all of them."""

    def __init__(self, node: Node, names: list[str] | None = None) -> None:
        super().__init__()
        self.node = node
        found = turtles_of(node)
        for name in found:
            self.turtles[name] = WindowTurtle(node, name, self.sheet)
        self.tell([self.find(name) for name in names or self._first()])

    def look(self) -> None:
        """Find out what has changed since the last program: turtles that came, went or were moved."""
        found = turtles_of(self.node)
        for name in found:
            if name in self.turtles:
                turtle = self.turtles[name]
                assert isinstance(turtle, WindowTurtle)  # noqa: S101 - for mypy
                turtle.look()
            else:
                self.turtles[name] = WindowTurtle(self.node, name, self.sheet)
        for name in [name for name in self.turtles if name not in found]:
            del self.turtles[name]
        self.tell(
            [turtle for turtle in self.told if turtle.name in found]
            or [self.find(name) for name in self._first()]
        )

    def _first(self) -> list[str]:
        """The turtle that turtlesim begins with, or another one where it is gone."""
        return ["turtle1"] if "turtle1" in self.turtles else list(self.turtles)[:1]

    def make(self, name: str) -> WindowTurtle:
        """Spawn a turtle in the middle."""
        spawn = self.node.service_client("spawn", service_class("turtlesim/Spawn"))
        try:
            made = spawn(x=MIDDLE, y=MIDDLE, theta=math.pi / 2, name=name).name
        except ServiceException as error:
            raise LogoError(f"turtlesim makes no turtle {name}: {error}") from error
        return WindowTurtle(self.node, made, self.sheet)

    def clean(self) -> None:
        """Erase what is drawn in the window."""
        super().clean()
        self._clear()

    def paint(self, colour: Colour) -> None:
        """Change the background: turtlesim shows it on a fresh sheet, so what was drawn is erased."""
        super().paint(colour)
        simulator = self._simulator()
        for letter, part in zip("rgb", colour, strict=True):
            self.node.set_param(f"{simulator}/background_{letter}", part)
        self.clean()

    def _simulator(self) -> str:
        services = dict(self.node.master.ask("getSystemState")[2])
        return str(services.get(self.node.resolve("clear"), ["/turtlesim"])[0])

    def _clear(self) -> None:
        try:
            self.node.service_client("clear", service_class("std_srvs/Empty"))()
        except ServiceException as error:
            raise LogoError(f"turtlesim does not erase its drawing: {error}") from error


def _apart(first: float, second: float) -> float:
    return abs(math.remainder(first - second, math.tau))


def _whole(value: float) -> float:
    """Without what 32 bits add: a turtle in the middle is at 0."""
    return float(round(value, 3)) + 0.0
