"""Wrong answers to the exercises of the chapter The Navigation Stack: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.book.checks import Script

from .published import solution

if TYPE_CHECKING:
    from collections.abc import Callable

STACK = """
<launch>
  <include file="$(find rosmini_sim)/launch/simulator.launch">
    <arg name="world" value="room"/>
  </include>
  <include file="$(find turtlebot3_bringup)/launch/turtlebot3_remote.launch">
    <arg name="model" value="burger"/>
  </include>
  <node pkg="map_server" type="map_server" name="map_server" args="$(find rosmini_sim)/maps/room.yaml"/>
  <node pkg="fake_localization" type="fake_localization" name="fake_localization"/>
  <include file="$(find turtlebot3_navigation)/launch/move_base.launch">
    <arg name="model" value="burger"/>
  </include>
</launch>
"""

GOAL = solution("navigation_stack", "go_there")

NEAREST = """
import math

import rospy
from geometry_msgs.msg import PoseStamped
from nav_msgs.srv import GetPlan

PLACES = [(-2.6, 2.4), (-2.2, -0.9), (-5.2, 0.8), (-2.9, -4.0)]


def goal_at(x, y):
    goal = PoseStamped()
    goal.header.frame_id = "map"
    goal.pose.position.x, goal.pose.position.y = x, y
    goal.pose.orientation.w = 1.0
    return goal


def length(poses):
    points = [(p.pose.position.x, p.pose.position.y) for p in poses]
    return sum(math.dist(a, b) for a, b in zip(points, points[1:]))


rospy.init_node("nearest")
rospy.wait_for_service("move_base/make_plan")
make_plan = rospy.ServiceProxy("move_base/make_plan", GetPlan)
goals = rospy.Publisher("move_base_simple/goal", PoseStamped, queue_size=1)
rospy.sleep(1.0)
found = {}
for place in PLACES:
    path = make_plan(PoseStamped(), goal_at(*place), 0.1).plan.poses
    if path:
        found[place] = length(path)
goals.publish(goal_at(*min(found, key=found.get)))
rospy.sleep(1.0)
"""


def _but(right: str, old: str, new: str) -> Callable[[], Script]:
    assert old in right, old
    return lambda: Script("answer.py", right.replace(old, new))


def _stack(old: str, new: str) -> Callable[[], str]:
    assert old in STACK, old
    return lambda: STACK.replace(old, new)


MISTAKES: dict[str, list[Callable[[], object]]] = {
    "stack": [
        _stack('type="map_server"', 'type="map_saver"'),
        _stack('<node pkg="fake_localization" type="fake_localization" name="fake_localization"/>', ""),
        _stack("maps/room.yaml", "maps/house.yaml"),
        _stack("</launch>", ""),
        lambda: 1,
    ],
    "go_there": [
        _but(GOAL, "    rospy.sleep(0.1)\n", "    break\n"),
        _but(GOAL, 'goal.header.frame_id = "map"\n', ""),
        _but(GOAL, '"map"', '"odom"'),
        _but(GOAL, "goal.pose.orientation.z = goal.pose.orientation.w = 0.7071\n", ""),
        _but(GOAL, "goal.pose.orientation.z = goal.pose.orientation.w = 0.7071", "goal.pose.orientation.w = 1.0"),
        lambda: "rostopic pub -1 /move_base_simple/goal",
    ],
    "nearest": [
        _but(NEAREST, "return sum(math.dist(a, b) for a, b in zip(points, points[1:]))", "return len(points) % 7"),
        _but(NEAREST, "    return sum", "    return points and math.dist(points[0], points[-1])\n    return sum"),
        _but(NEAREST, "    if path:\n    ", ""),
        _but(NEAREST, "min(found, key=found.get)", "PLACES[2]"),
    ],
}
