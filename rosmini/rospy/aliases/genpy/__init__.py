"""What scripts import from ``genpy``: times, the base of messages, its errors (http://docs.ros.org/en/noetic/api/genpy/html/)."""

from __future__ import annotations

from . import dynamic, message, rostime
from .message import DeserializationError, Message, MessageException, SerializationError
from .rostime import Duration, Time, TVal

__all__ = [
    "DeserializationError",
    "Duration",
    "Message",
    "MessageException",
    "SerializationError",
    "TVal",
    "Time",
    "dynamic",
    "message",
    "rostime",
]
