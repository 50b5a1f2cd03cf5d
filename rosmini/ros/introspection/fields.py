"""Fields of messages by path, as ``rostopic`` writes them: ``/pose/pose/position/x``, ``/ranges[0:3]``."""

from __future__ import annotations

from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import DefinitionError, IllegalName, RosminiError, UnknownPackage, UnknownType, nearest
from rosmini.core.time import TVal
from rosmini.msgs import message_class, service_class
from rosmini.msgs.definition import BUILTIN_TYPES
from rosmini.msgs.message import Message

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    Choose = Callable[[Any], Iterable[str]]

TIME_FIELDS = ("secs", "nsecs")


class FieldError(RosminiError):
    """A path is invalid, or names no field of a message."""


def class_of(kind: str) -> Any:
    """Return the class of a message type, or None if it is unknown."""
    try:
        return message_class(kind)
    except (UnknownType, UnknownPackage, DefinitionError, IllegalName):
        return None


def service_class_of(kind: str) -> Any:
    """Return the class of a service type, or None if it is unknown."""
    try:
        return service_class(kind)
    except (UnknownType, UnknownPackage, DefinitionError, IllegalName):
        return None


def field_type(kind: str, path: str) -> str | None:
    """Return the type of the field at a path without indices, or None if the message type has no such field."""
    for name in filter(None, path.split("/")):
        base = kind.partition("[")[0]
        if base in ("time", "duration"):
            kind = "int32" if name in TIME_FIELDS else ""
        else:
            cls = None if base in BUILTIN_TYPES else class_of("std_msgs/Header" if base == "Header" else base)
            known = {} if cls is None else dict(zip(cls.__slots__, cls._slot_types, strict=True))
            kind = known.get(name, "")
        if not kind:
            return None
    return kind


# -- reading ---------------------------------------------------------------------------------------------------------

Index = int | slice | None


def reader(path: str) -> Callable[[Any], Any]:
    """Return a function that returns the field at a path of a message.

    Raises ``FieldError`` for an invalid path; the function raises it if a message has no such field or element.
    """
    steps = [_step(part) for part in path.split("/") if part]

    def read(value: Any, at: int = 0) -> Any:
        for number in range(at, len(steps)):
            name, index = steps[number]
            value = _field(value, name, path)
            if index is None:
                continue
            try:
                value = value[index]
            except (IndexError, TypeError) as error:
                raise FieldError(f"{error}: {path}") from error
            if isinstance(value, list):  # of messages: the rest of the path applies to each
                return [read(one, number + 1) for one in value]
        return value

    return read


def _field(value: Any, name: str, path: str) -> Any:
    known = _names(value)
    if name in known:
        return getattr(value, name)
    hint = nearest(name, known) or (f"there are {', '.join(known)}" if known else "it has no fields")
    raise FieldError(f"no field named {name} in {path}; {hint}")


def _names(value: Any) -> tuple[str, ...]:
    if isinstance(value, TVal):
        return TIME_FIELDS
    return tuple(value.__slots__) if isinstance(value, Message) else ()


def _step(part: str) -> tuple[str, Index]:
    """Return the name and the index in one part of a path."""
    name, bracket, rest = part.partition("[")
    if not bracket:
        return name, None
    if not rest.endswith("]"):
        raise FieldError(f"missing closing ']' in slice spec '{part}'")
    numbers = rest[:-1].split(":")
    try:
        if len(numbers) == 1:
            return name, int(numbers[0])
        if len(numbers) > 3:
            raise ValueError("too many slice arguments")
        return name, slice(*(int(number) if number else None for number in numbers))
    except ValueError as error:
        raise FieldError(f"field '{name}' has invalid slice argument '{rest[:-1]}': {error}") from error


# -- leaving fields out ----------------------------------------------------------------------------------------------


class Shown:
    """A message for display: some of its values are replaced by texts."""

    _spec: Any = None

    def __init__(self, values: dict[str, Any], kinds: dict[str, str]) -> None:
        vars(self).update(values)
        self._spec = SimpleNamespace(fields=[SimpleNamespace(name=name, type=kinds[name]) for name in values])


def without(value: Any, kind: str | None, *, strings: bool, arrays: bool) -> Any:
    """Return a field's value, whose type may be known, with strings or arrays replaced by texts."""
    if kind is not None:
        text = _stand_in(value, kind, strings=strings, arrays=arrays)
        if text is not None:
            return text
    if not isinstance(value, Message):
        return value
    kinds = dict(zip(value.__slots__, value._slot_types, strict=True))
    values = {name: without(getattr(value, name), kinds[name], strings=strings, arrays=arrays) for name in kinds}
    changed = {name: "string" for name in kinds if isinstance(values[name], str)}
    return Shown(values, kinds | changed)


def _stand_in(value: Any, kind: str, *, strings: bool, arrays: bool) -> str | None:
    if arrays and "[" in kind:
        return f"<array type: {kind.rstrip('[]')}, length: {len(value)}>"
    if strings and kind == "string":
        return f"<string length: {len(value)}>"
    if strings and kind == "string[]":
        return f"<array type: string, length: {len(value)}>"
    return None


def chosen(*, strings: bool, arrays: bool) -> Callable[[Any], Iterable[str]]:
    """Return a function that returns the fields of a message without strings or arrays."""

    def fields(message: Any) -> Iterator[str]:
        for name, kind in zip(message.__slots__, message._slot_types, strict=True):
            if not ((arrays and "[" in kind) or (strings and "string" in kind)):
                yield name

    return fields


# -- a line of comma-separated values --------------------------------------------------------------------------------


def columns(value: Any, name: str, choose: Choose) -> list[str]:
    """Return the column titles of a value: one for each number, text and time in it."""
    if isinstance(value, Message):
        parts = [(getattr(value, field), f"{name}.{field}") for field in choose(value)]
    elif isinstance(value, list | tuple):
        parts = [(one, f"{name}{number}") for number, one in enumerate(value)]
    else:
        return [] if isinstance(value, bytes) else [name]
    return [column for part, title in parts for column in columns(part, title, choose)]


def title_line(value: Any, choose: Choose) -> str:
    """Return the first line of ``rostopic echo -p``: the titles of the time and of the columns of a value."""
    titles = columns(value, "field", choose)
    # As in the real tool: the comma remains for a message without columns, but not for an empty array.
    comma = "," if titles or isinstance(value, Message) else ""
    return f"%time{comma}{','.join(titles)}"


def cells(value: Any, choose: Choose) -> list[str]:
    """Return the contents of the columns of a value."""
    if isinstance(value, Message):
        return [cell for field in choose(value) for cell in cells(getattr(value, field), choose)]
    if isinstance(value, list | tuple):
        return [cell for one in value for cell in cells(one, choose)]
    if isinstance(value, bool):
        return ["1" if value else "0"]
    return [] if isinstance(value, bytes) else [str(value)]
