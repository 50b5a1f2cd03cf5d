#!/usr/bin/env python3
"""Says hello on /chatter, ten times a second (http://wiki.ros.org/rospy_tutorials)."""

import rospy
from std_msgs.msg import String


def talk():
    """Publish until the node is shut down."""
    publisher = rospy.Publisher("chatter", String, queue_size=10)
    rospy.init_node("talker", anonymous=True)
    rate = rospy.Rate(10)
    while not rospy.is_shutdown():
        text = f"hello world {rospy.get_time()}"
        rospy.loginfo(text)
        publisher.publish(text)
        rate.sleep()


if __name__ == "__main__":
    try:
        talk()
    except rospy.ROSInterruptException:
        pass
