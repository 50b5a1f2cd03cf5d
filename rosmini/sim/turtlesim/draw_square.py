"""`turtlesim/draw_square`: turtle1 drives round a square forever, using its pose as feedback.

`Square` is the algorithm, without ROS; its tolerances and texts are those of turtlesim's tutorial (0.10.2).
"""

from __future__ import annotations

import math
from typing import Any

from rosmini.core.graph import Node
from rosmini.msgs import message_class, service_class

PERIOD_S = 0.016
SIDE_M, SPEED, TURNING = 2.0, 1.0, 0.4
"""The side [m], the speed along it [m/s], and the rate of turn [rad/s]."""
NEAR_M, NEAR_RAD, STILL = 0.1, 0.01, 1e-4
"""Tolerances at a goal [m, rad], and the speed below which the turtle counts as stopped [m/s, rad/s]."""
PI = 3.141592
"""Pi as in the tutorial."""

Pose = tuple[float, float, float]


class Square:
    """The algorithm: forward, stop, turn, stop, and so on."""

    def __init__(self) -> None:
        self.goal: Pose | None = None
        self.turning = self.stopping = False

    def decide(self, pose: Pose, linear: float, angular: float) -> tuple[tuple[float, float] | None, list[str]]:
        """Return the command at a pose with these speeds, or None for no command, and the lines to log."""
        log: list[str] = []
        if self.goal is None:
            log.append(self._ahead(pose))
        if self.stopping:
            if angular >= STILL or linear >= STILL:
                return (0.0, 0.0), log
            self.turning, self.stopping = not self.turning, False
            return None, [*log, "Reached goal", self._aside(pose) if self.turning else self._ahead(pose)]
        if self._is_there(pose):
            self.stopping = True
            return (0.0, 0.0), log
        return ((0.0, TURNING) if self.turning else (SPEED, 0.0)), log

    def _is_there(self, pose: Pose) -> bool:
        goal = self.goal or pose
        dx, dy, turn = (abs(here - there) for here, there in zip(pose, goal, strict=True))
        return dx < NEAR_M and dy < NEAR_M and turn < NEAR_RAD

    def _ahead(self, pose: Pose) -> str:
        x, y, theta = pose
        return self._set(x + math.cos(theta) * SIDE_M, y + math.sin(theta) * SIDE_M, theta)

    def _aside(self, pose: Pose) -> str:
        x, y, theta = pose
        theta = math.fmod(theta + PI / 2, 2 * PI)
        return self._set(x, y, theta - 2 * PI if theta >= PI else theta)

    def _set(self, x: float, y: float, theta: float) -> str:
        self.goal = x, y, theta
        return f"New goal [{x:f} {y:f}, {theta:f}]"


class DrawSquare:
    """The node: waits for a turtlesim, resets it, and drives turtle1."""

    def __init__(self, node: Node) -> None:
        self.node = node
        self.square = Square()
        self._pose: Any = None
        self._twist = message_class("geometry_msgs/Twist")()
        node.subscriber("turtle1/pose", message_class("turtlesim/Pose"), self._heard, queue_size=1)
        self._commands = node.publisher("turtle1/cmd_vel", type(self._twist), queue_size=1)
        node.wait_for_service("reset")
        node.service_client("reset", service_class("std_srvs/Empty"))()
        self._pose = None  # a pose from before the reset would be wrong
        node.timer(PERIOD_S, lambda _: self._drive())

    def _heard(self, pose: Any) -> None:
        self._pose = pose

    def _drive(self) -> None:
        pose = self._pose
        if pose is None:
            return
        place = pose.x, pose.y, pose.theta
        command, log = self.square.decide(place, pose.linear_velocity, pose.angular_velocity)
        for line in log:
            self.node.loginfo(line)
        if command is not None:
            self._twist.linear.x, self._twist.angular.z = command
            self._commands.publish(self._twist)
