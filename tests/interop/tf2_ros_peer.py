"""A script for tf2_ros's registry of types and the buffer of tf2_py.

Run by the real one and by ours.
"""

import json

import rospy
import tf2_py
import tf2_ros
from geometry_msgs.msg import Point, TransformStamped

rospy.init_node("peer")
facts = {}


def told(function, *arguments):
    try:
        return function(*arguments)
    except (tf2_py.TransformException, tf2_ros.TypeException, tf2_ros.NotImplementedException) as error:
        return [type(error).__name__, isinstance(error, tf2_py.TransformException)]


now = rospy.Time(12, 5)

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
