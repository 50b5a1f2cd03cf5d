"""Runs under the system's Python: publishes joint states, prints what the real robot_state_publisher tells of them."""

import json
import sys
import time

import rospy
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

heard = {}


def hear(message, static):
    for each in message.transforms:
        move, turn = each.transform.translation, each.transform.rotation
        heard[each.child_frame_id] = [
            each.header.frame_id,
            static,
            [move.x, move.y, move.z, turn.x, turn.y, turn.z, turn.w],
        ]


joints, wanted = json.loads(sys.argv[1]), set(json.loads(sys.argv[2]))
rospy.init_node("peer", disable_signals=True)
rospy.Subscriber("/tf", TFMessage, hear, False)
rospy.Subscriber("/tf_static", TFMessage, hear, True)
publisher = rospy.Publisher("joint_states", JointState, queue_size=1)
end = time.time() + 200
while time.time() < end and not wanted <= set(heard):
    message = JointState(name=list(joints), position=list(joints.values()))
    message.header.stamp = rospy.Time.now()
    publisher.publish(message)
    time.sleep(0.05)
print(json.dumps(heard))
