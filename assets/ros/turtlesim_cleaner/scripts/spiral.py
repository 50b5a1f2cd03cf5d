#!/usr/bin/env python3
"""Drives the turtle in a spiral: it turns at one speed and goes ahead faster and faster, until it is near a wall."""

import rospy
from geometry_msgs.msg import Twist
from turtlesim.msg import Pose

RATE = 20  # [Hz]
TURN = 4.0  # [rad/s]
FASTER = 0.6  # [m/s2]
LOW, HIGH = 0.5, 10.5  # where it stops [m]

pose = None


def on_pose(message):
    global pose
    pose = message


def main():
    """Wait for the turtle, and drive."""
    rospy.init_node("robot_cleaner", anonymous=True)
    publisher = rospy.Publisher("/turtle1/cmd_vel", Twist, queue_size=10)
    rospy.Subscriber("/turtle1/pose", Pose, on_pose)
    rate = rospy.Rate(RATE)
    while pose is None or publisher.get_num_connections() == 0:
        rospy.loginfo_once("waiting for turtlesim: rosrun turtlesim turtlesim_node")
        rate.sleep()

    velocity = Twist()
    velocity.angular.z = TURN
    while LOW < pose.x < HIGH and LOW < pose.y < HIGH:
        velocity.linear.x += FASTER / RATE
        publisher.publish(velocity)
        rate.sleep()
    publisher.publish(Twist())
    rospy.loginfo("near a wall, at (%.2f, %.2f)", pose.x, pose.y)


if __name__ == "__main__":
    try:
        main()
    except rospy.ROSInterruptException:
        pass
