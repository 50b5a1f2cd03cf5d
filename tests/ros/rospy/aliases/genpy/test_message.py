"""Messages filled from plain values, and message classes written by hand."""

from __future__ import annotations

import copy
import pickle
import struct

import pytest

from rosmini.core.errors import MessageException, SerializationError
from rosmini.core.graph import Graph
from rosmini.msgs.geometry_msgs.msg import PoseWithCovariance
from rosmini.msgs.std_msgs.msg import Header
from rosmini.ros.rospy.aliases import genpy
from rosmini.ros.rospy.aliases.genpy.message import check_type, fill_message_args


@pytest.mark.parametrize(
    ("message", "values", "error", "text"),
    [
        (Header(), [{"stam": 1}], MessageException, r"No field name \[stam\].* seq, stamp, frame_id"),
        (Header(), [1, 2], MessageException, "Not enough arguments for a std_msgs/Header: it has 3 fields"),
        (Header(), [{"stamp": "now"}], MessageException, r"No key named \[now\] for field stamp"),
        (Header(), [{"stamp": 1.5}], ValueError, "field stamp, a Time: give a list"),
        (Header(), "xy", ValueError, "a list of its fields"),
        (PoseWithCovariance(), [{"covariance": [0] * 35}], MessageException, "35 != 36"),
        (PoseWithCovariance(), [{"pose": {"position": [1]}}], MessageException,
         r"field pose.position, a geometry_msgs/Point"),
    ],
)  # fmt: skip
def test_what_does_not_fit(message, values, error, text):
    with pytest.raises(error, match=text):
        fill_message_args(message, values)


def test_types_are_checked_with_the_name_of_the_field():
    check_type("x", "geometry_msgs/Point[]", [])
    with pytest.raises(SerializationError, match=r"field speed\[1\] must be float type, not 'fast'"):
        check_type("speed", "float64[]", [1, "fast"])


class Pair(genpy.Message):
    """Two numbers, written by hand."""

    _type = "by_hand/Pair"
    _md5sum = "0" * 32
    __slots__ = ["first", "second"]
    _slot_types = ["int32", "int32"]

    def __init__(self, *args, **kwds):
        super().__init__(*args, **kwds)
        if not args:
            self.first, self.second = kwds.get("first", 0), kwds.get("second", 0)

    def serialize(self, buff):
        buff.write(struct.pack("<ii", self.first, self.second))

    def deserialize(self, str):
        self.first, self.second = struct.unpack("<ii", str)
        return self


class Half(genpy.Message):
    """Cannot be written."""

    _type = "by_hand/Half"
    _md5sum = "1" * 32
    __slots__ = ["half"]
    _slot_types = ["int32"]


def test_a_class_written_by_hand():
    pair = Pair(1, second := 2)
    assert str(pair) == "first: 1\nsecond: 2"
    assert pair == Pair(first=1, second=second) != Pair()
    assert copy.deepcopy(pair) == pickle.loads(pickle.dumps(pair)) == pair
    with pytest.raises(AttributeError, match="third"):
        Pair(third=1)


@pytest.mark.parametrize("names", [("one",), ("one", "two")])
def test_it_is_published_as_its_own_bytes_say(names):
    graph = Graph()
    heard = []
    for name in names:
        graph.node(name).subscriber("pairs", Pair, heard.append)
    publisher = graph.node("sender").publisher("pairs", Pair, queue_size=1)
    publisher.wait_for_subscribers(len(names))
    pair = Pair(1, 2)
    publisher.publish(pair)
    pair.first = 99
    graph.run(0.1)
    assert heard == [Pair(1, 2)] * len(names)
    assert len({id(pair) for pair in heard}) == len(names)
    assert heard[0]._connection_header["callerid"] == "/sender"
    with pytest.raises(SerializationError, match="field first must be an integer type"):
        publisher.publish(Pair("x", 2))
    with pytest.raises(SerializationError, match=r"Half is written by hand and has no serialize\(\)"):
        graph.node("sender").publisher("halves", Half, queue_size=1).publish(Half())
    graph.shutdown("the test is over")


def test_classes_from_a_text():
    text = f"Two[] twos\n{'=' * 80}\nMSG: mine/Two\nint32 a\n"
    made = genpy.dynamic.generate_dynamic("mine/One", text)
    assert str(made["mine/One"]([made["mine/Two"](3)])) == "twos: \n  - \n    a: 3"
