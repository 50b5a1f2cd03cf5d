"""A script for tf2_ros's client of buffers and its registry of types; it plays the server itself.

Run by the real one and by ours.
"""

import json

import actionlib
import rospy
import tf2_py
import tf2_ros
from geometry_msgs.msg import Point, TransformStamped
from tf2_msgs.msg import LookupTransformAction, LookupTransformResult, TF2Error

rospy.init_node("peer")
facts = {}
asked = []


def answer(goal):
    """The frame's name says what to answer."""
    asked.append(
        [
            goal.target_frame, goal.source_frame, goal.source_time.to_nsec(), goal.timeout.to_nsec(),
            goal.target_time.to_nsec(), goal.fixed_frame, goal.advanced,
        ]
    )  # fmt: skip
    if goal.target_frame == "abort":
        server.set_aborted(LookupTransformResult())
        return
    if goal.target_frame == "sleep":
        while not server.is_preempt_requested():
            rospy.sleep(0.01)
        server.set_preempted()
        return
    result = LookupTransformResult()
    result.transform.child_frame_id = goal.source_frame
    result.error = TF2Error(int(goal.target_frame), "no. " + goal.target_frame)
    server.set_succeeded(result)


server = actionlib.SimpleActionServer("buffer", LookupTransformAction, answer, auto_start=False)
client = tf2_ros.BufferClient("buffer", timeout_padding=rospy.Duration(0.5))
facts["early"] = client.wait_for_server(rospy.Duration(0.05))
server.start()
facts["ready"] = client.wait_for_server(rospy.Duration(20))


def told(function, *arguments):
    try:
        return function(*arguments)
    except (tf2_py.TransformException, tf2_ros.TypeException, tf2_ros.NotImplementedException) as error:
        text = str(error) if str(error).startswith("no. ") else ""
        return [type(error).__name__, text, isinstance(error, tf2_py.TransformException)]


now, long = rospy.Time(12, 5), rospy.Duration(0.25)
for _ in range(100):  # a real server's result is lost while it does not count its client yet
    if isinstance(told(client.lookup_transform, "0", "base", now, long), TransformStamped):
        break
asked.clear()
facts["simple"], facts["full"] = {}, {}
for name in ("0", "1", "2", "3", "4", "5", "6", "9", "abort", "sleep"):
    found = told(client.lookup_transform, name, "base", now, long)
    facts["simple"][name] = [
        found.child_frame_id if isinstance(found, TransformStamped) else found,
        name == "sleep" or client.can_transform(name, "base", now),
    ]
    if name == "sleep":
        client.client.cancel_all_goals()
        rospy.sleep(0.1)
        continue
    found = told(client.lookup_transform_full, name, now, "base", rospy.Time(3), "map", long)
    facts["full"][name] = [
        found.child_frame_id if isinstance(found, TransformStamped) else found,
        client.can_transform_full(name, now, "base", rospy.Time(3), "map"),
    ]
facts["asked"] = asked

# ---- things of the script's own, moved and converted ----


class Thing:
    """A number somewhere."""

    def __init__(self, number):
        self.number = number


class Other:
    """Another one."""

    def __init__(self, number):
        self.number = number


NONE = rospy.Duration(0)


class Odd(tf2_ros.BufferInterface):
    """Looks nowhere, and finds something."""

    def lookup_transform(self, target, source, time, timeout=NONE):
        return [target, source, time.to_sec(), timeout.to_sec()]


thing = tf2_ros.Stamped(Thing(7), rospy.Time(4), "here")
odd, bare = Odd(), tf2_ros.BufferInterface()
kinds = tf2_ros.ConvertRegistration()
facts["types"] = [
    told(odd.transform, thing, "there"), told(bare.lookup_transform, "a", "b", now),
    told(bare.can_transform, "a", "b", now), told(bare.can_transform_full, "a", now, "b", now, "c"),
    told(kinds.get_to_msg, Thing), told(kinds.get_from_msg, Thing), told(kinds.get_convert, (Thing, Other)),
    told(tf2_ros.convert, thing, Other), [thing.header.frame_id, thing.header.stamp.to_sec()],
]  # fmt: skip
odd.registration.add(Thing, lambda one, transform: [one.number, transform])
facts["moved"] = [
    odd.transform(thing, "there"),
    odd.transform(thing, "there", rospy.Duration(2)),
    told(odd.transform_full, thing, "there", now, "map"),
]
tf2_ros.TransformRegistration().add(Thing, lambda one, transform: Thing(one.number + 1))
kinds.add_to_msg(Thing, lambda one: Point(x=one.number))
kinds.add_from_msg(Other, lambda point: Other(point.x))
copied = tf2_ros.convert(thing, Thing)
facts["converted"] = [
    tf2_ros.convert(thing, Other).number,
    copied.number,
    copied is thing,
    odd.transform(thing, "there", new_type=Other).number,
]
kinds.add_convert((Thing, Other), lambda one: Other("at once"))
facts["converted"].append(tf2_ros.convert(thing, Other).number)

# ---- the buffer without a node ----

core = tf2_py.BufferCore(rospy.Duration(5))
for parent, child, stamp in (("map", "odom", 3), ("odom", "base", 5), ("other", "left", 2)):
    one = TransformStamped(child_frame_id=child)
    one.header.frame_id, one.header.stamp = parent, rospy.Time(stamp)
    one.transform.rotation.w = 1
    core.set_transform(one, "peer")
facts["core"] = [
    sorted(core._getFrameStrings()),
    core._frameExists("base"),
    core._frameExists("nobody"),
    core.get_latest_common_time("map", "base").to_sec(),
    told(core.get_latest_common_time, "map", "nobody"),
    core.can_transform_core("map", "base", rospy.Time())[0],
]
print(json.dumps(facts))
rospy.signal_shutdown("done")
