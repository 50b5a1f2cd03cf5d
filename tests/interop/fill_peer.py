"""A script for genpy.message: messages filled from plain values, types checked, hand-written messages.

Run by the real one and by ours.
"""

import io
import json
import struct

import genpy
import genpy.dynamic
import genpy.message
import rospy
from genpy.message import check_type, fill_message_args, get_message_class
from geometry_msgs.msg import Point, Pose, PoseArray, PoseStamped, PoseWithCovariance, Twist
from sensor_msgs.msg import CompressedImage, LaserScan
from std_msgs.msg import Bool, Duration, Empty, Header, String, Time

facts = {}
FILLS = [
    (String, ["text"]), (String, [{"data": "text"}]), (String, [None]), (String, [{"data": None}]), (String, []),
    (String, ["a", "b"]), (String, [{"nothing": 1}]), (String, "x"), (String, "xy"), (String, ("x", "y")),
    (Empty, []), (Empty, None), (Empty, [{}]), (Empty, [1]), (Bool, [2]), (Time, [1500000000]), (Time, [[1, 5]]),
    (Time, [[1]]), (Time, [{"secs": 3}]), (Time, [{"secs": 3, "nsecs": 7}]), (Time, [{"seconds": 3}]),
    (Time, [{"data": {"secs": 3, "nsecs": 7}}]), (Time, [{"data": 2000000001}]), (Time, ["now"]), (Time, ["auto"]),
    (Time, ["later"]), (Time, [1.5]), (Time, [True]), (Time, [None]), (Duration, [-1500000000]),
    (Duration, [{"secs": -3, "nsecs": 7}]), (Header, [3, [4, 5], "odom"]), (Header, [3, "now", "odom"]),
    (Header, [{"stamp": 1000000000, "seq": 2}]), (Header, [{"stamp": None}]), (Twist, [[1, 2, 3], [4, 5, 6]]),
    (Twist, [{"x": 1}, {"z": 2}]), (Twist, [{"linear": [1, 2, 3]}]), (Twist, [{"linear": [1, 2]}]),
    (Twist, [{"linear": {"w": 2}}]), (Twist, [{"linear": 2}]), (Twist, [{"linear": "fast"}]), (Twist, [[1, 2, 3]]),
    (PoseStamped, ["auto", [[1, 2, 3], [0, 0, 0, 1]]]),
    (PoseStamped, [{"header": "auto", "pose": {"position": {"x": 1}}}]),
    (PoseStamped, [{"header": {"stamp": "now", "frame_id": None}}]), (PoseStamped, [{"header": "now"}]),
    (PoseWithCovariance, [{"covariance": [1] * 36}]), (PoseWithCovariance, [{"covariance": [1] * 35}]),
    (PoseWithCovariance, [{"covariance": (1,) * 36}]), (PoseWithCovariance, [{"covariance": 1}]),
    (LaserScan, [{"ranges": [1, 2.5], "intensities": []}]), (LaserScan, [{"ranges": "abc"}]),
    (LaserScan, [{"ranges": {"a": 1}}]), (CompressedImage, [{"data": [1, 2, 3], "format": "png"}]),
    (PoseArray, [{"poses": [{"position": {"x": 1}}, {}]}]), (PoseArray, [{"poses": [[[1, 2, 3], [0, 0, 0, 1]]]}]),
    (PoseArray, ["auto", [[[1, 2, 3], {"w": 1}]]]), (PoseArray, [{"poses": [1]}]),
    (PoseArray, [{"poses": ["auto"]}]), (PoseArray, [{"poses": None}]),
]  # fmt: skip


def told(function, *arguments):
    try:
        return function(*arguments)
    except Exception as error:
        kinds = (genpy.MessageException, ValueError)
        return [kind.__name__ for kind in kinds if isinstance(error, kind)] or type(error).__name__


for number, (cls, values) in enumerate(FILLS):
    keys = {"now": rospy.Time(7, 8), "auto": Header(stamp=rospy.Time(9))}
    message = cls()
    error = told(fill_message_args, message, values, keys)
    facts[f"{number} {cls.__name__} {values!r}"] = error or str(message)
plain = String()
fill_message_args(plain, ["no keys"])
facts["no keys"] = [plain.data, told(fill_message_args, Header(), [1, "now", "x"])]
twice = Header(1, genpy.Time(2, 3), "x")
fill_message_args(twice, [{"stamp": {"secs": 9}}])
facts["the rest stays"] = str(twice)

CHECKS = [
    ("int8", 127), ("int8", 128), ("int8", -129), ("uint8", -1), ("uint8", 255), ("uint8", 256), ("int32", 1.0),
    ("int64", 2**63),
    ("float32", 1), ("float64", "1"), ("bool", True), ("bool", 2), ("string", "x"), ("string", 1),
    ("time", rospy.Time(1)),
    ("time", 1), ("duration", rospy.Duration(-1)), ("duration", None), ("uint8[]", b"abc"), ("uint8[]", [1, 256]),
    ("int32[]", "abc"),
    ("int32[]", [1, 2]), ("int32[]", [1, "2"]), ("float64[2]", [1, 2]), ("string[]", ["a", 1]), ("string[]", "abc"),
    ("int32[]", 5),
    ("geometry_msgs/Twist", Twist()), ("geometry_msgs/Twist", 1), ("geometry_msgs/Twist[]", [Twist()]),
    ("geometry_msgs/Twist[]", [1]),
    ("std_msgs/Header", Header()), ("std_msgs/String", Twist()),
]  # fmt: skip
facts["checks"] = [[f"{one[0]} {one[1]!r}", told(check_type, "field", *one)] for one in CHECKS]
facts["classes"] = [
    get_message_class("time") is genpy.Time,
    get_message_class("duration") is genpy.Duration,
    get_message_class("Header") is Header,
    get_message_class("std_msgs/Nothing"),
]
printable = [genpy.message.get_printable_message_args(cls()) for cls in (Twist, PoseStamped, Empty)]
facts["printable"] = printable


# ---- classes from a text ----

made = genpy.dynamic.generate_dynamic("geometry_msgs/PoseStamped", PoseStamped._full_text)
pose = made["geometry_msgs/PoseStamped"]()
pose.pose.position.x = 3
made_buffer, plain_buffer = io.BytesIO(), io.BytesIO()
pose.serialize(made_buffer)
PoseStamped(pose=Pose(position=Point(x=3))).serialize(plain_buffer)
other = genpy.dynamic.generate_dynamic(
    "my_msgs/Two", "int32 a\nThing[] b\n" + "=" * 80 + "\nMSG: my_msgs/Thing\nstring c\n"
)
facts["dynamic"] = [
    sorted(made), made_buffer.getvalue() == plain_buffer.getvalue(), pose._md5sum == PoseStamped._md5sum,
    sorted(other), str(other["my_msgs/Two"](1, [other["my_msgs/Thing"]("x")])), isinstance(pose, genpy.Message),
]  # fmt: skip


# ---- a message that somebody has written by hand ----


class Point2(genpy.Message):
    """Two numbers."""

    _type = "hand_made/Point2"
    _md5sum = "0123456789abcdef0123456789abcdef"
    _has_header = False
    _full_text = "float64 x\nint32 y\n"
    __slots__ = ["x", "y", "inner"]  # noqa: RUF023 - the order of the fields
    _slot_types = ["float64", "int32", "std_msgs/String"]

    def __init__(self, *args, **kwds):
        if args or kwds:
            super().__init__(*args, **kwds)
            if self.inner is None:
                self.inner = String("none")
        else:
            self.x, self.y, self.inner = 0.0, 0, String()

    def _get_types(self):
        return self._slot_types

    def serialize(self, buff):
        buff.write(struct.pack("<di", self.x, self.y))

    def deserialize(self, data):
        self.x, self.y = struct.unpack("<di", data)
        return self


class Bare(genpy.Message):
    """What one needs at least."""

    __slots__ = ["a", "b"]
    _slot_types = ["int32", "string"]


one = Point2(1.5, 2, String("in"))
buffer = io.BytesIO()
one.serialize(buffer)
facts["by hand"] = [
    str(one), repr(Point2()), str(Point2(x=3.5)), one == Point2(1.5, 2, String("in")),
    one == Point2(1.5, 3, String("in")), one != Point2(),
    told(Point2, 1), told(lambda: Point2(1, 2, x=3)), told(lambda: Point2(z=3)), isinstance(one, genpy.Message),
    str(Point2().deserialize(struct.pack("<di", 4, 5))), Point2()._get_types(), one.__getstate__()[:2],
    told(one._check_types),
    told(Point2("a", 1, String())._check_types), str(Bare(1, "x")), str(Bare(b="y")), Bare().a, told(lambda: Bare(1)),
    told(lambda: Bare().c), str(genpy.message.strify_message(Bare(2, "z"), indent="  ")),
    genpy.message.get_printable_message_args(one),
]  # fmt: skip
other = Bare()
other.__setstate__([7, "state"])
filled = Point2()
fill_message_args(filled, [{"x": 9, "inner": {"data": "deep"}}])
facts["by hand"] += [str(other), str(filled)]

rospy.init_node("peer")
heard = []
rospy.Subscriber("points", Point2, lambda message: heard.append([message.x, message.y, type(message).__name__]))
publisher = rospy.Publisher("points", Point2, queue_size=5)
while not publisher.get_num_connections():
    rospy.sleep(0.01)
publisher.publish(one)
publisher.publish(2.5, 7, String())
publisher.publish(x=4.5, y=1)
end = rospy.get_rostime() + rospy.Duration(10)
while len(heard) < 3 and rospy.get_rostime() < end:
    rospy.sleep(0.01)
facts["published by hand"] = heard
print(json.dumps(facts))
rospy.signal_shutdown("done")
