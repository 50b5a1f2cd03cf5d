"""Bytes from hostile senders. `tests/interop/test_genpy.py` compares those of every type with genpy's."""

from __future__ import annotations

import struct
from typing import Any

import pytest

from rosmini.core.errors import DeserializationError
from rosmini.msgs import message_class
from rosmini.msgs.registry import Registry

TYPES = [
    "std_msgs/String", "std_msgs/Header", "geometry_msgs/Twist", "nav_msgs/Odometry", "sensor_msgs/LaserScan",
    "sensor_msgs/JointState", "sensor_msgs/PointCloud2", "visualization_msgs/Marker",
    "diagnostic_msgs/DiagnosticArray", "rosgraph_msgs/Log", "rosgraph_msgs/TopicStatistics",
    "dynamic_reconfigure/Config",
]  # fmt: skip


def sample(cls: type[Any]) -> Any:
    """A message with a value in every field, and two elements in every array."""
    message = cls()
    for field in cls._spec.fields:
        count = 2 if field.size == -1 else field.size
        values = [sample_value(cls, field.base, index) for index in range(1 if count is None else count)]
        if field.size is None:
            setattr(message, field.name, values[0])
        else:
            setattr(message, field.name, bytes(values) if field.base in ("uint8", "char") else values)
    return message


def sample_value(cls: type[Any], base: str, index: int) -> Any:
    if base == "string":
        return f"größe {index}"
    if base == "bool":
        return True
    if base in ("float32", "float64"):
        return 0.5 + index
    if base in ("time", "duration"):
        value = message_class(f"std_msgs/{base.capitalize()}")().data
        value.set(index + 1, 7)
        return value
    return sample(cls._nested[base]) if base in cls._nested else 3 + index


@pytest.mark.parametrize("name", TYPES)
def test_data_cut_off_anywhere_is_refused(name: str) -> None:
    cls = message_class(name)
    data = cls._encode(sample(cls))
    for length in range(len(data)):
        with pytest.raises(DeserializationError, match=name):
            cls._decode(data[:length])
    with pytest.raises(DeserializationError, match=f"{name}: 1 of {len(data) + 1} bytes are left over"):
        cls._decode(data + b"\0")


def test_what_was_received_does_not_change_with_the_buffer() -> None:
    cls = message_class("sensor_msgs/LaserScan")
    buffer = bytearray(cls._encode(cls(ranges=[1.0, 2.0])))
    frozen = cls._decode(buffer)
    buffer[:] = bytes(len(buffer))
    assert frozen.ranges.tolist() == [1.0, 2.0]


def test_text_that_is_not_utf8_is_replaced_as_in_rospy() -> None:
    assert message_class("std_msgs/String")().deserialize(b"\x03\0\0\0a\xffb").data == "a\ufffdb"


def test_a_length_beyond_the_data_names_the_field() -> None:
    cls = message_class("sensor_msgs/LaserScan")
    data = bytearray(cls._encode(cls()))
    data[-8:-4] = struct.pack("<I", 2**32 - 1)
    with pytest.raises(
        DeserializationError, match="field ranges claims 4294967295 elements, but only 4 bytes are left"
    ):
        cls._decode(data)
    cls = message_class("nav_msgs/Path")
    with pytest.raises(DeserializationError, match="nav_msgs/Path: field poses claims 4294967295 elements"):
        cls._decode(cls._encode(cls())[:-4] + b"\xff\xff\xff\xff" + bytes(1000))
    with pytest.raises(DeserializationError, match="diagnostic_msgs/DiagnosticStatus: field name"):
        cls = message_class("diagnostic_msgs/DiagnosticArray")
        cls._decode(cls._encode(cls())[:-4] + b"\x01\0\0\0" + b"\0" + b"\xff" * 30)


def test_an_array_of_empty_messages_cannot_hold_up_the_reader(make_registry: Any) -> None:
    reg: Registry = make_registry({"my_msgs/msg/Many.msg": "std_msgs/Empty[] many\n"})
    many = reg.message_class("my_msgs/Many")
    assert len(many().deserialize(struct.pack("<I", 3)).many) == 3
    with pytest.raises(DeserializationError, match="field many claims 4294967295 elements"):
        many._decode(b"\xff\xff\xff\xff")
