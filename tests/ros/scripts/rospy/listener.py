#!/usr/bin/env python
import rospy
from std_msgs.msg import String


def heard(msg):
    print("heard %s" % msg.data)
    if msg.data.endswith("2"):
        rospy.signal_shutdown("that was the last one")


rospy.init_node("listener")
rospy.Subscriber("chatter", String, heard)
rospy.spin()
print("done")
