"""``numpy_msg(Type)``: messages with numpy arrays (http://wiki.ros.org/rospy_tutorials/Tutorials/numpy)."""

from __future__ import annotations

from functools import cache
from typing import Any

from rosmini.core.lazy import np


@cache
def numpy_msg(msg_type: Any) -> Any:
    """Return a subclass of ``msg_type`` whose received or deserialised messages have read-only numpy arrays."""
    thaw = msg_type._thaw_genpy_numpy  # noqa: SLF001 - the contract of message classes

    def receive(frozen: Any) -> Any:
        message = thaw(frozen)
        message.__class__ = made
        return message

    def deserialize(self: Any, str: bytes) -> Any:
        return self.deserialize_numpy(str, np)

    made: Any = type(
        "Numpy_" + msg_type._type.replace("/", "__"),
        (msg_type,),
        {
            "__slots__": (),
            "__doc__": msg_type.__doc__,
            "__module__": __name__,
            "_plain_type": msg_type,
            "_receive": staticmethod(receive),
            "deserialize": deserialize,
        },
    )
    made.__slots__ = msg_type.__slots__  # scripts expect to find the field names here
    return made
