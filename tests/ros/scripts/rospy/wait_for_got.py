#!/usr/bin/env python
import rospy
from std_msgs.msg import String

got = None


def callback(msg):
    global got
    got = msg.data


rospy.init_node("waiter")
rospy.Subscriber("chatter", String, callback)
while not got:
    pass
print("got", got)
