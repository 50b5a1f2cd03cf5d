"""Forms of messages: which fields they have, and what expressions become."""

import pytest

from rosmini.msgs import message_class
from rosmini.viz.rqt.fields import Fields
from rosmini.viz.view import ViewError


def filled(kind, **expressions):
    fields = Fields(message_class(kind))
    for path, text in expressions.items():
        fields.fill(path.replace("__", "/"), text)
    return fields


def test_each_leaf_has_a_control_and_messages_within_have_none():
    table = Fields(message_class("geometry_msgs/PoseStamped")).table("row")
    keys = [row.cells[2] if isinstance(row.cells[2], str) else row.cells[2].key for row in table.rows]
    assert keys == [
        "", "row/header/seq", "row/header/stamp", "row/header/frame_id",
        "", "", "row/pose/position/x", "row/pose/position/y", "row/pose/position/z",
        "", *(f"row/pose/orientation/{name}" for name in "xyzw"),
    ]  # fmt: skip
    assert [row.depth for row in table.rows] == [0, 1, 1, 1, 0, 1, 2, 2, 2, 1, 2, 2, 2, 2]


def test_a_field_becomes_what_its_type_wants():
    made = filled("sensor_msgs/LaserScan", header__stamp="1.5", header__seq="i", ranges="[1, 2.5]", angle_min="1")
    message = made.message(3)
    assert (message.header.stamp.to_sec(), message.header.seq, message.angle_min) == (1.5, 3, 1.0)
    assert list(message.ranges) == [1, 2.5]
    assert list(filled("sensor_msgs/Image", data="[1, 2]").message(0).data) == [1, 2]


@pytest.mark.parametrize("text", ["'a'", "None", "", "x", "i.real", "__import__('os')", "10 ** 10 ** 10", "[1]"])
def test_what_is_no_value_of_the_field_is_refused_and_changes_nothing(text):
    fields = filled("std_msgs/Float64", data="2")
    with pytest.raises(ViewError):
        fields.fill("data", text)
    assert fields.message(0).data == 2.0
    assert fields.texts["data"] == "2"
