"""What is kept of small messages."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.graph.observers.brief import MAX_TEXT_LENGTH, brief, values
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.msgs.sensor_msgs.msg import LaserScan
from rosmini.msgs.std_msgs.msg import Empty, Float64, Header, String
from rosmini.msgs.std_srvs.srv import SetBoolResponse


def test_one_field_is_its_value():
    assert brief(values(String("hello"))) == "'hello'"
    assert brief(values(Float64(0.123456))) == "0.1235"


def test_of_several_fields_those_that_are_something_are_named():
    twist = Twist()
    assert brief(values(twist)) == "all 0"
    twist.linear.x, twist.angular.z = 0.2, -1
    assert brief(values(twist)) == "linear.x: 0.2, angular.z: -1"
    assert brief(values(SetBoolResponse(True, "done"))) == "success: True, message: 'done'"


def test_arrays_and_large_messages_are_not_kept():
    assert values(LaserScan()) is None
    assert brief(None) == ""
    assert values(Header()) is None  # its stamp
    assert brief(values(Empty())) == ""


def test_what_was_kept_stays_when_the_message_changes():
    message = String("before")
    kept = values(message)
    message.data = "after"
    assert brief(kept) == "'before'"


@given(st.text())
def test_texts_are_short_and_of_one_line(text):
    shown = brief(values(String(text)))
    assert len(shown) <= MAX_TEXT_LENGTH + 10
    assert "\n" not in shown
