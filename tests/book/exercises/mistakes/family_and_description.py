"""Wrong answers to the exercises of the chapter Family and description: right ones with a fault put in."""

from __future__ import annotations

from . import file_system
from .nodes_and_master import wrong
from .published import solution

MAST = """
<robot name="courier" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:include filename="$(find turtlebot3_description)/urdf/turtlebot3_burger.urdf.xacro"/>
  <link name="mast_link">
    <visual>
      <origin xyz="0 0 0.1"/>
      <geometry><cylinder radius="0.005" length="0.2"/></geometry>
    </visual>
  </link>
  <joint name="mast_joint" type="fixed">
    <parent link="base_link"/>
    <child link="mast_link"/>
    <origin xyz="-0.09 0 0.15"/>
  </joint>
  <link name="light_link">
    <visual><geometry><sphere radius="0.015"/></geometry></visual>
  </link>
  <joint name="light_joint" type="fixed">
    <parent link="mast_link"/>
    <child link="light_link"/>
    <origin xyz="0 0 0.2"/>
  </joint>
</robot>
"""

LIFT = solution("family_and_description", "flag_up")

WEIGH = """
import xml.etree.ElementTree as ElementTree
import rospy
from std_msgs.msg import Float32

rospy.init_node("weigh")
mass = rospy.Publisher("mass", Float32, queue_size=1, latch=True)
robot = ElementTree.fromstring(rospy.get_param("robot_description"))
mass.publish(sum(float(each.get("value")) for each in robot.iter("mass")))
rospy.spin()
"""

MISTAKES = {
    "mast": [
        lambda: ["mast"],
        file_system.wrong(MAST, '"0 0 0.1"', '"0 0 0"'),
        file_system.wrong(MAST, '"-0.09 0 0.15"', '"0.09 0 0.15"'),
        file_system.wrong(MAST, '"0 0 0.2"', '"0 0 0.1"'),
        file_system.wrong(MAST, 'radius="0.005"', 'radius="0.01"'),
        file_system.wrong(MAST, '"light_joint" type="fixed"', '"light_joint" type="continuous"'),
        file_system.wrong(MAST, '<sphere radius="0.015"/>', '<box size="0.03 0.03 0.03"/>'),
        file_system.wrong(MAST, '<parent link="base_link"/>', '<parent link="base"/>'),
        file_system.wrong(
            MAST, '<xacro:include filename="$(find turtlebot3_description)/urdf/turtlebot3_burger.urdf.xacro"/>'
        ),
    ],
    "flag_up": [
        wrong("lift.py", LIFT, "abs(speed.linear.x)", "speed.linear.x"),
        wrong("lift.py", LIFT, " or abs(speed.angular.z) > 0.01", ""),
        wrong("lift.py", LIFT, "0.0 if moves else 1.57", "1.57 if moves else 0.0"),
        wrong("lift.py", LIFT, '["lift_joint"]', '["flag_joint"]'),
        wrong("lift.py", LIFT, "[0.0 if moves else 1.57]", "0.0 if moves else 1.57"),
    ],
    "weigh": [
        wrong("weigh.py", WEIGH, ", latch=True", ""),
        wrong("weigh.py", WEIGH, "sum(", "max("),
        wrong("weigh.py", WEIGH, "rospy.spin()", "mass.publish(1.0)\nrospy.spin()"),
        wrong("weigh.py", WEIGH, 'robot.iter("mass")', 'robot.iter("link")'),
        wrong("weigh.py", WEIGH, 'sum(float(each.get("value")) for each in robot.iter("mass"))', "1.0017"),
    ],
}
