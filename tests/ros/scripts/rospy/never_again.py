#!/usr/bin/env python
# Starts a node, and then only computes.
import rospy
from std_msgs.msg import String

rospy.init_node("busy")
count = []
rospy.Subscriber("chatter", String, lambda msg: count.append(msg.data))
total = 0
while True:
    total += 1
    if len(count) == 3:
        break
print("three messages came in between")
