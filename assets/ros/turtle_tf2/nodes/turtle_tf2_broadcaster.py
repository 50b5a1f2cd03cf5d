#!/usr/bin/env python3
"""Tells tf2 where a turtle is: a frame with its name in the frame world. Which turtle, says the parameter ~turtle."""

import rospy
import tf2_ros
from geometry_msgs.msg import TransformStamped
from tf.transformations import quaternion_from_euler
from turtlesim.msg import Pose


def tell(pose, name):
    transform = TransformStamped()
    transform.header.stamp = rospy.Time.now()
    transform.header.frame_id = "world"
    transform.child_frame_id = name
    transform.transform.translation.x = pose.x
    transform.transform.translation.y = pose.y
    turn = transform.transform.rotation
    turn.x, turn.y, turn.z, turn.w = quaternion_from_euler(0, 0, pose.theta)
    broadcaster.sendTransform(transform)


rospy.init_node("tf2_turtle_broadcaster")
broadcaster = tf2_ros.TransformBroadcaster()
turtle = rospy.get_param("~turtle")
rospy.Subscriber("/%s/pose" % turtle, Pose, tell, turtle)
rospy.spin()
