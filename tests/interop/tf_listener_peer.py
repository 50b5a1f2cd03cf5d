"""Asks ``tf.TransformerROS`` all that it can be asked without a node; prints the answers as JSON.

Run by real tf and by ours.
"""

import json

import rospy
import tf
from geometry_msgs.msg import PointStamped, PoseStamped, QuaternionStamped, TransformStamped, Vector3Stamped
from sensor_msgs.msg import PointCloud
from std_msgs.msg import Header

TURN = tf.transformations.quaternion_from_euler(0.3, -0.2, 0.9)


def flat(thing):
    """Numbers and texts of what was answered, in order, rounded; messages field by field."""
    if isinstance(thing, bool | str) or thing is None:
        return thing
    if hasattr(thing, "to_sec"):
        return round(thing.to_sec(), 6)
    if hasattr(thing, "__slots__"):
        names = [name for name in thing.__slots__ if name not in ("seq", "_connection_header")]
        return [flat(getattr(thing, name)) for name in names]
    if isinstance(thing, int | float):
        return round(float(thing), 6) + 0.0
    return [flat(each) for each in thing]


def ask(function, *arguments):
    """The answer, or the name of the exception."""
    try:
        return flat(function(*arguments))
    except tf.Exception as error:
        return type(error).__name__


def told(listener):
    """A robot that drives and turns for two seconds, a sensor that is fixed to it, and a far tree."""
    for number in range(21):
        stamp = rospy.Time(10, 0) + rospy.Duration.from_sec(0.1 * number)
        yaw = tf.transformations.quaternion_from_euler(0, 0, 0.05 * number)
        for parent, child, place, turn in (
            ("odom", "base", (0.2 * number, 0.1, 0.0), yaw),
            ("base", "laser", (0.1, 0.0, 0.3), TURN),
            ("far", "away", (1.0, 0.0, 0.0), TURN),
        ):
            message = TransformStamped(header=Header(stamp=stamp, frame_id=parent), child_frame_id=child)
            move = message.transform.translation
            move.x, move.y, move.z = place
            into = message.transform.rotation
            into.x, into.y, into.z, into.w = turn
            listener.setTransform(message, "peer")


def stamped(cls, **fields):
    """A message in the frame of the laser."""
    return cls(header=Header(stamp=rospy.Time(11), frame_id="/laser"), **fields)


def main():
    """Ask."""
    listener = tf.TransformerROS(True, rospy.Duration(20.0))
    told(listener)
    now, then, never = rospy.Time(11), rospy.Time(10, 500000000), rospy.Time(99)
    cloud = stamped(PointCloud)
    point, vector, turn, pose = (stamped(cls) for cls in (PointStamped, Vector3Stamped, QuaternionStamped, PoseStamped))
    point.point.x, vector.vector.y, turn.quaternion.w = 1.0, 2.0, 1.0
    pose.pose.position.z, pose.pose.orientation.x = 3.0, 1.0
    cloud.points = [type(point.point)(1, 2, 3), type(point.point)(4, 5, 6)] if hasattr(cloud, "points") else []
    full = ("base", now, "laser", then, "odom")
    answers = {
        "can": [ask(listener.canTransform, "/odom", "laser", when) for when in (now, then, never, rospy.Time(0))],
        "cannot": ask(listener.canTransform, "odom", "away", now),
        "can full": ask(listener.canTransformFull, *full),
        "cannot full": ask(listener.canTransformFull, "base", never, "laser", then, "odom"),
        "lookup": ask(listener.lookupTransform, "odom", "/laser", now),
        "lookup full": ask(listener.lookupTransformFull, *full),
        "lookup fails": [ask(listener.lookupTransform, "odom", name, never) for name in ("laser", "nobody")],
        "unconnected": ask(listener.lookupTransform, "odom", "away", never),
        "twist": ask(listener.lookupTwist, "base", "odom", now, rospy.Duration.from_sec(0.4)),
        "latest": ask(listener.getLatestCommonTime, "/laser", "odom"),
        "chain": sorted(listener.chain("base", now, "laser", then, "odom")),
        "frames": sorted(listener.getFrameStrings()),
        "exists": [listener.frameExists(name) for name in ("base", "nobody")],
        "as string": len(listener.allFramesAsString()) > 0,
        "as dot": "digraph" in listener.allFramesAsDot(),
        "matrix": ask(listener.asMatrix, "odom", point.header),
        "from": ask(listener.fromTranslationRotation, (1, 2, 3), TURN),
        "point": ask(listener.transformPoint, "odom", point),
        "vector": ask(listener.transformVector3, "odom", vector),
        "quaternion": ask(listener.transformQuaternion, "odom", turn),
        "pose": ask(listener.transformPose, "odom", pose),
        "cloud": ask(listener.transformPointCloud, "odom", cloud),
        "from afar": ask(listener.transformPoint, "far", point),
    }
    listener.clear()
    answers["cleared"] = ask(listener.canTransform, "odom", "laser", now)
    print(json.dumps(answers))


main()
