"""Wrong answers to the exercises of the chapter GMapping: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from rosmini.book.checks import Script

if TYPE_CHECKING:
    from collections.abc import Callable

SURVEYOR = """
import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import OccupancyGrid
from sensor_msgs.msg import LaserScan

state = {"known": 0, "dull": 0}


def on_map(grid):
    known = sum(cell >= 0 for cell in grid.data)
    news = known - state["known"]
    if state["dull"] < 3:
        state["dull"] = state["dull"] + 1 if news < 40 else 0
    state["known"] = known


def on_scan(scan):
    command = Twist()
    if state["dull"] < 3:
        if min(scan.ranges[:30] + scan.ranges[-30:]) > 0.4:
            command.linear.x = 0.2
        else:
            command.angular.z = 0.7
    cmd_vel.publish(command)


rospy.init_node("surveyor")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.Subscriber("map", OccupancyGrid, on_map)
rospy.Subscriber("scan", LaserScan, on_scan)
rospy.spin()
"""


def _but(old: str, new: str) -> Callable[[], Script]:
    assert old in SURVEYOR, old
    return lambda: Script("surveyor.py", SURVEYOR.replace(old, new))


def _likelihood(*, limit: float = 0.1, lost: float = -0.5, over: float = 0.075) -> Callable[[], Any]:
    return lambda: lambda d: np.where(d <= limit, -(d**2), lost).sum() / over


def _data(hits: Any, visits: Any, occ_thresh: float) -> Any:
    cells = np.where(hits / np.maximum(visits, 1) > occ_thresh, 100, 0)
    cells[visits == 0] = -1
    return cells


def _survivors(weights: Any, start: float, *, share: float = 0.5, side: Any = "right", step: float = 1.0) -> Any:
    weights = np.asarray(weights)
    count = len(weights)
    if 1 / (weights**2).sum() >= share * count:
        return list(range(count))
    marks = start + step * np.arange(count) / count
    return np.searchsorted(weights.cumsum(), marks, side=side).tolist()


MISTAKES: dict[str, list[Callable[[], Any]]] = {
    "log_likelihood": [
        _likelihood(limit=0.05),
        _likelihood(lost=0.0),
        _likelihood(over=0.05),
        lambda: lambda d: (-(d**2)).sum() / 0.075,
        lambda: lambda d: np.where(d <= 0.1, -d, -0.5).sum() / 0.075,
    ],
    "data_of": [
        lambda: _data,
        lambda: lambda h, v, t: _data(h, v, t)[::-1].ravel().tolist(),
        lambda: lambda h, v, t: _data(h, v, t).T.ravel().tolist(),
        lambda: lambda h, v, t: np.where(_data(h, v, t) < 0, 0, _data(h, v, t)).ravel().tolist(),
        lambda: lambda h, v, t: _data(h, v, 0.25).ravel().tolist(),
        lambda: lambda h, v, t: _data(h, v, t - 1e-9).ravel().tolist(),
    ],
    "survivors": [
        lambda: lambda w, s: _survivors(w, s, share=2.0),
        lambda: lambda w, s: _survivors(w, s, share=0.0),
        lambda: lambda w, s: _survivors(w, 0.0),
        lambda: lambda w, s: _survivors(w, s, step=0.5),
        lambda: lambda w, s: sorted(set(_survivors(w, s))),
        lambda: lambda w, s: [int(np.argmax(w))] * len(w),
    ],
    "map_is_done": [
        _but('if state["dull"] < 3:\n        if min', "if True:\n        if min"),
        _but('state["dull"] + 1 if news < 40 else 0', "3 if news < 40 else 0"),
        _but('state["dull"] + 1 if news < 40 else 0', 'state["dull"] + (news < 400)'),
        _but("command.linear.x = 0.2", "command.linear.x = 0.0"),
    ],
}
