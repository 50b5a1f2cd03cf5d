"""Message classes: construction, copies, comparison, constants, text."""

from __future__ import annotations

import pytest

from rosmini.msgs import message_class

String = message_class("std_msgs/String")
Twist = message_class("geometry_msgs/Twist")


def test_defaults_are_zero_values_of_their_own_for_each_message() -> None:
    first, second = Twist(), Twist()
    first.linear.x = 1.0
    assert (second.linear.x, second.angular.z) == (0.0, 0.0)
    assert String().data == ""


def test_freezing_takes_a_snapshot() -> None:
    twist = Twist()
    twist.linear.x = 1
    frozen = Twist._freeze(twist)
    twist.linear.x = 2.0
    assert frozen.linear.x == 1.0
    assert type(frozen.linear.x) is float


def test_an_unknown_field_is_refused_with_the_nearest_one() -> None:
    with pytest.raises(AttributeError, match="did you mean data"):
        String().dat = "x"
    with pytest.raises(AttributeError, match="dat is not an attribute of String.*did you mean data"):
        String(dat="x")
