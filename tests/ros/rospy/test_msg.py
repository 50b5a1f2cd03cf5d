"""``rospy.AnyMsg`` outside of a subscriber."""

from __future__ import annotations

from io import BytesIO

import pytest

from rosmini.core.errors import ROSException
from rosmini.msgs.std_msgs.msg import String
from rosmini.ros import rospy


def written(message):
    buffer = BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


def test_an_any_message_carries_the_bytes_of_another():
    data = written(String("hello"))
    message = rospy.AnyMsg().deserialize(data)
    assert written(message) == data
    assert String().deserialize(message._buff).data == "hello"
    assert str(message) == "AnyMsg of 9 bytes"


def test_it_takes_no_arguments_and_writes_nothing_that_it_does_not_have():
    with pytest.raises(ROSException, match="takes no arguments"):
        rospy.AnyMsg("hello")
    with pytest.raises(ROSException, match="holds nothing"):
        rospy.AnyMsg().serialize(BytesIO())
