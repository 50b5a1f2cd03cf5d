"""The module that scripts import as ``genpy``: times, messages, errors (http://docs.ros.org/en/noetic/api/genpy/)."""

from __future__ import annotations

from rosmini.core import time as rostime
from rosmini.core.time import Duration, Time, TVal

from . import dynamic, message
from .message import DeserializationError, Message, MessageException, SerializationError

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
