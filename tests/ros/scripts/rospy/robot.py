#!/usr/bin/env python
# Tells how its speed changes; ends when it has moved and stands still.
import rospy
from geometry_msgs.msg import Twist

last = (0.0, 0.0)


def command(msg):
    global last
    now = (msg.linear.x, msg.angular.z)
    if now != last:
        print("%g %g" % now)
        if now == (0.0, 0.0):
            rospy.signal_shutdown("stopped")
    last = now


rospy.init_node("robot")
rospy.Subscriber("cmd_vel", Twist, command)
rospy.spin()
