"""Expressions of `rosbag filter`: those on ROS's pages work, none escapes, and none costs more than it may."""

from __future__ import annotations

import tracemalloc
from types import GeneratorType
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.expressions import Function, Namespace
from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.ros.bag import FilterError
from rosmini.ros.bag.expressions import compile_expression

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
    "(x for x in [1]).gi_frame.f_back.f_globals", "[g.gi_frame.f_back.f_back for g in [(x for x in [1])]]",
    "(i for i in m.ranges).gi_code",
    "().__class__.__base__.__subclasses__()", "m.__class__", "m.__init__.__globals__", "m._spec", "m._registry",
    "m._nested", "m._freeze",
    "m.serialize", "m.deserialize('')", "m.serialize(m)", "topic.format(m)", "'{0.__class__}'.format(m)",
    "'%s' % (lambda: 1)", "f'{m.data}'",
    "'{0.__class__}'.format_map({'a': m})", "topic.encode('utf-8')", "topic.translate({})", "t.__init__(1)",
    "t.set(1, 2)", "t.canon()", "t.from_sec(1)",
    "sorted([1], key=len)", "max([1], key=(lambda x: x))", "max(m.ranges, key=eval)", "[1 for m.data in [1]]",
    "[1 for m.ranges[0] in [1]]",
    "[0 for (topic, m.data) in [(1, 2)]]", "(topic := 1)", "[y := 1]", "lambda: 1", "(lambda: 1)()", "len(*[m])",
    "dict(**{'a': 1})",
    "{**{}}", "[*topic]", "await m", "[x async for x in m]", "yield 1", "(yield)", "import os",
    "__import__('os').system('true')", "__builtins__",
    "open('/etc/passwd').read()", "exec('1')", "eval('1')", "compile('1', '', 'eval')", "globals()", "locals()",
    "vars(m)", "dir(m)",
    "getattr(m, 'data')", "setattr(m, 'data', 1)", "type(m)", "type('A', (), {})", "super()", "object()", "help()",
    "input()", "print(1)",
    "iter(m)", "next((x for x in [1]))", "id(m)", "hash(m)", "memoryview(b'')", "bytes(10)", "bytearray(10)",
    "breakpoint()", "exit()", "quit()",
    "len.__self__", "len.__call__(m)", "topic.__class__", "m.ranges.__class__", "m.ranges.sort()", "[].append(1)",
    "math.__loader__", "math.os",
    "m @ m", "...", "1j", "topic == 1; 2", "topic == \\\n1)", "", "topic ==", "tpic == 1", "m.rangs", "t.seconds",
    "topic.data", "m.header.x",
    "m.ranges[10]", "m['data']", "1 / 0", "int('x')", "m.ranges + 1", "[i for i in 5]", "\0", "topic\ud800",
]  # fmt: skip

BOMBS = [
    "10 ** 10 ** 10", "2 ** (2 ** 40)", "1 << 10 ** 12", "1 << (1 << 60)", "9 ** 9 ** 9 ** 9", "'a' * 10 ** 10",
    "[0] * 10 ** 10", "(0,) * 10 ** 10",
    "10 ** 10 * 'a'", "'a' * 10 ** 5 * 10 ** 5", "['a' * 1000] * 10 ** 6", "list(range(10 ** 12))",
    "sum(range(10 ** 12))", "max(range(10 ** 15))",
    "[i for i in range(10 ** 9)]", "any(False for i in range(10 ** 12))", "str(10 ** 1000) * 10 ** 7",
    "'%1000000000d' % 1", "'%*d' % (1000000000, 1)", "'%.1000000000f' % 1.0", "b'%.1000000000f' % 1.0",
    "('%999d' * 100000) % ((1,) * 100000)", "'%(a)s' * 10 ** 5 % {'a': 'a' * 10 ** 5}", "topic.zfill(10 ** 10)",
    "topic.replace('', 'a' * 10 ** 6)",
    "('a' * 10 ** 5).join(['b'] * 10 ** 5)", "topic.center(10 ** 10)", "topic.ljust(10 ** 10)",
    "topic.expandtabs(10 ** 10)", "factorial(10 ** 7)",
    "int('9' * 10 ** 6)", "{i: i for i in range(10 ** 9)}", "set(range(10 ** 10))", "sorted(range(10 ** 10))",
    "list(zip(range(10 ** 10), range(10 ** 10)))",
    "list(enumerate(range(10 ** 10)))", "10 ** 4000 * 10 ** 4000", "[[[0] * 10 ** 3] * 10 ** 3] * 10 ** 3",
    "round(1, 10 ** 10)", "round(10 ** 1000, -(10 ** 9))",
    "0 or " * 3000 + "0", "(" * 500 + "1" + ")" * 500, "-" * 5000 + "1", "[" * 2000 + "]" * 2000,
    "+".join(["1"] * 5000), "topic " + "and topic " * 5000,
    "m" + ".header" * 3000, "1" * 9999, "a" * 100_000, "not " * 2000 + "1", "1" + "[0]" * 3000,
    "1 if 1 else " * 800 + "1", "abs(" * 900 + "1" + ")" * 900,
]  # fmt: skip


@pytest.mark.parametrize("text", ESCAPES, ids=range(len(ESCAPES)))
def test_nothing_leads_out(text: str) -> None:
    with pytest.raises(FilterError) as caught:
        value(text)
    assert len(str(caught.value)) < 1000


@pytest.mark.parametrize("text", BOMBS, ids=range(len(BOMBS)))
def test_nothing_costs_more_than_it_may(text: str) -> None:
    tracemalloc.start()
    try:
        try:
            value(text)
        except FilterError as error:
            assert len(str(error)) < 1000  # noqa: PT017 - some are cheap, and may be evaluated
        assert tracemalloc.get_traced_memory()[1] < 100_000_000
    finally:
        tracemalloc.stop()


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
