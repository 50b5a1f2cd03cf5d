"""Wrong answers to the exercises of the chapter The Parameter Server: right ones with a fault put in."""

from __future__ import annotations

from .nodes_and_master import wrong
from .published import solution

MAX_SPEED = solution("parameter_server", "max_speed")

PAUSED = """
import rospy
from geometry_msgs.msg import Twist

rospy.init_node("driver")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rate = rospy.Rate(10)
while not rospy.is_shutdown():
    command = Twist()
    if not rospy.get_param("/paused", False):
        command.linear.x = 0.1
    cmd_vel.publish(command)
    rate.sleep()
"""

QUIET = """
import rospy
from geometry_msgs.msg import Twist

rospy.init_node("driver")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
command = Twist()
name = rospy.search_param("quiet")
is_quiet = name is not None and rospy.get_param(name)
command.linear.x = 0.05 if is_quiet else 0.2
rate = rospy.Rate(10)
while not rospy.is_shutdown():
    cmd_vel.publish(command)
    rate.sleep()
"""

MEASURED = """
import rospy

def merge(name, values):
    for key, value in values.items():
        if isinstance(value, dict):
            merge(f"{name}/{key}", value)
        else:
            rospy.set_param(f"{name}/{key}", value)

rospy.init_node("mechanic")
merge("/robot", rospy.get_param("/measured"))
rospy.delete_param("/measured")
"""


MISTAKES = {
    "max_speed": [
        wrong("limiter.py", MAX_SPEED, '"~max_speed"', '"max_speed"'),
        wrong("limiter.py", MAX_SPEED, '"~max_speed"', '"/limiter/max_speed"'),
        wrong("limiter.py", MAX_SPEED, ", 0.22)", ")"),
        wrong("limiter.py", MAX_SPEED, "max(-limit, min(limit, wish.linear.x))", "min(limit, wish.linear.x)"),
        wrong("limiter.py", MAX_SPEED, "wish.linear.x = max", "wish.angular.z = max"),
        wrong("limiter.py", MAX_SPEED, "    cmd_vel.publish(wish)\n"),
    ],
    "paused": [
        wrong("pause.py", PAUSED, ", False)", ")"),
        wrong("pause.py", PAUSED, "/paused", "~paused"),
        wrong("pause.py", PAUSED, "if not rospy", "if rospy"),
        wrong("pause.py", PAUSED, "    cmd_vel.publish(command)", "        cmd_vel.publish(command)"),
        wrong(
            "pause.py",
            PAUSED.replace("rate = ", 'is_paused = rospy.get_param("/paused", False)\nrate = '),
            'rospy.get_param("/paused", False):',
            "is_paused:",
        ),
    ],
    "quiet": [
        wrong("quiet.py", QUIET, 'rospy.search_param("quiet")', '"/quiet"'),
        wrong("quiet.py", QUIET, "name is not None and rospy.get_param(name)", "name is not None"),
        wrong("quiet.py", QUIET, 'rospy.search_param("quiet")', 'rospy.resolve_name("quiet")'),
        wrong("quiet.py", QUIET, "name is not None and ", ""),
        wrong("quiet.py", QUIET, "0.05 if is_quiet else 0.2", "0.2 if is_quiet else 0.05"),
    ],
    "measured": [
        wrong("measured.py", MEASURED, 'rospy.delete_param("/measured")\n'),
        wrong("measured.py", MEASURED, 'merge("/robot"', 'rospy.set_param("/robot"'),
        wrong("measured.py", MEASURED, "isinstance(value, dict)", "False"),
        wrong("measured.py", MEASURED, 'merge(f"{name}/{key}", value)', "merge(name, value)"),
    ],
}
