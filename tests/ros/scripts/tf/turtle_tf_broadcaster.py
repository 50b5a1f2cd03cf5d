#!/usr/bin/env python
import math

import rospy
import tf


if __name__ == '__main__':
    rospy.init_node('circle_broadcaster')
    br = tf.TransformBroadcaster()
    rate = rospy.Rate(50.0)
    while not rospy.is_shutdown():
        t = rospy.Time.now()
        angle = math.pi / 2
        br.sendTransform((2.0, 1.0, 0.0),
                         tf.transformations.quaternion_from_euler(0, 0, angle),
                         t,
                         "turtle1",
                         "world")
        br.sendTransform((0.0, 0.5, 0.0), (0.0, 0.0, 0.0, 1.0), rospy.Time.now(), "carrot1", "turtle1")
        rate.sleep()
