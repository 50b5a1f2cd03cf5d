"""``genpy.message``: the base class of messages, messages as text, classes by name, messages from plain values."""

from __future__ import annotations

from typing import Any

from rosmini.core.errors import (
    DefinitionError,
    DeserializationError,
    IllegalName,
    MessageException,
    RosminiError,
    SerializationError,
    UnknownPackage,
    UnknownType,
    shown,
)
from rosmini.core.time import Duration, Time, TVal
from rosmini.msgs import message_class, service_class
from rosmini.msgs.definition import BUILTIN_TYPES, BYTES, parse_message
from rosmini.msgs.fields import check_field
from rosmini.msgs.message import Message
from rosmini.msgs.text import strify_message

__all__ = [
    "DeserializationError",
    "Message",
    "MessageException",
    "SerializationError",
    "check_type",
    "fill_message_args",
    "get_message_class",
    "get_printable_message_args",
    "get_service_class",
    "strify_message",
]

TIMES: dict[str, type[TVal]] = {"time": Time, "duration": Duration}


class MessageArgumentsError(RosminiError, ValueError):
    """The values for a message are neither a list of its fields nor a dictionary."""


def get_message_class(message_type: str, reload_on_error: bool = False) -> Any:  # noqa: ARG001 - genpy's signature
    """Return the class of a type such as "std_msgs/String", or None. Raises ``ValueError`` for a bad name."""
    return TIMES.get(message_type) or _class_or_none(message_class, message_type)


def get_service_class(service_type: str, reload_on_error: bool = False) -> Any:  # noqa: ARG001 - genpy's signature
    """Return the class of a service type such as "std_srvs/SetBool", or None. Raises ``ValueError`` for a bad name."""
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


def check_type(field_name: str, field_type: str, field_val: Any) -> None:
    """Raise ``SerializationError`` unless a field of a type ("uint8", "geometry_msgs/Point") can hold a value.

    All serialisable values pass, including text that is not ASCII, numpy's numbers and arrays, and a bool as a number.
    Raises ``DefinitionError``, ``UnknownType`` or ``UnknownPackage`` for an invalid type.
    """
    (field,) = parse_message(f"{field_type} value", "genpy/check_type").fields
    check_field(field, field_name, field_val, None if field.builtin else message_class(field.base))


def get_printable_message_args(msg: Message, buff: Any = None, prefix: str = "") -> str:
    """Return the names of a message's fields on one line, those of nested messages with a dot."""
    names: list[str] = []
    for name in msg.__slots__:
        value = getattr(msg, name)
        if isinstance(value, Message):
            names.append(get_printable_message_args(value, None, f"{prefix}{name}."))
        else:
            names.append(f"{prefix}{name}")
    line = " ".join(filter(None, names))
    if buff is not None:
        buff.write(line)
    return line


def fill_message_args(msg: Message, msg_args: Any, keys: dict[str, Any] | None = None) -> None:
    """Fill a message from plain values: a list of all fields or a dictionary of some, or a list with one of these.

    Args:
        msg: the message.
        msg_args: the values. A time is a list or dictionary of ``secs`` and ``nsecs``, or an integer number of
            nanoseconds; None in a dictionary is an empty text, and None as the whole value is an empty list.
        keys: values for texts used in place of a time or a message (``{"now": Time}``; ``rostopic`` passes "auto"
            for a header).

    Raises ``MessageException`` for an unknown field or key and for a wrong number of values, ``ValueError`` for values
    that are neither a list nor a dictionary.

    """
    if msg_args is None:
        msg_args = []
    if isinstance(msg_args, list) and len(msg_args) == 1 and isinstance(msg_args[0], dict):
        msg_args = msg_args[0]
    _fill(msg, msg_args, keys or {}, "")


def _names(target: Any) -> list[str]:
    return ["secs", "nsecs"] if isinstance(target, TVal) else list(target.__slots__)


def _fill(target: Any, values: Any, keys: dict[str, Any], prefix: str) -> None:
    if not isinstance(target, (Message, TVal)):
        raise MessageArgumentsError(f"a message can be filled, not {shown(target)}")
    names = _names(target)
    if isinstance(values, dict):
        for name, value in values.items():
            _fill_field(target, name, "" if value is None else value, keys, prefix)
    elif isinstance(values, list):
        if len(values) != len(names):
            few = "Not enough" if len(values) < len(names) else "Too many"
            raise MessageException(
                f"{few} arguments for {_what(target, prefix)}: it has {len(names)} fields ({', '.join(names)}), "
                f"and {len(values)} values were given: {shown(values)}"
            )
        for name, value in zip(names, values, strict=True):
            _fill_field(target, name, value, keys, prefix)
    else:
        raise MessageArgumentsError(
            f"{_what(target, prefix)}: give a list of its fields ({', '.join(names)}) or a dict, not {shown(values)}"
        )


def _what(target: Any, prefix: str) -> str:
    kind = getattr(target, "_type", type(target).__name__)
    return f"field {prefix.rstrip('.')}, a {kind}" if prefix else f"a {kind}"


def _fill_field(target: Any, name: Any, value: Any, keys: dict[str, Any], prefix: str) -> None:
    if name not in _names(target):
        kind = getattr(target, "_type", type(target).__name__)
        raise MessageException(
            f"No field name [{prefix}{name}]: the fields of a {kind} are {', '.join(_names(target))}"
        )
    present, path = getattr(target, name), f"{prefix}{name}"
    if isinstance(present, (Message, TVal)):
        value = _filled(present, value, keys, path)
    elif isinstance(target, Message):
        value = _elements(target._slot_types[_names(target).index(name)], value, keys, path)
    setattr(target, name, value)


def _filled(present: Any, value: Any, keys: dict[str, Any], path: str) -> Any:
    """Return the new value of a field that holds a message or a time; ``present`` is the current one."""
    if isinstance(value, str):
        if value not in keys:
            known = f"there are {', '.join(keys)}" if keys else "no key is given here"
            raise MessageException(f"No key named [{value}] for field {path}: {known}")
        return keys[value]
    return _made(present, value, keys, f"{path}.")


def _made(fresh: Any, value: Any, keys: dict[str, Any], prefix: str) -> Any:
    if isinstance(fresh, TVal) and type(value) is int:
        return type(fresh).from_nsec(value)
    _fill(fresh, value, keys, prefix)
    return fresh


def _elements(kind: str, value: Any, keys: dict[str, Any], path: str) -> Any:
    """Return the value of a field that is neither a message nor a time: array elements, or the value itself."""
    base, bracket, size = kind.partition("[")
    if not bracket or base in BYTES:
        return value
    if not isinstance(value, (list, tuple)):
        raise MessageException(f"Field [{path}] must be a list or tuple instead of: {type(value).__name__}")
    wanted = size.removesuffix("]")
    if wanted and len(value) != int(wanted):
        raise MessageException(f"Field [{path}] has incorrect number of elements: {len(value)} != {wanted}")
    if base in BUILTIN_TYPES and base not in TIMES:
        return value
    cls: Any = TIMES.get(base) or message_class(base)
    return [_made(cls(), one, keys, f"{path}[{number}].") for number, one in enumerate(value)]
