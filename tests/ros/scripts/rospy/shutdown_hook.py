#!/usr/bin/env python
import rospy
from geometry_msgs.msg import Twist

rospy.init_node("hooked")
pub = rospy.Publisher("cmd_vel", Twist, queue_size=1)


def stop():
    pub.publish(Twist())
    print("stopping the robot")


rospy.on_shutdown(stop)
rate = rospy.Rate(1000)
forward = Twist()
forward.linear.x = 0.2
while not rospy.is_shutdown():
    pub.publish(forward)
    rate.sleep()
