"""Wrong answers to the exercises of the chapter Files."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

MESSAGE = "uint8 COLD = 0\nuint8 HOT = 1\nHeader header\nfloat32 motor\nfloat32[3] sonar\nstring note\n"

MANIFEST = """<?xml version="1.0"?>
<package format="2">
  <name>patrol</name>
  <version>0.1.0</version>
  <description>Drives round and round, and stops before walls.</description>
  <maintainer email="ada@example.org">Ada</maintainer>
  <license>MIT</license>
  <buildtool_depend>catkin</buildtool_depend>
  <exec_depend>rospy</exec_depend>
  <exec_depend>geometry_msgs</exec_depend>
  <exec_depend>sensor_msgs</exec_depend>
</package>
"""

LAUNCH = """
<launch>
  <node pkg="rosmini_sim" type="simulator" name="simulator">
    <param name="model" value="waffle"/>
    <param name="world" value="maze"/>
  </node>
</launch>
"""


def wrong(right: str, old: str = "", new: str = "") -> Callable[[], str]:
    """Return what makes a text with one place of it changed."""
    assert old in right
    return lambda: right.replace(old, new)


MISTAKES = {
    "users": [
        lambda: ["turtlebot3_gazebo"],
        lambda: ["turtlebot3_gazebo", "turtlebot3_bringup", "turtlebot3_navigation", "turtlebot3_slam"],
        lambda: ["my_robot", "turtlebot3_bringup", "turtlebot3_gazebo", "turtlebot3_navigation", "turtlebot3_slam"],
        lambda: "turtlebot3_bringup",
    ],
    "message_definition": [
        wrong(MESSAGE, "float32 motor", "float64 motor"),
        wrong(MESSAGE, "float32[3]", "float32[]"),
        wrong(MESSAGE, "HOT = 1", "HOT = 2"),
        wrong(MESSAGE, "uint8 COLD = 0\n"),
        wrong(MESSAGE, "uint8 HOT", "int8 HOT"),
        wrong(MESSAGE, "string note", "note string"),
        lambda: ["float32 motor"],
    ],
    "repaired": [
        wrong(MANIFEST, "  <license>MIT</license>\n"),
        wrong(MANIFEST, "MIT", "TODO"),
        wrong(MANIFEST, "  <exec_depend>sensor_msgs</exec_depend>\n"),
        wrong(MANIFEST, "<exec_depend>rospy", "<build_depend>rospy"),
        wrong(MANIFEST, "</package>", "  <exec_depend>turtlebot3_gazebo</exec_depend>\n</package>"),
        wrong(MANIFEST, "<name>patrol", "<name>patrols"),
        wrong(MANIFEST, "</package>"),
    ],
    "launch": [
        wrong(LAUNCH, "waffle", "burger"),
        wrong(LAUNCH, '    <param name="world" value="maze"/>\n'),
        wrong(LAUNCH, 'type="simulator"', 'type="simulate"'),
        wrong(LAUNCH, "</launch>"),
        lambda: (
            '<launch><param name="model" value="waffle"/><param name="world" value="maze"/>'
            '<node pkg="rosmini_sim" type="simulator" name="simulator"/></launch>'
        ),
        lambda: "<launch></launch>",
    ],
}
