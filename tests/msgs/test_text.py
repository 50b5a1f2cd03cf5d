"""The printed form; its agreement with genpy is tested in tests/interop/test_genpy.py."""

from __future__ import annotations

import yaml
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.msgs.text import strify_message

String = message_class("std_msgs/String")


def test_nested_messages_lists_and_times() -> None:
    path = message_class("nav_msgs/Path")(poses=[message_class("geometry_msgs/PoseStamped")()])
    path.header.stamp = Time(12, 34)
    lines = str(path).splitlines()
    assert lines[:6] == [
        "header: ", "  seq: 0", "  stamp: ", "    secs: 12", "    nsecs:        34", "  frame_id: ''",
    ]  # fmt: skip
    assert lines[6:9] == ["poses: ", "  - ", "    header: "]


def test_bytes_are_shown_as_numbers_and_empty_lists_as_brackets() -> None:
    image = message_class("sensor_msgs/Image")(data=b"\1\2")
    assert "data: [1, 2]" in str(image)
    assert str(message_class("nav_msgs/Path")()).endswith("poses: []")


def test_options_of_rostopic_echo() -> None:
    header = message_class("std_msgs/Header")(seq=3, stamp=Time(12, 34))
    assert "secs: 2\n" in strify_message(header, time_offset=Time(10))
    assert strify_message(header, field_filter=lambda _: ["seq"]) == "seq: 3"
    vector = message_class("geometry_msgs/Vector3")(1.25, 100.0, 3)
    assert strify_message(vector, fixed_numeric_width=6) == "x: 1.2500\ny: 100.00\nz:      3"


@given(st.text(max_size=100))
def test_any_text_is_shown_as_yaml_shows_it(text: str) -> None:
    expected = yaml.dump(text, default_style='"').rstrip("\n") if text else "''"
    assert str(String(text)) == f"data: {expected}"
