"""`yocs_velocity_smoother/velocity_smoother`, a nodelet in ROS (http://wiki.ros.org/yocs_velocity_smoother).

It subscribes to commands on `~raw_cmd_vel` and publishes smoothed ones on `~smooth_cmd_vel`; with `robot_feedback`
1 it subscribes to `~odometry`, with 2 to `~robot_cmd_vel`. Its limits can be changed at run time
(dynamic_reconfigure). All topics are private: a launch file remaps them, as in ROS.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from rosmini.core.dynamic_reconfigure import Server
from rosmini.core.graph import Node
from rosmini.core.parameters import Parameters, parameter
from rosmini.msgs import message_class

from .smoother import FEEDBACK, Limits, VelocitySmoother


@dataclass(frozen=True)
class SmootherLimits(Parameters):
    """The parameters that can be changed at run time."""

    dynamic = True

    speed_lim_v: float = parameter(1.0, "the highest speed", unit="m/s", minimum=0.0, maximum=10.0)
    speed_lim_w: float = parameter(5.0, "the fastest turn", unit="rad/s", minimum=0.0, maximum=10.0)
    accel_lim_v: float = parameter(0.5, "the strongest acceleration", unit="m/s2", minimum=0.0, maximum=10.0)
    accel_lim_w: float = parameter(2.5, "the strongest angular acceleration", unit="rad/s2", minimum=0.0, maximum=10.0)
    decel_factor: float = parameter(
        1.0, "how many times stronger the braking is than the acceleration", minimum=0.0, maximum=10.0
    )


@dataclass(frozen=True)
class SmootherParameters(SmootherLimits):
    """The private parameters of `yocs_velocity_smoother/velocity_smoother`."""

    frequency: float = parameter(20.0, "publication rate", unit="Hz", minimum=0.1, maximum=1000.0)
    robot_feedback: int = parameter(
        0, "where the robot's speeds come from: 0 nowhere, 1 its odometry, 2 the commands that reach it"
    )
    quiet: bool = parameter(False, "do not warn about a command that is not a number")


class VelocitySmootherNode:
    """The velocity smoother as a node."""

    def __init__(self, node: Node) -> None:
        parameters = SmootherParameters.read(node)
        self.node = node
        feedback = parameters.robot_feedback
        if not 0 <= feedback < len(FEEDBACK):
            node.logwarn(
                f"Invalid robot feedback type ({feedback}). Valid options are 0 (NONE, default), 1 (ODOMETRY) and "
                "2 (COMMANDS)"
            )
            feedback = 0
        self.smoother = VelocitySmoother(period=1 / parameters.frequency, feedback=FEEDBACK[feedback])
        self._quiet = parameters.quiet
        self._server = Server(node, SmootherLimits, self._reconfigure)
        twist = message_class("geometry_msgs/Twist")
        self._message = twist()
        self._publisher = node.publisher("~smooth_cmd_vel", twist, queue_size=1)
        node.subscriber("~raw_cmd_vel", twist, self._command, queue_size=1)
        if feedback == 1:
            node.subscriber(
                "~odometry",
                message_class("nav_msgs/Odometry"),
                lambda message: self._measured(message.twist.twist),
                queue_size=1,
            )
        if feedback == 2:
            node.subscriber("~robot_cmd_vel", twist, self._measured, queue_size=1)
        node.timer(1 / parameters.frequency, self._step)

    def _reconfigure(self, config: Any, _: int) -> Any:
        self.smoother.limits = Limits(
            config["speed_lim_v"],
            config["speed_lim_w"],
            config["accel_lim_v"],
            config["accel_lim_w"],
            config["decel_factor"],
        )
        return config

    def _measured(self, twist: Any) -> None:
        v, w = twist.linear.x, twist.angular.z
        if math.isfinite(v) and math.isfinite(w):
            self.smoother.measured = (v, w)

    def _command(self, twist: Any) -> None:
        v, w = twist.linear.x, twist.angular.z
        if not (math.isfinite(v) and math.isfinite(w)):
            if not self._quiet:
                self._quiet = True
                self.node.logwarn(
                    f"a command of {v} m/s and {w} rad/s came in: a velocity must be a finite number. It counts as "
                    "a stop, and so will others, without another warning."
                )
            v = w = 0.0
        self.smoother.command(v, w, self._now())

    def _now(self) -> float:
        return self.node.clock.now_ns() * 1e-9

    def _step(self, _: Any) -> None:
        told = self.smoother.step(self._now())
        if told is not None:
            self._message.linear.x, self._message.angular.z = told
            self._publisher.publish(self._message)
