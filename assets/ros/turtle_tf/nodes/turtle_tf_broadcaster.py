#!/usr/bin/env python3
"""Tells tf where a turtle is: a frame with its name in the frame world. Which turtle, says the parameter ~turtle."""

import rospy
import tf
from turtlesim.msg import Pose


def tell(pose, name):
    turn = tf.transformations.quaternion_from_euler(0, 0, pose.theta)
    broadcaster.sendTransform((pose.x, pose.y, 0), turn, rospy.Time.now(), name, "world")


rospy.init_node("turtle_tf_broadcaster")
broadcaster = tf.TransformBroadcaster()
turtle = rospy.get_param("~turtle")
rospy.Subscriber("/%s/pose" % turtle, Pose, tell, turtle)
rospy.spin()
