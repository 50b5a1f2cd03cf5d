#!/usr/bin/env python3
"""Drives the turtle to a goal: a proportional controller that looks at the pose ten times a second."""

import math

import rospy
from geometry_msgs.msg import Twist
from turtlesim.msg import Pose

RATE = 10  # [Hz]
LINEAR, ANGULAR = 1.5, 6.0  # how much speed [1/s] for a distance, and for an angle


class Turtle:
    """A turtle that knows where it is."""

    def __init__(self):
        self.pose = None
        self.publisher = rospy.Publisher("/turtle1/cmd_vel", Twist, queue_size=10)
        rospy.Subscriber("/turtle1/pose", Pose, self.on_pose)
        self.rate = rospy.Rate(RATE)

    def on_pose(self, pose):
        self.pose = pose

    def go_to(self, x, y, tolerance):
        """Drive until the goal is nearer than ``tolerance``, and stop."""
        while self.pose is None:
            rospy.loginfo_once("waiting for turtlesim: rosrun turtlesim turtlesim_node")
            self.rate.sleep()
        while math.hypot(x - self.pose.x, y - self.pose.y) >= tolerance:
            dx, dy = x - self.pose.x, y - self.pose.y
            error = math.remainder(math.atan2(dy, dx) - self.pose.theta, 2 * math.pi)
            velocity = Twist()
            velocity.linear.x = LINEAR * math.hypot(dx, dy) * max(0.0, math.cos(error))
            velocity.angular.z = ANGULAR * error
            self.publisher.publish(velocity)
            self.rate.sleep()
        self.publisher.publish(Twist())
        rospy.loginfo("at (%.2f, %.2f)", self.pose.x, self.pose.y)


def main():
    """Ask for a goal, and drive there."""
    rospy.init_node("turtlebot_controller", anonymous=True)
    x = float(input("Goal, x: "))
    y = float(input("Goal, y: "))
    tolerance = float(input("Tolerance: "))
    if not (0 <= x <= 11 and 0 <= y <= 11 and tolerance > 0):
        rospy.logerr("the window is 11 by 11 metres, and a tolerance is larger than 0")
        return
    Turtle().go_to(x, y, tolerance)


if __name__ == "__main__":
    try:
        main()
    except rospy.ROSInterruptException:
        pass
