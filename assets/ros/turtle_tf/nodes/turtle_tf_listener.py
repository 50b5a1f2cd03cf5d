#!/usr/bin/env python3
"""Spawns turtle2, and drives it to where turtle1 is, as tf says it."""

import math

import rospy
import tf
from geometry_msgs.msg import Twist
from turtlesim.srv import Spawn

rospy.init_node("turtle_tf_listener")
listener = tf.TransformListener()
rospy.wait_for_service("spawn")
rospy.ServiceProxy("spawn", Spawn)(4, 2, 0, "turtle2")
cmd_vel = rospy.Publisher("turtle2/cmd_vel", Twist, queue_size=1)
rate = rospy.Rate(10)
while not rospy.is_shutdown():
    try:
        (x, y, _), _ = listener.lookupTransform("turtle2", "turtle1", rospy.Time(0))
        command = Twist()
        command.linear.x = 0.5 * math.hypot(x, y)
        command.angular.z = 4 * math.atan2(y, x)
        cmd_vel.publish(command)
    except (tf.LookupException, tf.ConnectivityException, tf.ExtrapolationException):
        pass  # not yet
    try:
        rate.sleep()
    except rospy.ROSInterruptException:
        break
