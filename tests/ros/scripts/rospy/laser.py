#!/usr/bin/env python
import rospy
from sensor_msgs.msg import LaserScan

rospy.init_node("laser")
pub = rospy.Publisher("scan", LaserScan, queue_size=1)
rate = rospy.Rate(200)
while pub.get_num_connections() < 2:
    rate.sleep()
msg = LaserScan()
msg.header.frame_id = "base_scan"
msg.ranges = [1.0, 2.0, 3.5]
pub.publish(msg)
msg.ranges[0] = 7.0
rate.sleep()
print(msg.ranges, msg.header.frame_id, msg.angle_min)
