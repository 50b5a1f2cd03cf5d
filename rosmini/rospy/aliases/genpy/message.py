"""``genpy.message``: the base of messages, messages as text, classes by name, messages from plain values."""

from __future__ import annotations

from typing import Any

from rosmini.errors import (
    DefinitionError,
    DeserializationError,
    IllegalName,
    MessageException,
    SerializationError,
    UnknownPackage,
    UnknownType,
)
from rosmini.msgs import message_class, service_class
from rosmini.msgs.message import Message
from rosmini.msgs.text import strify_message
from rosmini.time import Duration, Time, TVal

__all__ = [
    "DeserializationError",
    "Message",
    "MessageException",
    "SerializationError",
    "fill_message_args",
    "get_message_class",
    "get_printable_message_args",
    "get_service_class",
    "strify_message",
]


def get_message_class(message_type: str, reload_on_error: bool = False) -> Any:  # noqa: ARG001 - genpy's signature
    """Return the class of a message type such as "std_msgs/String", or None if there is none. Raises ``ValueError`` for a bad name."""
    return _class_or_none(message_class, message_type)


def get_service_class(service_type: str, reload_on_error: bool = False) -> Any:  # noqa: ARG001 - genpy's signature
    """Return the class of a service type such as "std_srvs/SetBool", or None if there is none. Raises ``ValueError`` for a bad name."""
    return _class_or_none(service_class, service_type)


def _class_or_none(find: Any, name: str) -> Any:
    if name == "Header":
        name = "std_msgs/Header"
    try:
        return find(name)
    except IllegalName:
        raise
    except (UnknownType, UnknownPackage, DefinitionError):
        return None


def get_printable_message_args(msg: Message, buff: Any = None, prefix: str = "") -> str:
    """Return the names of a message's fields, those of nested messages with a dot, as one line."""
    names: list[str] = []
    for name in msg.__slots__:
        value = getattr(msg, name)
        if isinstance(value, Message):
            names.append(get_printable_message_args(value, None, f"{prefix}{name}."))
        else:
            names.append(f"{prefix}{name}")
    line = " ".join(names)
    if buff is not None:
        buff.write(line)
    return line


def fill_message_args(msg: Message, msg_args: Any, keys: dict[str, Any] | None = None) -> None:
    """Fill a message from plain values: a dictionary of fields, or a list of all of them in order, nested alike.

    ``keys`` replaces texts by values (``{"now": Time}``; a header given as "auto" gets that time). Raises ``MessageException``.
    """
    keys = keys or {}
    if isinstance(msg_args, (list, tuple)) and len(msg_args) == 1 and isinstance(msg_args[0], dict):
        msg_args = msg_args[0]
    _fill(msg, msg_args, keys, "")


def _fill(msg: Any, values: Any, keys: dict[str, Any], prefix: str) -> None:
    slots = list(msg.__slots__)
    if isinstance(values, dict):
        unknown = [name for name in values if name not in slots]
        if unknown:
            raise MessageException(
                f"No field name [{prefix}{unknown[0]}] in {msg._type}: its fields are {', '.join(slots)}"
            )
        pairs = list(values.items())
    elif isinstance(values, (list, tuple)):
        if len(values) != len(slots):
            few = "not enough" if len(values) < len(slots) else "Too many"
            raise MessageException(
                f"{few} arguments for {prefix.rstrip('.') or msg._type}: it has {len(slots)} fields ({', '.join(slots)}), "
                f"and {len(values)} values were given"
            )
        pairs = list(zip(slots, values, strict=True))
    else:
        raise MessageException(
            f"{prefix.rstrip('.') or msg._type} is a {msg._type}: give a list of its fields or a dictionary, not {values!r}"
        )
    types = dict(zip(slots, msg._slot_types, strict=True))
    for name, value in pairs:
        setattr(msg, name, _value(getattr(msg, name), types[name], value, keys, f"{prefix}{name}."))


def _value(present: Any, kind: str, value: Any, keys: dict[str, Any], prefix: str) -> Any:
    """Return what to set a field to, of which ``present`` is the value now."""
    if isinstance(value, str) and value in keys:
        return keys[value]
    if isinstance(present, TVal):
        return _time(type(present), value, prefix)
    if isinstance(present, Message):
        if value == "auto" and kind == "std_msgs/Header":
            value = {"stamp": keys.get("now", Time())}
        _fill(present, value, keys, prefix)
        return present
    base, bracket, _ = kind.partition("[")
    if bracket and isinstance(value, (list, tuple)):
        if base in ("time", "duration"):
            return [_time(Time if base == "time" else Duration, item, prefix) for item in value]
        if "/" in base:
            made = [message_class(base)() for _ in value]
            for item, given in zip(made, value, strict=True):
                _fill(item, given, keys, prefix)
            return made
    if bracket and not isinstance(value, (list, tuple, bytes, str)):
        raise MessageException(f"Field [{prefix.rstrip('.')}] must be a list or tuple instead of: {value!r}")
    return value


def _time(cls: type[TVal], value: Any, prefix: str) -> TVal:
    if isinstance(value, cls):
        return value
    if isinstance(value, dict):
        return cls(value.get("secs", 0), value.get("nsecs", 0))
    if isinstance(value, (list, tuple)) and len(value) == 2:
        return cls(*value)
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        return cls(value)
    raise MessageException(f"{prefix.rstrip('.')} is a {cls.__name__}: give secs and nsecs, not {value!r}")
