"""Bytes: against rosbags' own ROS 1 serialisation, and from hostile senders."""

from __future__ import annotations

import struct
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

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


def as_rosbags(store: Any, message: Any) -> Any:
    cls = type(message)
    values = {}
    for field in cls._spec.fields:
        value = getattr(message, field.name)
        if field.base in ("time", "duration"):
            time = store.types[f"builtin_interfaces/msg/{field.base.capitalize()}"]
            values[field.name] = time(sec=value.secs, nanosec=value.nsecs)
        elif field.base in cls._nested:
            several = field.size is not None
            values[field.name] = [as_rosbags(store, v) for v in value] if several else as_rosbags(store, value)
        elif field.size is not None and field.base != "string":
            kind = {"char": "uint8", "byte": "int8"}.get(field.base, field.base)
            values[field.name] = np.array(list(value), dtype=kind)
        else:
            values[field.name] = value
    return store.types[cls._type.replace("/", "/msg/")](**values)


@pytest.mark.parametrize("name", TYPES)
def test_bytes_equal_those_of_rosbags(name: str) -> None:
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    cls = message_class(name)
    store = get_typestore(Stores.ROS1_NOETIC)
    store.register({**get_types_from_msg(cls._full_text, name.replace("/", "/msg/"))})
    message = sample(cls)
    expected = bytes(store.serialize_ros1(as_rosbags(store, message), name.replace("/", "/msg/")))
    assert cls._encode(message) == expected
    assert cls._decode(expected) == cls._freeze(message)


@pytest.mark.parametrize("name", TYPES)
def test_a_message_survives_the_wire(name: str) -> None:
    cls = message_class(name)
    message = sample(cls)
    data = cls._encode(message)
    for kind in (bytes, bytearray, memoryview):
        assert cls._decode(kind(data)) == cls._freeze(message)
    assert cls._encode(cls._decode(data)) == data


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
    assert message_class("std_msgs/String")._decode(b"\x03\0\0\0a\xffb").data == "a\ufffdb"


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
    assert len(many._decode(struct.pack("<I", 3)).many) == 3
    with pytest.raises(DeserializationError, match="field many claims 4294967295 elements"):
        many._decode(b"\xff\xff\xff\xff")


@given(st.sampled_from(TYPES), st.binary(max_size=300))
def test_any_bytes_are_a_message_or_refused(name: str, data: bytes) -> None:
    _decode_or_refuse(name, data)


@given(st.sampled_from(TYPES), st.data())
def test_any_damage_to_a_message_is_harmless(name: str, data: st.DataObject) -> None:
    cls = message_class(name)
    wire = bytearray(cls._encode(sample(cls)))
    for _ in range(data.draw(st.integers(1, 4))):
        wire[data.draw(st.integers(0, len(wire) - 1))] = data.draw(st.sampled_from([0, 1, 127, 128, 255]))
    _decode_or_refuse(name, bytes(wire))


def _decode_or_refuse(name: str, data: bytes) -> None:
    cls = message_class(name)
    try:
        frozen = cls._decode(data)
    except DeserializationError:
        return
    cls._thaw(frozen)
    assert len(cls._encode(frozen)) >= len(data)  # text that was not UTF-8 grows when it is replaced


@given(st.lists(st.floats(width=32), max_size=20), st.text(st.characters(codec="utf-8"), max_size=20))
def test_any_scan_survives_the_wire(ranges: list[float], frame: str) -> None:
    cls = message_class("sensor_msgs/LaserScan")
    scan = cls(ranges=ranges)
    scan.header.frame_id = frame
    received = cls().deserialize(cls._encode(scan))
    assert repr(received.ranges) == repr(tuple(ranges))
    assert received.header.frame_id == frame
