"""Wrong answers to the exercises of the chapter Local planners."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from rosmini.book.checks import Script

if TYPE_CHECKING:
    from collections.abc import Callable

WANDER = """
import math

import numpy as np
import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import LaserScan


def simulate(v, w):
    x = y = yaw = 0.0
    points = []
    for _ in range(24):
        x += 0.1 * v * math.cos(yaw)
        y += 0.1 * v * math.sin(yaw)
        yaw += 0.1 * w
        points.append((x, y))
    return np.array(points)


def on_scan(scan):
    ranges = np.array(scan.ranges)
    angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
    hits = np.array([ranges * np.cos(angles), ranges * np.sin(angles)]).T
    hits = hits[np.isfinite(ranges)]
    command = Twist()
    possible = []
    for w in np.linspace(-1.5, 1.5, 13):
        points = simulate(0.15, w)
        if np.linalg.norm(points[:, None] - hits, axis=2).min() >= 0.2:
            possible.append(w)
    if possible:
        command.linear.x = 0.15
        command.angular.z = min(possible, key=abs)
    else:
        command.angular.z = 0.8
    cmd_vel.publish(command)


rospy.init_node("wander")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.Subscriber("scan", LaserScan, on_scan, queue_size=1)
rospy.spin()
"""


def _but(old: str, new: str) -> Callable[[], Script]:
    assert old in WANDER, old
    return lambda: Script("wander.py", WANDER.replace(old, new))


def _manners(nearest, cost):
    def manners(trajectory, person):
        distances = np.hypot(*(trajectory[:, :2] - person).T)
        distance = nearest(distances)
        return -1 if distance < 0.4 else cost(distance)

    return manners


MISTAKES: dict[str, list[Callable[[], object]]] = {
    "manners": [
        lambda: _manners(lambda d: d[-1], lambda d: max(0.0, (1 - d) / 0.6)),
        lambda: _manners(lambda d: d[0], lambda d: max(0.0, (1 - d) / 0.6)),
        lambda: _manners(np.mean, lambda d: max(0.0, (1 - d) / 0.6)),
        lambda: _manners(np.min, lambda d: (1 - d) / 0.6),
        lambda: _manners(np.min, lambda d: max(0.0, 1 - d)),
        lambda: _manners(np.min, lambda d: 0.0),
        lambda: lambda *_: [0.0],
    ],
    "wander": [
        _but("        command.angular.z = 0.8\n", "        pass\n"),
        _but(".min() >= 0.2", ".min() >= 0.0"),
        _but("command.linear.x = 0.15", "pass"),
        _but("key=abs)", "key=abs) + 0.1 * missing"),
        _but("min(possible, key=abs)", "max(possible, key=abs)"),
        _but("min(possible, key=abs)", "possible[0]"),
    ],
    "past_the_crate": [
        lambda: "DWAPlannerROS: {sim_time: 0.3}",
        lambda: "DWAPlannerROS: {occdist_scale: 1.0}",
        lambda: "DWAPlannerROS: {sim_time: 4.0}",
        lambda: "DWAPlannerROS: [",
        lambda: 1.7,
    ],
}
