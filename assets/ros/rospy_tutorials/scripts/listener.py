#!/usr/bin/env python3
"""Logs what it hears on /chatter (http://wiki.ros.org/rospy_tutorials)."""

import rospy
from std_msgs.msg import String


def heard(message):
    """Log a message, with this node's name."""
    rospy.loginfo("%s: I heard %s", rospy.get_caller_id(), message.data)


if __name__ == "__main__":
    rospy.init_node("listener", anonymous=True)
    rospy.Subscriber("chatter", String, heard)
    rospy.spin()
