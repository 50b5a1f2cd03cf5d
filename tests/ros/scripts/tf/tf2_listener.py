#!/usr/bin/env python
import rospy
import tf2_ros
import tf2_geometry_msgs
from geometry_msgs.msg import PoseStamped, TransformStamped

if __name__ == '__main__':
    rospy.init_node('tf2_listener')

    tfBuffer = tf2_ros.Buffer(rospy.Duration(5.0))
    listener = tf2_ros.TransformListener(tfBuffer)

    broadcaster = tf2_ros.StaticTransformBroadcaster()
    static = TransformStamped()
    static.header.stamp = rospy.Time.now()
    static.header.frame_id = "carrot1"
    static.child_frame_id = "tip"
    static.transform.translation.x = 0.25
    static.transform.rotation.w = 1
    broadcaster.sendTransform(static)

    try:
        trans = tfBuffer.lookup_transform("world", "tip", rospy.Time(), rospy.Duration(100.0))
    except (tf2_ros.LookupException, tf2_ros.ConnectivityException, tf2_ros.ExtrapolationException) as e:
        print("failed: %s" % e)
        raise
    print("tip at %.2f %.2f" % (trans.transform.translation.x, trans.transform.translation.y))
    pose = PoseStamped()
    pose.header.frame_id = "tip"
    pose.pose.orientation.w = 1
    pose.pose.position.x = 1
    moved = tf2_geometry_msgs.do_transform_pose(pose, trans)
    print("pose at %.2f %.2f" % (moved.pose.position.x, moved.pose.position.y))
    moved = tfBuffer.transform(pose, "world", rospy.Duration(100.0))
    print("again at %.2f %.2f in %s" % (moved.pose.position.x, moved.pose.position.y, moved.header.frame_id))
    print(tfBuffer.can_transform("world", "nobody", rospy.Time(), rospy.Duration(0.05)))
    try:
        tfBuffer.lookup_transform("world", "turtle1", rospy.Time.now() + rospy.Duration(100))
    except tf2_ros.ExtrapolationException as e:
        print("extrapolation" in str(e))
    rospy.signal_shutdown("done")
