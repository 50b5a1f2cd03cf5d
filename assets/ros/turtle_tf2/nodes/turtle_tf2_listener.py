#!/usr/bin/env python3
"""Spawns a turtle (parameter turtle, by default turtle2), and drives it to where turtle1 is, as tf2 says it."""

import math

import rospy
import tf2_ros
from geometry_msgs.msg import Twist
from turtlesim.srv import Spawn

rospy.init_node("tf2_turtle_listener")
buffer = tf2_ros.Buffer()
listener = tf2_ros.TransformListener(buffer)
name = rospy.get_param("turtle", "turtle2")
rospy.wait_for_service("spawn")
rospy.ServiceProxy("spawn", Spawn)(4, 2, 0, name)
cmd_vel = rospy.Publisher("%s/cmd_vel" % name, Twist, queue_size=1)
rate = rospy.Rate(10)
while not rospy.is_shutdown():
    try:
        to = buffer.lookup_transform(name, "turtle1", rospy.Time()).transform.translation
        command = Twist()
        command.linear.x = 0.5 * math.hypot(to.x, to.y)
        command.angular.z = 4 * math.atan2(to.y, to.x)
        cmd_vel.publish(command)
    except (tf2_ros.LookupException, tf2_ros.ConnectivityException, tf2_ros.ExtrapolationException):
        pass  # not yet
    try:
        rate.sleep()
    except rospy.ROSInterruptException:
        break
