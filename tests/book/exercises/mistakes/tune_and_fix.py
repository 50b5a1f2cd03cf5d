"""Wrong answers to the exercises of the chapter Tune and fix: right ones with a fault put in."""

from __future__ import annotations

from .file_system import wrong

SPINNING = """
DWAPlannerROS:
  min_vel_theta: 0.3
  yaw_goal_tolerance: 0.05
"""

GHOSTS = """
global_costmap:
  scan: {marking: true, clearing: true}
local_costmap:
  scan: {marking: true, clearing: true}
"""

LOST = """
<launch>
  <include file="$(find rosmini_sim)/launch/navigation.launch">
    <arg name="x" value="0.9"/>
    <arg name="y" value="2.6"/>
    <arg name="yaw" value="3.14"/>
    <arg name="localization" value="amcl"/>
  </include>
  <rosparam ns="move_base/local_costmap">
    footprint: [[-0.105, -0.105], [-0.105, 0.105], [0.041, 0.105], [0.041, -0.105]]
  </rosparam>
</launch>
"""

MISTAKES = {
    "spinning": [
        wrong(SPINNING, "0.3", "1.37"),
        wrong(SPINNING, "0.05", "0.5"),
        wrong(SPINNING, "theta: 0.3", "theta: ["),
        lambda: {"DWAPlannerROS": {}},
    ],
    "ghosts": [wrong(GHOSTS, "clearing: true", "clearing: false"), wrong(GHOSTS, "marking: true", "marking: false")],
    "lost": [
        wrong(LOST, '    <arg name="localization" value="amcl"/>\n'),
        wrong(LOST, 'name="x" value="0.9"', 'name="x" value="-3.0"'),
        wrong(LOST, '"amcl"/>', '"amcl"/>\n    <arg name="initial_pose_x" value="-3.0"/>'),
        wrong(
            LOST,
            "[[-0.105, -0.105], [-0.105, 0.105], [0.041, 0.105], [0.041, -0.105]]",
            "[[-0.5, -0.5], [-0.5, 0.5], [0.5, 0.5], [0.5, -0.5]]",
        ),
        lambda: "<launch/>",
        lambda: "<launch>",
    ],
}
