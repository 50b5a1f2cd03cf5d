"""Message classes: construction, copies, comparison, constants, freezing and thawing."""

from __future__ import annotations

import copy
import io
import pickle
from typing import Any

import numpy as np
import pytest

from rosmini.core.errors import SerializationError, UnknownPackage, UnknownType
from rosmini.core.time import Duration, Time
from rosmini.msgs import action_class, message_class, service_class

String = message_class("std_msgs/String")
Twist = message_class("geometry_msgs/Twist")
LaserScan = message_class("sensor_msgs/LaserScan")
Image = message_class("sensor_msgs/Image")
Path = message_class("nav_msgs/Path")
PoseStamped = message_class("geometry_msgs/PoseStamped")


# ---- construction ----


def test_defaults_are_zero_values_of_their_own_for_each_message() -> None:
    first, second = Twist(), Twist()
    first.linear.x = 1.0
    assert (second.linear.x, second.angular.z) == (0.0, 0.0)
    assert String().data == ""
    assert Image().data == b""
    assert message_class("sensor_msgs/CameraInfo")().K == [0.0] * 9


def test_fields_are_given_all_by_position_or_some_by_keyword() -> None:
    assert String("a").data == String(data="a").data == "a"
    assert message_class("geometry_msgs/Point")(1, 2, 3).z == 3
    assert message_class("geometry_msgs/Point")(y=2).x == 0.0
    assert Twist(linear=None).linear.x == 0.0
    with pytest.raises(TypeError, match=r"all of its 3 fields by position.*given: 2"):
        message_class("geometry_msgs/Point")(1, 2)
    with pytest.raises(TypeError, match="args OR keywords"):
        message_class("geometry_msgs/Point")(1, 2, 3, x=1)
    with pytest.raises(TypeError, match=r"no field|takes all of its 0 fields"):
        message_class("std_msgs/Empty")(1)


def test_an_unknown_field_is_refused_with_the_nearest_one() -> None:
    with pytest.raises(AttributeError, match="did you mean data"):
        String().dat = "x"
    with pytest.raises(AttributeError, match="did you mean data"):
        _ = String().dat
    with pytest.raises(AttributeError, match=r"dat is not an attribute of String.*did you mean data"):
        String(dat="x")
    with pytest.raises(AttributeError, match="its fields are linear, angular"):
        Twist().qqq = 1


def test_services_and_actions() -> None:
    set_bool = service_class("std_srvs/SetBool")
    assert (set_bool._type, set_bool._md5sum) == ("std_srvs/SetBool", "09fb03525b03e7ea1fd3992bafd87e16")
    assert set_bool._request_class(data=True).data is True
    assert set_bool._response_class._type == "std_srvs/SetBoolResponse"
    action = action_class("move_base_msgs/MoveBase")
    assert action is action_class("move_base_msgs/MoveBaseAction")
    assert action().action_goal.goal.target_pose.header.frame_id == ""
    assert action.__slots__ == ["action_goal", "action_result", "action_feedback"]


@pytest.mark.parametrize(
    ("make", "name", "error", "words"),
    [
        (message_class, "std_msgs/Stringe", UnknownType, "did you mean String"),
        (message_class, "std_msg/String", UnknownPackage, "did you mean std_msgs"),
        (message_class, "std_msgs/Twist", UnknownType, "did you mean geometry_msgs/Twist"),
        (message_class, "String", UnknownType, "package/Type"),
        (message_class, "qqqqq/String", UnknownPackage, "String is defined by std_msgs/String"),
        (service_class, "std_srvs/SetBol", UnknownType, "did you mean SetBool"),
        (action_class, "move_base_msgs/MoveBse", UnknownType, "did you mean MoveBase"),
    ],
)
def test_an_unknown_type_is_refused_with_the_nearest(make: Any, name: str, error: type[Exception], words: str) -> None:
    with pytest.raises(error, match=words):
        make(name)


# ---- Python's conventions ----


def test_copies_share_nothing_that_can_be_written_to() -> None:
    path = Path(poses=[PoseStamped()])
    path._connection_header = {"topic": "/plan"}
    for other in (copy.deepcopy(path), pickle.loads(pickle.dumps(path))):
        assert other == path
        assert type(other) is Path
        other.poses[0].pose.position.x = 1.0
        assert other != path
        assert other._connection_header is None
    assert copy.copy(path).poses is path.poses


def test_equality_is_by_value_and_takes_lists_tuples_and_arrays_for_alike() -> None:
    assert LaserScan(ranges=[1.0, 2.0]) == LaserScan(ranges=(1.0, 2.0)) == LaserScan(ranges=np.array([1.0, 2.0]))
    assert LaserScan(ranges=[1.0]) != LaserScan(ranges=[1.0, 2.0])
    assert String("a") != "a"
    assert String() != message_class("rosgraph_msgs/Clock")()
    with pytest.raises(TypeError):
        hash(String())


# ---- freezing and thawing ----


def test_freezing_takes_a_snapshot_as_the_other_end_of_a_wire_would_see_it() -> None:
    twist = Twist()
    twist.linear.x = 1
    frozen = Twist._freeze(twist)
    twist.linear.x = 2.0
    assert frozen.linear.x == 1.0
    assert type(frozen.linear.x) is float
    assert message_class("std_msgs/Float32")._freeze(message_class("std_msgs/Float32")(0.1)).data == np.float32(0.1)
    clock = message_class("rosgraph_msgs/Clock")(Time(3, 4))
    frozen_clock = type(clock)._freeze(clock)
    clock.clock.secs = 9
    assert frozen_clock.clock == Time(3, 4)
    assert type(message_class("std_msgs/Int8")._freeze(message_class("std_msgs/Int8")(np.int8(3))).data) is int


def test_frozen_arrays_can_never_be_written_to() -> None:
    ranges = np.array([1.0, 2.0])
    frozen = LaserScan._freeze(LaserScan(ranges=ranges))
    ranges[0] = 7.0
    assert frozen.ranges.tolist() == [1.0, 2.0]
    with pytest.raises(ValueError, match="WRITEABLE"):
        frozen.ranges.flags.writeable = True
    assert LaserScan._freeze(frozen).ranges is frozen.ranges


def test_bytes_are_shared_and_not_copied() -> None:
    data = bytes(1000)
    frozen = Image._freeze(Image(data=data))
    assert frozen.data is data
    assert Image._thaw(frozen).data is data


@pytest.mark.parametrize(
    ("message", "words"),
    [
        (lambda: _pose_with_x("1.5"), r"field pose.position.x must be float type, not '1.5' \(str\) \[float64\]"),
        (
            lambda: Path(poses=[PoseStamped(), _pose_with_x(None)]),
            r"field poses\[1\].pose.position.x must be float type, not None",
        ),
        (
            lambda: Twist(linear=3),
            r"field linear must be of type geometry_msgs/Vector3, not 3 \(int\), which has no 'x'",
        ),
        (lambda: LaserScan(ranges=[1.0, "x"]), r"field ranges\[1\] must be float type"),
        (lambda: LaserScan(ranges=np.zeros((2, 2))), "must have one dimension, not 2"),
        (lambda: message_class("sensor_msgs/Imu")(orientation_covariance=[0.0]), "must have exactly 9 elements, not 1"),
        (
            lambda: PoseStamped(header=message_class("std_msgs/Header")(stamp=3.5)),
            r"field header.stamp must be of type Time",
        ),
        (
            lambda: PoseStamped(header=message_class("std_msgs/Header")(stamp=Duration(-1))),
            r"header.stamp.secs must be unsigned",
        ),
        (lambda: String(b"x"), "must be of type str.*decode the bytes"),
    ],
)
def test_a_wrong_value_is_reported_with_its_path_value_and_type(message: Any, words: str) -> None:
    built = message()
    for attempt in (type(built)._freeze, type(built)._encode):
        with pytest.raises(SerializationError, match=words) as caught:
            attempt(built)
        assert str(caught.value).startswith(built._type)
    with pytest.raises(SerializationError, match=words):
        built._check_types()
    with pytest.raises(SerializationError, match=words):
        built.serialize(io.BytesIO())


@pytest.mark.parametrize("value", [2, 255, np.uint8(7)])
def test_a_bool_that_is_none_is_written_and_found_by_the_check_as_in_genpy(value: Any) -> None:
    wrong = message_class("std_msgs/Bool")(value)
    buffer = io.BytesIO()
    wrong.serialize(buffer)
    assert buffer.getvalue() == bytes([value])
    with pytest.raises(SerializationError, match="std_msgs/Bool: field data is not a bool: "):
        wrong._check_types()
    for right in (True, False, 0, 1, np.bool_(True)):
        message_class("std_msgs/Bool")(right)._check_types()


def _pose_with_x(value: Any) -> Any:
    pose = PoseStamped()
    pose.pose.position.x = value
    return pose
