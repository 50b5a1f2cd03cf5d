"""Wrong answers to the exercises of the chapter amcl."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from rosmini.book.checks import Script

from .published import solution

if TYPE_CHECKING:
    from collections.abc import Callable

HERE = """
import math
import rospy
from geometry_msgs.msg import PoseWithCovarianceStamped

rospy.init_node("here")
pub = rospy.Publisher("initialpose", PoseWithCovarianceStamped, queue_size=1)
rospy.sleep(1)
yaw = rospy.get_param("~yaw")
message = PoseWithCovarianceStamped()
message.header.frame_id = "map"
message.pose.pose.position.x = rospy.get_param("~x")
message.pose.pose.position.y = rospy.get_param("~y")
message.pose.pose.orientation.z = math.sin(yaw / 2)
message.pose.pose.orientation.w = math.cos(yaw / 2)
message.pose.covariance[0] = 0.15 ** 2
message.pose.covariance[7] = 0.15 ** 2
message.pose.covariance[35] = 0.1 ** 2
pub.publish(message)
"""

COURIER = solution("amcl", "find_yourself")


def _but(old: str, new: str, right: str = HERE) -> Callable[[], Any]:
    assert old in right
    return lambda: Script("answer.py", right.replace(old, new))


def _drawn(weights: Any, u: float) -> Any:
    p = weights / weights.sum()
    return np.random.default_rng(3).choice(len(p), len(p), p=p)


def _uneven(weights: Any, u: float) -> Any:
    return np.searchsorted(np.cumsum(weights), (np.arange(len(weights)) + u) / len(weights))


def _deaf(weights: Any, u: float) -> Any:
    n = len(weights)
    return np.searchsorted(np.cumsum(weights / weights.sum()), np.arange(n) / n, side="right")


MISTAKES: dict[str, list[Callable[[], Any]]] = {
    "systematic": [
        lambda: _drawn,
        lambda: _uneven,
        lambda: _deaf,
        lambda: lambda w, _: [int(np.argmax(w))] * len(w),
        lambda: lambda w, _: [0],
    ],
    "here_i_am": [
        _but('frame_id = "map"', 'frame_id = "odom"'),
        _but("math.sin(yaw / 2)", "yaw"),
        _but('get_param("~x")', "get_param('~y')"),
        _but("covariance[35]", "covariance[34]"),
        _but("covariance[7] = 0.15 ** 2", "covariance[7] = 0.15"),
        _but("pub.publish(message)", ""),
        _but("covariance[35] = 0.1 ** 2", "covariance[35] = 0.1 ** 2; message.pose.covariance[14] = 1.0"),
    ],
    "find_yourself": [
        _but('rospy.ServiceProxy("global_localization", Empty)()\n', "", COURIER),
        _but("0.2**2", "2.0**2", COURIER),
        _but("    if found:\n        return\n", "", COURIER),
    ],
}
