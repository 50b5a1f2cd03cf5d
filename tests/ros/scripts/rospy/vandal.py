#!/usr/bin/env python
# Writes into what it receives: nobody else may see that.
import sys

import rospy
from sensor_msgs.msg import LaserScan


def scan(msg):
    seen = list(msg.ranges[:3]), msg.header.frame_id
    msg.header.frame_id = "broken"
    msg.ranges = [0.0] * len(msg.ranges)
    msg.angle_min = 99.0
    print(*seen)
    rospy.signal_shutdown("")


rospy.init_node(sys.argv[1])
rospy.Subscriber("scan", LaserScan, scan)
rospy.spin()
