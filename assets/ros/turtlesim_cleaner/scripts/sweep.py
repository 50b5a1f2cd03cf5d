#!/usr/bin/env python3
"""Sweeps the whole window: up and down in lanes, from the left to the right, with feedback from the pose."""

import math

import rospy
from geometry_msgs.msg import Twist
from turtlesim.msg import Pose
from turtlesim.srv import SetPen, TeleportAbsolute

RATE = 20  # [Hz]
LANE = 1.0  # from lane to lane [m]
LOW, HIGH = 1.0, 10.0  # where lanes begin and end [m]
SPEED, TURN, NEAR = 3.0, 6.0, 0.05


class Sweeper:
    """Goes from corner to corner of its lanes."""

    def __init__(self):
        self.pose = None
        self.publisher = rospy.Publisher("/turtle1/cmd_vel", Twist, queue_size=1)
        rospy.Subscriber("/turtle1/pose", Pose, self.on_pose)
        self.rate = rospy.Rate(RATE)

    def on_pose(self, pose):
        self.pose = pose

    def send(self, linear, angular):
        velocity = Twist()
        velocity.linear.x, velocity.angular.z = linear, angular
        self.publisher.publish(velocity)
        self.rate.sleep()

    def error(self, x, y):
        """The angle from where the turtle looks to a point."""
        to = math.atan2(y - self.pose.y, x - self.pose.x)
        return math.remainder(to - self.pose.theta, 2 * math.pi)

    def go_to(self, x, y):
        """Look there, then drive there."""
        while abs(self.error(x, y)) > 0.02:
            self.send(0.0, TURN * self.error(x, y))
        left = math.hypot(x - self.pose.x, y - self.pose.y)
        while left > NEAR:
            self.send(min(SPEED, 4.0 * left), TURN * self.error(x, y))
            left = math.hypot(x - self.pose.x, y - self.pose.y)
        self.send(0.0, 0.0)

    def sweep(self):
        """Drive along all lanes."""
        while self.pose is None or self.publisher.get_num_connections() == 0:
            rospy.loginfo_once("waiting for turtlesim: rosrun turtlesim turtlesim_node")
            self.rate.sleep()
        pen = rospy.ServiceProxy("/turtle1/set_pen", SetPen)
        pen(0, 0, 0, 0, 1)  # the way to the first lane is not drawn
        rospy.ServiceProxy("/turtle1/teleport_absolute", TeleportAbsolute)(LOW, LOW, math.pi / 2)
        pen(255, 255, 255, 8, 0)
        lanes = int((HIGH - LOW) / LANE) + 1
        self.rate.sleep()
        for lane in range(lanes):
            x, end = LOW + lane * LANE, HIGH if lane % 2 == 0 else LOW
            if lane:
                self.go_to(x, LOW + HIGH - end)
            self.go_to(x, end)
        rospy.loginfo("swept %d lanes", lanes)


if __name__ == "__main__":
    rospy.init_node("robot_cleaner", anonymous=True)
    try:
        Sweeper().sweep()
    except rospy.ROSInterruptException:
        pass
