#!/usr/bin/env python3
"""Drives the turtle along a line: asks how fast, how far and which way, and then does it."""

import rospy
from geometry_msgs.msg import Twist

RATE = 20  # [Hz]


def move(speed, distance, forward):
    """Drive ``distance`` at ``speed``, in the units of turtlesim, and stop."""
    publisher = rospy.Publisher("/turtle1/cmd_vel", Twist, queue_size=10)
    rate = rospy.Rate(RATE)
    while publisher.get_num_connections() == 0:  # a message that nobody hears moves no turtle
        rospy.loginfo_once("waiting for turtlesim: rosrun turtlesim turtlesim_node")
        rate.sleep()

    velocity = Twist()
    velocity.linear.x = speed if forward else -speed
    start = rospy.Time.now()
    while speed * (rospy.Time.now() - start).to_sec() < distance:
        publisher.publish(velocity)
        rate.sleep()
    publisher.publish(Twist())
    rospy.loginfo("moved %.2f %s", distance, "forward" if forward else "backward")


def main():
    """Ask, and move."""
    rospy.init_node("robot_cleaner", anonymous=True)
    speed = abs(float(input("Speed: ")))
    distance = abs(float(input("Distance: ")))
    forward = input("Forward (y/n)? ").strip().lower() in ("y", "yes", "true", "1")
    if speed == 0:
        rospy.logerr("at the speed 0 the turtle never arrives")
        return
    move(speed, distance, forward)


if __name__ == "__main__":
    try:
        main()
    except rospy.ROSInterruptException:
        pass
