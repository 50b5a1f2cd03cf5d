"""Wrong answers to the exercises of the chapter Many TurtleBots: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.book.checks import Script

from .published import solution

if TYPE_CHECKING:
    from collections.abc import Callable

THIRD_ROBOT = """
<group ns="tb3_2">
  <param name="robot_description"
         command="$(find xacro)/xacro $(find turtlebot3_description)/urdf/turtlebot3_burger.urdf.xacro"/>
  <node pkg="robot_state_publisher" type="robot_state_publisher" name="robot_state_publisher">
    <param name="tf_prefix" value="tb3_2"/>
  </node>
  <node pkg="gazebo_ros" type="spawn_model" name="spawn_urdf"
        args="-urdf -model tb3_2 -x 1.0 -y -0.5 -z 0.0 -Y 1.57 -param robot_description"/>
</group>
"""

FOLLOW = solution("many_turtlebots", "follow")

TWO_STACKS = """
<launch>
  <node pkg="rosmini_sim" type="simulator" name="simulator">
    <param name="world" value="house"/>
    <rosparam param="robots">
      - {name: tb3_0, x: -3.0, y: 1.0}
      - {name: tb3_1, x: 0.5, y: 1.0, yaw: 3.14}
    </rosparam>
  </node>
  <node pkg="map_server" type="map_server" name="map_server" args="$(find rosmini_sim)/maps/house.yaml"/>
  <include file="$(find turtlebot3_navigation)/launch/multi_turtlebot3_navigation.launch">
    <arg name="ns" value="tb3_0"/>
    <arg name="initial_pose_x" value="-3.0"/>
    <arg name="initial_pose_y" value="1.0"/>
  </include>
  <include file="$(find turtlebot3_navigation)/launch/multi_turtlebot3_navigation.launch">
    <arg name="ns" value="tb3_1"/>
    <arg name="initial_pose_x" value="0.5"/>
    <arg name="initial_pose_y" value="1.0"/>
    <arg name="initial_pose_a" value="3.14"/>
  </include>
</launch>
"""


def _text(right: str, old: str, new: str) -> Callable[[], str]:
    assert old in right, old
    return lambda: right.replace(old, new)


def _script(old: str, new: str) -> Callable[[], Script]:
    assert old in FOLLOW, old
    return lambda: Script("answer.py", FOLLOW.replace(old, new))


MISTAKES: dict[str, list[Callable[[], object]]] = {
    "third_robot": [
        _text(THIRD_ROBOT, '<group ns="tb3_2">', "<group>"),
        _text(THIRD_ROBOT, '    <param name="tf_prefix" value="tb3_2"/>\n', ""),
        _text(THIRD_ROBOT, '"tf_prefix" value="tb3_2"', '"tf_prefix" value="tb3_1"'),
        _text(THIRD_ROBOT, "-Y 1.57", "-Y 90"),
        _text(THIRD_ROBOT, "-model tb3_2", "-model tb3_1"),
        _text(THIRD_ROBOT, "-urdf -model", "-model"),
        _text(THIRD_ROBOT, 'args="-urdf', 'arg="-urdf'),
        lambda: 7,
    ],
    "follow": [
        _script("max(-0.1, min(ahead - 0.4, 0.2))", "0.1"),
        _script("    if ahead < 1.0:\n        command", "    command"),
        _script("max(-0.1, min(ahead - 0.4, 0.2))", "0.2"),
        _script('"cmd_vel"', '"/middle/cmd_vel"'),
        _script("scan.ranges[:21] + scan.ranges[-20:]", "scan.ranges"),
        _script('"scan"', '"/scan"'),
    ],
    "two_stacks": [
        _text(TWO_STACKS, 'name="map_server" args', 'name="map_server" ns="tb3_0" args'),
        _text(TWO_STACKS, '    <arg name="initial_pose_a" value="3.14"/>\n', ""),
        _text(TWO_STACKS, ", yaw: 3.14", ""),
        _text(TWO_STACKS, '<arg name="ns" value="tb3_1"/>', '<arg name="ns" value="tb3_0"/>'),
    ],
}
