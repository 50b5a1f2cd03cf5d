#!/usr/bin/env python3
"""Brings a camera's and a laser's messages together, as one does with rospy; it plays both itself."""

import message_filters
import rospy
from sensor_msgs.msg import CameraInfo, LaserScan


def together(info, scan):
    gap = abs((info.header.stamp - scan.header.stamp).to_sec())
    print("together", info.header.frame_id, scan.header.frame_id, "close" if gap < 0.05 else "apart")


rospy.init_node("fuse")
info_sub = message_filters.Subscriber("camera_info", CameraInfo)
scan_sub = message_filters.Subscriber("scan", LaserScan)
cache = message_filters.Cache(scan_sub, 100)
synchronizer = message_filters.ApproximateTimeSynchronizer([info_sub, scan_sub], 10, 0.05)
synchronizer.registerCallback(together)

info_pub = rospy.Publisher("camera_info", CameraInfo, queue_size=10)
scan_pub = rospy.Publisher("scan", LaserScan, queue_size=10)
while not (info_pub.get_num_connections() and scan_pub.get_num_connections()):
    rospy.sleep(0.01)
start = rospy.Time.now()
for number in range(6):
    for publisher, message, delay, every in (
        (info_pub, CameraInfo(), 0.0, 1),
        (scan_pub, LaserScan(), 0.01, 2),
    ):
        if number % every == 0:
            message.header.stamp = start + rospy.Duration(0.1 * number + delay)
            message.header.frame_id = str(number)
            publisher.publish(message)
    rospy.sleep(0.1)
rospy.sleep(0.3)
print("cached", len(cache.getInterval(start, rospy.Time.now())), cache.getLast().header.frame_id)
