"""Feeds transforms to the real ``tf2_py.BufferCore`` and asks it; writes the answers as JSON.

Reads what to do from standard input.
"""

import json
import sys

import rospy
import tf2_py
from geometry_msgs.msg import TransformStamped


def main():
    task = json.load(sys.stdin)
    buffer = tf2_py.BufferCore(rospy.Duration(task["cache"]))
    for parent, child, numbers, stamp, static in task["told"]:
        message = TransformStamped()
        message.header.frame_id, message.child_frame_id = parent, child
        message.header.stamp = rospy.Time(*divmod(stamp, 1000000000))
        move, turn = message.transform.translation, message.transform.rotation
        move.x, move.y, move.z, turn.x, turn.y, turn.z, turn.w = numbers
        (buffer.set_transform_static if static else buffer.set_transform)(message, "peer")
    answers = []
    for target, target_ns, source, source_ns, fixed in task["asked"]:
        target_time = rospy.Time(*divmod(target_ns, 1000000000))
        try:
            if fixed:
                source_time = rospy.Time(*divmod(source_ns, 1000000000))
                found = buffer.lookup_transform_full_core(target, target_time, source, source_time, fixed)
            else:
                found = buffer.lookup_transform_core(target, source, target_time)
            move, turn = found.transform.translation, found.transform.rotation
            numbers = [move.x, move.y, move.z, turn.x, turn.y, turn.z, turn.w]
            answers.append([numbers, found.header.stamp.to_nsec()])
        except tf2_py.TransformException as error:
            answers.append([type(error).__name__, 0])
    latest = []
    for target, source in task["latest"]:
        try:
            latest.append(buffer.get_latest_common_time(target, source).to_nsec())
        except tf2_py.TransformException as error:
            latest.append(type(error).__name__)
    json.dump({"answers": answers, "latest": latest}, sys.stdout)


main()
