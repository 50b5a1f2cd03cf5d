"""The robot's velocity from its odometry: `OdometryHelperRos`."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.graph import Node
from rosmini.msgs import message_class


class OdometryHelper:
    """Subscribes to `nav_msgs/Odometry`; `velocity` (3) is the latest one: x [m/s], y [m/s], theta [rad/s]."""

    def __init__(self, node: Node, topic: str = "odom") -> None:
        self.velocity: NDArray[np.float64] = np.zeros(3)
        self._warn = node.logwarn
        self._warned = False
        if topic:
            node.subscriber(topic, message_class("nav_msgs/Odometry"), self._on_odometry, queue_size=1)

    def _on_odometry(self, message: Any) -> None:
        twist = message.twist.twist
        values = (twist.linear.x, twist.linear.y, twist.angular.z)
        if all(map(math.isfinite, values)):
            self.velocity = np.array(values)
        elif not self._warned:
            self._warned = True
            self._warn(
                f"the odometry reports the velocity {values}, which is not finite: using the last finite one, without "
                "further warnings"
            )
