"""Expressions of `rosbag filter`: those on ROS's pages work, and none escapes."""

from __future__ import annotations

from types import GeneratorType
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.expressions import Function, Namespace
from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.ros.bag import FilterError
from rosmini.ros.bag.tools import compile_expression

String = message_class("std_msgs/String")
SCAN = message_class("sensor_msgs/LaserScan")(ranges=(0.2, 1.5, 3.0))
TF = message_class("tf2_msgs/TFMessage")([message_class("geometry_msgs/TransformStamped")()])
TF.transforms[0].header.frame_id = "/odom"
LOG = message_class("rosgraph_msgs/Log")(level=8, msg="a b")


def value(text: str, m: Any = SCAN, topic: str = "/scan") -> Any:
    return compile_expression(text)(topic, m, Time(1271703206, 5))


@pytest.mark.parametrize(
    ("text", "m"),
    [
        # http://wiki.ros.org/rosbag/Commandline#rosbag_filter and http://wiki.ros.org/rosbag/Cookbook
        ("topic == '/velodyne_point_cloud' or topic == '/scan'", SCAN),
        ("hasattr(m, 'ranges') and not hasattr(m, '__class__') and not hasattr(topic, 'upper')", SCAN),
        (("(topic == '/tf' or topic == '/scan') and (m.transforms[0].header.frame_id != '/map' or "
         "m.transforms[0].child_frame_id == 'x')"), TF),
        ("topic != '/tf' or m.transforms[0].header.frame_id != '/map'", TF),
        ("topic == '/scan' and (t.secs == 1271703206 and t.nsecs == 5)", SCAN),
        ("t.secs <= 1271703206.5", SCAN),
        ("t.to_sec() >= 1271703206.0 and t.to_nsec() > 10**18", SCAN),
        ("len(m.ranges) == 3 and min(m.ranges) < 0.3 and m.ranges[-1] == 3.0", SCAN),
        ("any(r < 0.3 for r in m.ranges) and sum([1 for r in m.ranges if r > 1]) == 2", SCAN),
        ("'x' in m.data and m.data.startswith('x')", String("xy")),
        ("m.data.split()[1].upper() == 'B' and str(len(m.data)) == '3'", String("a b")),
        ("m.level == m.ERROR and m.level >= 2 ** 3 and m._type == 'rosgraph_msgs/Log'", LOG),
        ("m.header.stamp.to_sec() == 0 and m.header.stamp.is_zero() and not m.header.frame_id", SCAN),
        ("topic in ('/scan', '/odom') and (t.secs - 1271703206) % 2 == 0 if m else False", SCAN),
        ("not topic.endswith('/image') and abs(m.angle_min) < pi and hypot(3, 4) == 5", SCAN),
        ("True", SCAN),
    ],
)  # fmt: skip
def test_what_ros_shows_of_filters_works(text: str, m: Any) -> None:
    assert bool(value(text, m)) is True


ESCAPES = [
    "(x for x in [1]).gi_frame.f_back.f_globals", "().__class__.__base__.__subclasses__()", "m.__class__",
    "m.__init__.__globals__", "m._spec", "m.serialize(m)", "topic.format(m)", "'{0.__class__}'.format(m)",
    "'%s' % (lambda: 1)", "f'{m.data}'", "'{0.__class__}'.format_map({'a': m})", "t.set(1, 2)", "sorted([1], key=len)",
    "max(m.ranges, key=eval)", "[1 for m.data in [1]]", "[0 for (topic, m.data) in [(1, 2)]]", "(topic := 1)",
    "(lambda: 1)()", "len(*[m])", "dict(**{'a': 1})", "[*topic]", "await m", "[x async for x in m]", "yield 1",
    "import os", "__import__('os').system('true')", "__builtins__", "open('/etc/passwd').read()", "eval('1')",
    "globals()", "vars(m)", "getattr(m, 'data')", "type(m)", "input()", "iter(m)", "memoryview(b'')", "bytes(10)",
    "len.__self__", "m.ranges.sort()", "math.__loader__", "m @ m", "topic == 1; 2", "", "topic ==", "t.seconds",
    "m.ranges[10]", "m['data']", "1 / 0", "int('x')", "[i for i in 5]", "\0", "topic\ud800",
]  # fmt: skip


@pytest.mark.parametrize("text", ESCAPES, ids=range(len(ESCAPES)))
def test_nothing_leads_out(text: str) -> None:
    with pytest.raises(FilterError) as caught:
        value(text)
    assert len(str(caught.value)) < 1000


def test_an_error_says_what_to_write() -> None:
    with pytest.raises(
        FilterError, match=r"a sensor_msgs/LaserScan has no 'rangs': did you mean ranges.*Test the topic first"
    ):
        value("m.rangs[0] > 1")
    with pytest.raises(FilterError, match=r"there is no 'tpic'; did you mean topic.*An example: topic == '/scan'"):
        value("tpic == '/scan'")


parts = st.sampled_from([
    "m", "t", "topic", "m.ranges", "m.header.frame_id", "t.secs", "1", "10 ** 9", "-3", "2.5", "'a'", "b'a'", "[]",
    "()", "{}", "None", "True", "i",
    "len", "str", "range(9)", "m._type", "m.__class__", "__import__", "(i for i in topic)", "math",
])  # fmt: skip
wholes = st.recursive(
    parts,
    lambda part: st.one_of(
        st.tuples(part, st.sampled_from(["+", "*", "**", "%", "<<", "//", "==", "in", "and", "is"]), part).map(
            lambda each: f"({' '.join(each)})"
        ),
        st.tuples(part, part).map(lambda each: f"{each[0]}[{each[1]}]"),
        st.tuples(part, part).map(lambda each: f"{each[0]}({each[1]})"),
        st.tuples(part, part).map(lambda each: f"[{each[0]} for i in {each[1]}]"),
        st.tuples(
            part,
            st.sampled_from(["real", "gi_frame", "ranges", "header", "format", "join", "split", "__dict__", "to_sec"]),
        ).map(".".join),
        st.tuples(part, st.sampled_from(["join", "split", "format", "replace", "count", "to_sec"]), part).map(
            lambda each: f"{each[0]}.{each[1]}({each[2]})"
        ),
        st.tuples(
            st.sampled_from(["list", "str", "sum", "max", "sorted", "int", "repr", "eval", "getattr", "map"]), part
        ).map(lambda each: f"{each[0]}({each[1]})"),
        st.tuples(part, part, part).map(lambda each: f"({each[0]} if {each[1]} else {each[2]})"),
        st.tuples(part, part).map(lambda each: f"(lambda i: {each[0]})({each[1]})"),
    ),
    max_leaves=12,
)


@given(wholes | st.text(max_size=40))
def test_any_expression_has_a_plain_value_or_is_refused(text: str) -> None:
    try:
        found = value(text)
    except FilterError:
        return
    plain = (bool, int, float, str, bytes, list, tuple, dict, set, range, GeneratorType, type(None))
    allowed = (*plain, Time, type(SCAN), type(SCAN.header), Function, Namespace)
    inner = list(found) if isinstance(found, (list, tuple)) else [found]
    assert all(isinstance(each, allowed) for each in inner)
