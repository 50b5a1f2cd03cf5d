#!/usr/bin/env python3
"""Turns the turtle on the spot: asks how fast, how far and which way, and then does it."""

import math

import rospy
from geometry_msgs.msg import Twist

RATE = 50  # [Hz]


def rotate(speed, angle, clockwise):
    """Turn by ``angle`` [rad] at ``speed`` [rad/s], and stop."""
    publisher = rospy.Publisher("/turtle1/cmd_vel", Twist, queue_size=10)
    rate = rospy.Rate(RATE)
    while publisher.get_num_connections() == 0:  # a message that nobody hears moves no turtle
        rospy.loginfo_once("waiting for turtlesim: rosrun turtlesim turtlesim_node")
        rate.sleep()

    velocity = Twist()
    velocity.angular.z = -speed if clockwise else speed
    start = rospy.Time.now()
    while speed * (rospy.Time.now() - start).to_sec() < angle:
        publisher.publish(velocity)
        rate.sleep()
    publisher.publish(Twist())
    rospy.loginfo("turned by %.0f degrees %s", math.degrees(angle), "clockwise" if clockwise else "to the left")


def main():
    """Ask, and turn."""
    rospy.init_node("robot_cleaner", anonymous=True)
    speed = math.radians(abs(float(input("Speed (degrees a second): "))))
    angle = math.radians(abs(float(input("Angle (degrees): "))))
    clockwise = input("Clockwise (y/n)? ").strip().lower() in ("y", "yes", "true", "1")
    if speed == 0:
        rospy.logerr("at the speed 0 the turtle never arrives")
        return
    rotate(speed, angle, clockwise)


if __name__ == "__main__":
    try:
        main()
    except rospy.ROSInterruptException:
        pass
