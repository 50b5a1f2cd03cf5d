"""What is kept of small messages."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.graph.observers.history import MAX_TEXT_LENGTH, brief, values
from rosmini.msgs.sensor_msgs.msg import LaserScan
from rosmini.msgs.std_msgs.msg import Empty, Header, String


def test_arrays_and_large_messages_are_not_kept():
    assert values(LaserScan()) is None
    assert brief(None) == ""
    assert values(Header()) is None  # its stamp
    assert brief(values(Empty())) == ""


@given(st.text())
def test_texts_are_short_and_of_one_line(text):
    shown = brief(values(String(text)))
    assert len(shown) <= MAX_TEXT_LENGTH + 10
    assert "\n" not in shown
