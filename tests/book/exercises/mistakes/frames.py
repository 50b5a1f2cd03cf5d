"""Wrong answers to the exercises of the chapter Frames: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.book.checks import Script

from .published import solution

if TYPE_CHECKING:
    from collections.abc import Callable

CARROT = solution("frames", "carrot")

MOUNT = solution("frames", "upside_down")

LOCALISE = """
import rospy
import tf2_ros
from geometry_msgs.msg import PoseStamped, TransformStamped
from nav_msgs.msg import Odometry
from tf2_geometry_msgs import do_transform_pose

def on_truth(truth):
    try:
        found = buffer.lookup_transform("base_footprint", "odom", truth.header.stamp, rospy.Duration(0.1))
    except tf2_ros.TransformException:
        return
    odom = PoseStamped()
    odom.pose.position = found.transform.translation
    odom.pose.orientation = found.transform.rotation
    base = TransformStamped()
    base.transform.translation = truth.pose.pose.position
    base.transform.rotation = truth.pose.pose.orientation
    odom = do_transform_pose(odom, base)
    result = TransformStamped()
    result.header.stamp = truth.header.stamp
    result.header.frame_id = "map"
    result.child_frame_id = "odom"
    result.transform.translation = odom.pose.position
    result.transform.rotation = odom.pose.orientation
    broadcaster.sendTransform(result)

rospy.init_node("localise")
buffer = tf2_ros.Buffer()
listener = tf2_ros.TransformListener(buffer)
broadcaster = tf2_ros.TransformBroadcaster()
rospy.Subscriber("base_pose_ground_truth", Odometry, on_truth)
rospy.spin()
"""


def wrong(name: str, right: str, old: str, new: str) -> Callable[[], Script]:
    """Return what makes a script with one place of it changed."""
    assert old in right
    return lambda: Script(name, right.replace(old, new))


MISTAKES = {
    "carrot": [
        wrong("carrot.py", CARROT, '"base_footprint"', '"odom"'),
        wrong("carrot.py", CARROT, '"carrot"\n    pose.t', '"carot"\n    pose.t'),
        wrong("carrot.py", CARROT, "    pose.header.stamp = now\n", ""),
        wrong("carrot.py", CARROT, "    pose.transform.rotation.w = 1.0\n", ""),
        wrong("carrot.py", CARROT, "math.sin", "math.cos"),
        wrong("carrot.py", CARROT, "translation.x = 0.5", "translation.x = 5"),
        wrong("carrot.py", CARROT, "swing)", "swing, oneshot=True)"),
    ],
    "upside_down": [
        wrong("mount.py", MOUNT, "(math.pi, 0, 0)", "(0, math.pi, 0)"),
        wrong("mount.py", MOUNT, "(math.pi, 0, 0)", "(0, 0, 0)"),
        wrong("mount.py", MOUNT, "(math.pi, 0, 0)", "(180, 0, 0)"),
        wrong("mount.py", MOUNT, "translation.z = 0.3", "translation.y = 0.3"),
        wrong("mount.py", MOUNT, '"flipped"', '"laser"'),
        wrong("mount.py", MOUNT, '"base_link"', '"base_footprint"'),
        wrong("mount.py", MOUNT, "StaticTransformBroadcaster", "TransformBroadcaster"),
        wrong("mount.py", MOUNT, "rospy.spin()", "broadcaster.send(pose)"),
    ],
    "localise": [
        wrong("localise.py", LOCALISE, "truth.header.stamp, rospy.Duration(0.1)", "rospy.Time(0)"),
        wrong("localise.py", LOCALISE, '"base_footprint", "odom"', '"odom", "base_footprint"'),
        wrong("localise.py", LOCALISE, "    result.header.stamp = truth.header.stamp\n", ""),
        wrong("localise.py", LOCALISE, '"map"', '"odom"'),
        wrong("localise.py", LOCALISE, "    odom = do_transform_pose(odom, base)\n", ""),
        wrong("localise.py", LOCALISE, "    broadcaster.sendTransform(result)\n", ""),
    ],
}
