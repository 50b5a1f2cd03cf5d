"""A turtle: its pose, its motion, and its pen. Contains no node, topic or clock.

The window is 500 pixels wide and a metre is 45 pixels, the height of ROS's turtle images; the centre of the last
pixel is the border: 499 / 45 = 11.088889 m. Positions are stored in metres from the top left with y down, as in the
window; messages have y up from the bottom left. Both are computed as in turtlesim 0.10.2 (ROS Noetic), with single
precision where it has it (https://github.com/ros/ros_tutorials, branch noetic-devel).
"""

from __future__ import annotations

import math
import struct

from rosmini.core.errors import RosminiError

from .paper import SIZE, Paper, Pen

METRE = 45.0
"""Pixels per metre."""

STEP_S = 0.016
"""The period of the simulation [s], 62.5 Hz: each update advances a turtle by this time."""

TIMEOUT_S = 1.0
"""Duration of a velocity command [s]."""

PI = 3.14159265
"""Pi as in turtlesim: angles are in [-PI, PI)."""

FASTEST = 1e38
"""Maximum velocity in a command [m/s, rad/s]: the range of a message's float32."""


class TurtleError(RosminiError):
    """A request to a turtle cannot be fulfilled; the message says why. The simulation continues."""


def single(value: float) -> float:
    """Round a number to single precision, as in the float32 of a message."""
    return float(struct.unpack("f", struct.pack("f", value))[0])


LIMIT = single((SIZE - 1) / METRE)
"""Maximum x and y [m]: 11.088889."""

START = (single(LIMIT / 2), single(LIMIT / 2), 0.0)
"""The pose of the first turtle, in the middle of the window: 5.544445 m, 5.544445 m, 0 rad."""


def finite(name: str, **numbers: float) -> None:
    """Raise `TurtleError` unless all numbers are finite."""
    wrong = {field: value for field, value in numbers.items() if not math.isfinite(value)}
    if wrong:
        given = ", ".join(f"{field} = {value}" for field, value in wrong.items())
        raise TurtleError(f"{name}: {given} is not a valid number for a turtle; give finite numbers")


class Turtle:
    """A turtle on paper.

    Args:
        name: its name, the namespace of its topics.
        x: metres from the left.
        y: metres from the bottom.
        theta: its heading [rad], 0 to the right, counter-clockwise.
        kind: the number of its drawing (`rosmini.sim.turtlesim.drawings`).

    Raises:
        TurtleError: one of the numbers is not finite.

    """

    __slots__ = (
        "_command", "_last_command_s", "_left_from", "_teleports", "_x", "_y",
        "angular_velocity", "forward", "holonomic", "kind", "name", "pen", "pen_on", "sideways", "theta",
    )  # fmt: skip

    def __init__(self, name: str, x: float, y: float, theta: float, *, kind: int = 0) -> None:
        finite(name or "a turtle", x=x, y=y, theta=theta)
        self.name = name
        self.kind = kind
        self._x, self._y = single(x), single(LIMIT - single(y))
        self.theta = single(theta)
        """The heading [rad]."""
        self.forward = self.sideways = self.angular_velocity = 0.0
        self.pen = Pen()
        self.pen_on = True
        self.holonomic = True
        """True if `linear.y` of a command moves it sideways."""
        self._command: tuple[float, float, float] | None = None
        self._last_command_s = -math.inf
        self._teleports: list[tuple[float, ...]] = []
        self._left_from = self._x, self._y

    def __repr__(self) -> str:
        return f"<Turtle {self.name} at ({self.x:.2f}, {self.y:.2f}, {self.theta:.2f} rad)>"

    @property
    def x(self) -> float:
        """Metres from the left."""
        return self._x

    @property
    def y(self) -> float:
        """Metres from the bottom."""
        return LIMIT - self._y

    @property
    def pixel(self) -> tuple[float, float]:
        """Its position in the window [px], from the top left."""
        return self._x * METRE, self._y * METRE

    @property
    def linear_velocity(self) -> float:
        """The speed in its pose message [m/s], never negative."""
        return math.hypot(self.forward, self.sideways)

    # -- commands ------------------------------------------------------------------------------------------------

    def command(self, forward: float, sideways: float, angular: float) -> None:
        """Set the velocities [m/s, m/s, rad/s] from the next update on; they hold for a second.

        Raises `TurtleError` if one is not finite, or beyond a message's range.
        """
        if not (abs(forward) <= FASTEST and abs(sideways) <= FASTEST and abs(angular) <= FASTEST):
            raise TurtleError(
                f"{self.name}: velocities must be finite numbers, and the command was linear "
                f"({forward}, {sideways}) m/s, angular {angular} rad/s"
            )
        self._command = forward, sideways if self.holonomic else 0.0, angular

    def set_pen(self, r: int, g: int, b: int, width: int, off: int) -> None:
        """Set the pen, or, with `off`, lift it and leave it unchanged. Width 0 is Qt's default, 1 px."""
        self.pen_on = not off
        if not off:
            self.pen = Pen((r, g, b), width or 1)

    def teleport_absolute(self, x: float, y: float, theta: float) -> None:
        """Move to another pose at the next update, drawing a line if the pen is down.

        Outside the window the update after that moves it to the border. Raises `TurtleError` if a number is not
        finite.
        """
        finite(f"{self.name}/teleport_absolute", x=x, y=y, theta=theta)
        self._teleports.append((x, y, theta))

    def teleport_relative(self, linear: float, angular: float) -> None:
        """Turn [rad] and move ahead [m], both at the next update. Raises `TurtleError` if a number is not finite."""
        finite(f"{self.name}/teleport_relative", linear=linear, angular=angular)
        self._teleports.append((linear, angular))

    # -- a step of the simulation --------------------------------------------------------------------------------

    def move(self, now_s: float, paper: Paper) -> tuple[float, float] | None:
        """Execute the requests and advance by `STEP_S`; `draw` draws the line of this motion.

        Returns the position outside the window that it would have reached, x and y (down) [m], or None.
        """
        if self._command is not None:
            self.forward, self.sideways, self.angular_velocity = self._command
            self._command, self._last_command_s = None, now_s
        for teleport in self._teleports:
            self._teleport(teleport, paper)
        self._teleports.clear()
        if now_s - self._last_command_s > TIMEOUT_S:
            self.forward = self.sideways = self.angular_velocity = 0.0
        self._left_from = self._x, self._y
        self.theta = _wrapped(self.theta + self.angular_velocity * STEP_S)
        cos, sin = math.cos(self.theta), math.sin(self.theta)
        x = self._x + (cos * self.forward * STEP_S - sin * self.sideways * STEP_S)
        y = self._y - (cos * self.sideways * STEP_S + sin * self.forward * STEP_S)
        self._x, self._y = min(max(x, 0.0), LIMIT), min(max(y, 0.0), LIMIT)
        return None if (self._x, self._y) == (x, y) else (x, y)

    def draw(self, paper: Paper) -> None:
        """Draw the line of the last move if the pen is down and the turtle moved."""
        if self.pen_on and self._left_from != (self._x, self._y):
            self._line(self._left_from, paper)

    def _teleport(self, teleport: tuple[float, ...], paper: Paper) -> None:
        before = self._x, self._y
        if len(teleport) == 2:
            linear, angular = teleport
            self.theta = _wrapped(self.theta) + angular
            self._x += math.cos(self.theta) * linear
            self._y -= math.sin(self.theta) * linear
        else:
            self._x, y, self.theta = teleport
            self._y = max(0.0, LIMIT - y)
        if self.pen_on:
            self._line(before, paper)

    def _line(self, before: tuple[float, float], paper: Paper) -> None:
        start = before[0] * METRE, before[1] * METRE
        paper.line(self.pixel, start, self.pen, self.name)


def _wrapped(angle: float) -> float:
    """Return an angle in [-PI, PI) by turtlesim's formula, or the remainder of an angle too large for it."""
    angle -= 2 * PI * math.floor((angle + PI) / (2 * PI))
    return angle if abs(angle) <= PI + 1e-6 else math.remainder(angle, 2 * PI)
