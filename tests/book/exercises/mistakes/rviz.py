"""Wrong answers to the exercises of the chapter RViz: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Script

if TYPE_CHECKING:
    from collections.abc import Callable

LASER: dict[str, Any] = {
    "Topic": "/scan", "Color Transformer": "FlatColor", "Color": (255, 0, 0), "Size (m)": 0.05, "Decay Time": 10.0,
}  # fmt: skip

TRAIL = """
import rospy
from nav_msgs.msg import Odometry
from visualization_msgs.msg import Marker


def begin(line):
    line.type = Marker.LINE_STRIP
    line.scale.x = 0.03
    line.color.g, line.color.a = 1.0, 1.0
    line.pose.orientation.w = 1.0


def hear(odom):
    line.header = odom.header
    line.points.append(odom.pose.pose.position)
    markers.publish(line)


rospy.init_node("trail")
line = Marker()
begin(line)
markers = rospy.Publisher("visualization_marker", Marker, queue_size=1)
rospy.Subscriber("odom", Odometry, hear)
rospy.spin()
"""


def _laser(**changed: Any) -> Callable[[], dict[str, Any]]:
    return lambda: {**LASER, **{name.replace("_", " "): value for name, value in changed.items()}}


def _without(name: str) -> Callable[[], dict[str, Any]]:
    return lambda: {each: value for each, value in LASER.items() if each != name}


def _script(old: str, new: str) -> Callable[[], Script]:
    assert old in TRAIL
    return lambda: Script("answer.py", TRAIL.replace(old, new))


def _mend(frame: str = "odom", laser: str = "/scan", way: str = "/odom", *, on: bool = True) -> Callable[[], Any]:
    def mend(scene: Any) -> None:
        scene.fixed_frame = frame
        scene["Laser"]["Topic"] = laser
        scene["Way"]["Topic"] = way
        scene["Frames"].enabled = on

    return lambda: mend


def _new_ones(scene: Any) -> None:
    scene.fixed_frame = "odom"
    for display in list(scene):
        scene.remove(display)
    scene.add("LaserScan", {"Topic": "/scan"})


MISTAKES: dict[str, list[Callable[[], object]]] = {
    "properties": [
        dict,
        lambda: "FlatColor",
        lambda: {1: 2},
        _laser(Topic="/scans"),
        _laser(Colour=(255, 0, 0)),
        _laser(Color=(0, 0, 255)),
        _laser(Color_Transformer="Red"),
        _laser(Decay_Time=1.0),
        _laser(Style="Points"),
        *(_without(name) for name in LASER),
    ],
    "correct": [
        lambda: print,
        _mend(frame="odon"),
        _mend(frame="base_footprint"),
        _mend(laser="/scans"),
        _mend(laser="/odom"),
        _mend(way="/imu"),
        _mend(on=False),
        lambda: _new_ones,
    ],
    "trail": [
        _script("LINE_STRIP", "POINTS"),
        _script("0.03", "0.3"),
        _script(", line.color.a = 1.0, 1.0", " = 1.0"),
        _script("line.header = odom.header", "line.header.frame_id = 'map'"),
        _script("line.points.append(odom.pose.pose.position)", "line.points = [odom.pose.pose.position]"),
        _script("line.points.append(", "line.id += 1\n    line.points.append("),
        _script('"visualization_marker"', '"trail"'),
        _script("    markers.publish(line)\n", ""),
    ],
}
