"""Wrong answers to the exercises of the chapter Beyond."""

from __future__ import annotations

from rosmini.book.checks import Script

HALL = """
<launch>
  <include file="$(find rosmini_sim)/launch/simulator.launch"> <arg name="world" value="pillars"/> </include>
  <include file="$(find turtlebot3_slam)/launch/turtlebot3_slam.launch">
    <arg name="open_rviz" value="false"/>
  </include>
  <include file="$(find turtlebot3_navigation)/launch/move_base.launch"/>
  <include file="$(find frontier_exploration)/launch/global_map.launch"/>
</launch>
"""
TWICE = HALL.replace(
    "$(find frontier_exploration)/launch/global_map", "$(find turtlebot3_slam)/launch/turtlebot3_frontier_exploration"
)
MUTE = HALL.replace(
    'move_base.launch"/>', 'move_base.launch"> <arg name="cmd_vel_topic" value="/auto_vel"/> </include>'
)

HOME = """
import actionlib
import rospy
import tf2_ros
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal

rospy.init_node("come_home")
buffer = tf2_ros.Buffer()
listener = tf2_ros.TransformListener(buffer)
client = actionlib.SimpleActionClient("move_base", MoveBaseAction)
client.wait_for_server()
start = buffer.lookup_transform("map", "base_footprint", rospy.Time(), rospy.Duration(5)).transform
away, home = MoveBaseGoal(), MoveBaseGoal()
for goal in (away, home):
    goal.target_pose.header.frame_id = "map"
    goal.target_pose.pose.orientation.w = 1.0
away.target_pose.pose.position.x = rospy.get_param("~x")
away.target_pose.pose.position.y = rospy.get_param("~y")
home.target_pose.pose.position.x = start.translation.x
home.target_pose.pose.position.y = start.translation.y
home.target_pose.pose.orientation = start.rotation
client.send_goal_and_wait(away)
client.send_goal_and_wait(home)
"""


def _home(old: str, new: str) -> Script:
    assert old in HOME
    return Script("come_home.py", HOME.replace(old, new))


MISTAKES = {
    "hall": [lambda: TWICE, lambda: MUTE, lambda: HALL.replace("pillars", "house")],
    "come_home": [
        lambda: _home("client.send_goal_and_wait(away)", "client.send_goal(away)"),
        lambda: _home("home.target_pose.pose.orientation = start.rotation\n", ""),
    ],
    "drivers": [
        lambda: lambda state, topic: dict(state[0])[topic],
        lambda: lambda state, topic: sorted(dict(state[0])[topic]),
        lambda: (
            lambda state, topic: sorted(n for part in state for name, nodes in part if name == topic for n in nodes)
        ),
    ],
}
