"""Templates: frozen messages from what changes alone."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.errors import RosminiError, SerializationError
from rosmini.msgs import message_class
from rosmini.msgs.template import template


def imu():
    message = message_class("sensor_msgs/Imu")()
    message.header.frame_id = "imu_link"
    message.orientation_covariance[0] = 0.0025
    message.linear_acceleration.z = 9.8
    return message


PATHS = ("header.stamp.secs", "header.stamp.nsecs", "orientation.z", "orientation.w", "linear_acceleration.x")
number = st.floats(allow_nan=False, width=64)


@given(st.integers(0, 2**32 - 1), st.integers(0, 2**32 - 1), number, number, number)
def test_what_is_made_is_what_freezing_the_same_message_gives(secs, nsecs, z, w, x):
    message = imu()
    made = template(message, *PATHS)(secs, nsecs, z, w, x)
    message.header.stamp.secs, message.header.stamp.nsecs = secs, nsecs
    message.orientation.z, message.orientation.w, message.linear_acceleration.x = z, w, x
    frozen = message._freeze(message)
    assert made == frozen
    assert made._encode(made) == frozen._encode(frozen)
    assert type(made) is type(frozen)
    assert type(made.header) is type(frozen.header)


def test_a_template_is_what_the_message_was_when_it_was_made():
    message = imu()
    make = template(message, "orientation.w")
    message.header.frame_id = "elsewhere"
    assert make(1.0).header.frame_id == "imu_link"


def test_arrays_and_texts_can_change_and_lists_that_stay_are_never_shared():
    message = message_class("sensor_msgs/JointState")()
    message.name = ["left", "right"]
    make = template(message, "header.frame_id", "position", "velocity")
    first, second = make("base", (1.0, 2.0), [3.0]), make("base", np.array([4.0]), ())
    first.name.append("third")
    assert second.name == make("", (), ()).name == ["left", "right"]
    assert first.position.tolist() == [1.0, 2.0]
    assert not first.position.flags.writeable
    assert (first.header.frame_id, second.velocity.tolist()) == ("base", [])


def test_lists_of_messages_that_stay_are_copied():
    message = message_class("tf2_msgs/TFMessage")()
    message.transforms = [message_class("geometry_msgs/TransformStamped")(child_frame_id="a")]
    make = template(message)
    first, second = make(), make()
    first.transforms[0].child_frame_id = "b"
    assert second.transforms[0].child_frame_id == "a"


def test_numbers_are_rounded_as_the_wire_rounds_them_and_bools_are_bools():
    message = message_class("sensor_msgs/BatteryState")()
    made = template(message, "voltage", "present")(0.1, np.True_)
    assert made.voltage == np.float32(0.1)
    assert made.present is True


@pytest.mark.parametrize(
    ("value", "problem"), [(None, "orientation.w must be float"), ("1", "orientation.w"), (math.nan, None)]
)
def test_what_a_field_cannot_hold_is_named(value, problem):
    make = template(imu(), "orientation.z", "orientation.w")
    if problem is None:
        assert math.isnan(make(0.0, value).orientation.w)
        return
    with pytest.raises(SerializationError, match=problem):
        make(0.0, value)


@pytest.mark.parametrize("path", ["orientation", "orientation.v", "w", ""])
def test_a_path_to_no_field_is_refused(path):
    with pytest.raises(RosminiError, match=r"sensor_msgs/Imu has no field .* header.stamp.secs"):
        template(imu(), path)
