"""Wrong answers to the exercises of the chapter Nodes and the Master: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.book.checks import Script

from .published import solution

if TYPE_CHECKING:
    from collections.abc import Callable

STOP = solution("nodes_and_master", "stop")

STOP_BY_TIME = """
import rospy
from geometry_msgs.msg import Twist

rospy.init_node("driver")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
command = Twist()
command.linear.x = 0.2
for _ in range(144):
    rospy.sleep(0.1)
    cmd_vel.publish(command)
rospy.spin()
"""

GENTLE = solution("nodes_and_master", "gentle")

INTRODUCE = solution("nodes_and_master", "introduce")

REGISTER = """
import rosgraph

master = rosgraph.Master("/simulator")
uri = master.lookupNode("/simulator")
rosgraph.Master("/driver").registerPublisher("/cmd_vel", "geometry_msgs/Twist", master.lookupNode("/driver"))
master.registerSubscriber("/cmd_vel", "geometry_msgs/Twist", uri)
"""

REFEREE = solution("nodes_and_master", "referee")


def wrong(name: str, right: str, old: str = "", new: str = "") -> Callable[[], Script]:
    """Return what makes a script with one place of it changed."""
    assert old in right
    return lambda: Script(name, right.replace(old, new))


MISTAKES = {
    "stop": [
        wrong("stop.py", STOP, "> 0.4", "> 0.0"),
        wrong("stop.py", STOP, "> 0.4", "> 1.0"),
        wrong("stop.py", STOP, "> 0.4", "< 0.4"),
        wrong("stop.py", STOP, "scan.ranges[0]", "scan.range[0]"),
        wrong("stop.py", STOP, "ranges[0]", "ranges[180]"),
        wrong("stop.py", STOP, '"cmd_vel"', '"cmd_vels"'),
        wrong("stop.py", STOP, "import LaserScan", "import LaserScann"),
        wrong("stop.py", STOP_BY_TIME),
        wrong("stop.py", "def broken(:"),
    ],
    "gentle": [
        wrong("gentle.py", GENTLE, "wish.angular.z / 2", "wish.angular.z"),
        wrong("gentle.py", GENTLE, "wish.linear.x / 2", "0.1"),
        wrong("gentle.py", GENTLE, '"wish"', '"wishes"'),
        wrong("gentle.py", GENTLE, '"cmd_vel"', '"wish_half"'),
        wrong("gentle.py", GENTLE, "rospy.spin()", "while not rospy.is_shutdown():\n    cmd_vel.publish(Twist())"),
        wrong("gentle.py", GENTLE, "rospy.spin()", ""),
    ],
    "introduce": [
        wrong("introduce.py", INTRODUCE, "[driver]", "[simulator]"),
        wrong("introduce.py", INTRODUCE, '"/cmd_vel"', '"/wish"'),
        wrong("introduce.py", INTRODUCE, "xmlrpcapi(simulator)", "xmlrpcapi(driver)"),
        wrong("introduce.py", INTRODUCE, '"/driver"', '"/drivers"'),
        wrong("introduce.py", REGISTER),
    ],
    "referee": [
        wrong("referee.py", REFEREE, ' and name != "/driver"'),
        wrong("referee.py", REFEREE, 'topic == "/cmd_vel" and'),
        wrong("referee.py", REFEREE, "in publishers", "in subscribers"),
        wrong("referee.py", REFEREE, "            node.shutdown", "            node.getPid"),
        wrong("referee.py", "print('nobody')"),
    ],
}
