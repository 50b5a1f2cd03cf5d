#!/usr/bin/env python
# Drives for a given distance by polling the clock, without a sleep anywhere.
import rospy
from geometry_msgs.msg import Twist

SPEED, DISTANCE = 0.5, 0.01


def move():
    rospy.init_node("straight_line", anonymous=True)
    velocity = rospy.Publisher("/cmd_vel", Twist, queue_size=10)
    msg = Twist()
    msg.linear.x = SPEED
    while velocity.get_num_connections() == 0:
        pass
    start = rospy.Time.now().to_sec()
    driven = 0
    turns = 0
    while driven < DISTANCE:
        velocity.publish(msg)
        now = rospy.Time.now().to_sec()
        driven = SPEED * (now - start)
        turns += 1
    msg.linear.x = 0
    velocity.publish(msg)
    print("arrived", turns > 1)


move()
