#!/usr/bin/env python
import math

import rospy
import tf
import geometry_msgs.msg
from tf.transformations import euler_from_quaternion

if __name__ == '__main__':
    rospy.init_node('turtle_tf_listener')
    listener = tf.TransformListener()
    try:
        listener.lookupTransform('/world', '/turtle1', rospy.Time(0))
    except (tf.LookupException, tf.ConnectivityException, tf.ExtrapolationException) as e:
        print("not yet: %s" % type(e).__name__)
    listener.waitForTransform("/world", "/carrot1", rospy.Time(0), rospy.Duration(100.0))
    rate = rospy.Rate(10.0)
    while not rospy.is_shutdown():
        try:
            (trans, rot) = listener.lookupTransform('/world', '/carrot1', rospy.Time(0))
        except (tf.LookupException, tf.ConnectivityException, tf.ExtrapolationException):
            rate.sleep()
            continue
        break
    print("carrot at %.2f %.2f yaw %.1f" % (trans[0], trans[1], math.degrees(euler_from_quaternion(rot)[2])))

    p = geometry_msgs.msg.PointStamped()
    p.header.frame_id = "turtle1"
    p.point.x = 1.0
    q = listener.transformPoint("world", p)
    print("point at %.2f %.2f in %s" % (q.point.x, q.point.y, q.header.frame_id))

    now = rospy.Time.now()
    listener.waitForTransform("world", "turtle1", now, rospy.Duration(100.0))
    print("waited for now: %s" % listener.canTransform("world", "turtle1", now))
    try:
        listener.waitForTransform("world", "nobody", rospy.Time(), rospy.Duration(0.1))
    except tf.Exception as e:
        print(str(e).split('.')[0])
    listener.lookupTransform
    linear, angular = listener.lookupTwist("turtle1", "world", rospy.Time(0), rospy.Duration(0.04))
    print("stands still: %s" % (max(map(abs, list(linear) + list(angular))) < 1e-9))
    rospy.signal_shutdown("done")
