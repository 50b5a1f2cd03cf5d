#!/usr/bin/env python3
"""Drive a square of half a metre by time alone, publishing on cmd_vel."""

import math

import rospy
from geometry_msgs.msg import Twist

SPEED, TURN_RATE, SIDE = 0.2, 0.5, 0.5  # m/s, rad/s, m


def drive(linear, angular, seconds):
    """Publish a command ten times a second for some seconds."""
    command = Twist()
    command.linear.x, command.angular.z = linear, angular
    rate = rospy.Rate(10)
    for _ in range(round(10 * seconds)):
        commands.publish(command)
        rate.sleep()


rospy.init_node("square")
commands = rospy.Publisher("cmd_vel", Twist, queue_size=1)
while commands.get_num_connections() < 1 and not rospy.is_shutdown():
    rospy.sleep(0.1)
for side in range(1, 5):
    drive(SPEED, 0.0, SIDE / SPEED)
    drive(0.0, TURN_RATE, math.pi / 2 / TURN_RATE)
    rospy.loginfo("side %d of 4", side)
commands.publish(Twist())
rospy.sleep(0.2)
