"""Wrong answers to the exercises of the chapter Bags: right ones with a fault put in."""

from __future__ import annotations

from .nodes_and_master import wrong

SILENCE = """
import sys

import rosbag

with rosbag.Bag(sys.argv[1]) as bag:
    times = [t.to_sec() for _, _, t in bag.read_messages(sys.argv[2])]
print(max(later - earlier for earlier, later in zip(times, times[1:])))
"""

WAY_BACK = """
import sys

import rosbag
import rospy
from geometry_msgs.msg import Twist

with rosbag.Bag(sys.argv[1]) as bag:
    drive = [(m, t) for _, m, t in bag.read_messages("/cmd_vel")]

rospy.init_node("way_back")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.sleep(0.5)
for (command, begin), (_, end) in reversed(list(zip(drive, drive[1:]))):
    command.linear.x *= -1
    command.angular.z *= -1
    cmd_vel.publish(command)
    rospy.sleep(end - begin)
cmd_vel.publish(Twist())
"""

MISTAKES = {
    "longest_silence": [
        wrong("silence.py", SILENCE, "max(later", "min(later"),
        wrong("silence.py", SILENCE, "max(later", "sum(later"),
        wrong("silence.py", SILENCE, "sys.argv[2]", '"/chatter"'),
        wrong("silence.py", SILENCE, "(sys.argv[2])", "()"),
        wrong("silence.py", SILENCE, "print(", "(lambda x: x)("),
        wrong("silence.py", SILENCE, "sys.argv[1]", '"nosuch.bag"'),
    ],
    "fast_commands": [
        lambda: "topic == '/cmd_vel'",
        lambda: "m.linear.x > 0.1",
        lambda: "topic == '/cmd_vel' and m.linear.x >= 0.1",
        lambda: "topic == '/cmd_vel' and m.angular.z > 0.1",
        lambda: "topic == '/cmd_vel' and abs(m.linear.x) > 0.1",
        lambda: "topic == '/odom' and m.linear.x > 0.1",
        lambda: 1,
    ],
    "way_back": [
        wrong("way_back.py", WAY_BACK, "reversed(list(zip(drive, drive[1:])))", "zip(drive, drive[1:])"),
        wrong("way_back.py", WAY_BACK, "    command.linear.x *= -1\n"),
        wrong("way_back.py", WAY_BACK, "    command.angular.z *= -1\n"),
        wrong("way_back.py", WAY_BACK, "end - begin", "0.1"),
        wrong("way_back.py", WAY_BACK, "    cmd_vel.publish(command)\n"),
        wrong("way_back.py", WAY_BACK, "sys.argv[1]", '"nosuch.bag"'),
    ],
}
