#!/usr/bin/env python
import rospy
from geometry_msgs.msg import Twist

moving = False


def drive(msg):
    global moving
    if msg.linear.x > 0:
        moving = True
    elif moving:
        print("stopped")
        rospy.signal_shutdown("")


rospy.init_node("motor")
rospy.Subscriber("cmd_vel", Twist, drive)
rospy.spin()
