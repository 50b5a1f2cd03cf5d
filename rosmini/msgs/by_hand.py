"""Hand-written message classes, with ``__slots__``, ``_slot_types``, and functions to serialise themselves.

Scripts derive them from ``genpy.Message``. This module adds the interface of generated classes; their bytes come from
their own ``serialize``.
"""

from __future__ import annotations

from io import BytesIO
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import SerializationError

from .definition import Field, MessageSpec

if TYPE_CHECKING:
    from collections.abc import Callable

    from .contract import MessageContract


def set_slots(message: Any, args: tuple[Any, ...], kwds: dict[str, Any]) -> None:
    """Set all fields, by position or by keyword; the others become None. Raises as genpy's constructor does."""
    names = list(message.__slots__)
    kind = type(message).__name__
    if args and kwds:
        raise TypeError("Message constructor may only use args OR keywords, not both")
    if args and len(args) != len(names):
        raise TypeError(
            f"Invalid number of arguments: {kind} takes {len(names)} ({', '.join(names)}), and {len(args)} were given"
        )
    for name in kwds:
        if name not in names:
            raise AttributeError(f"{name} is not an attribute of {kind}: its fields are {', '.join(names)}")
    given = dict(zip(names, args, strict=True)) if args else kwds
    for name in names:
        setattr(message, name, given.get(name))


def complete(cls: Any, base: type[MessageContract]) -> None:
    """Add the interface of generated message classes to a hand-written class derived from ``base``."""
    for function in ("serialize", "deserialize"):
        if getattr(cls, function) is getattr(base, function):
            setattr(cls, function, _missing(cls.__name__, function))
    if not hasattr(cls, "_type"):
        cls._type = f"{cls.__module__}/{cls.__name__}"
    fields = [_field(kind, name) for kind, name in zip(cls._slot_types, cls.__slots__, strict=False)]
    cls._spec = MessageSpec(cls._type, "", tuple(fields), ())
    cls._nested, cls._registry = {}, None
    cls._plain = cls._plain_numpy = False
    for name, default in (("_has_header", False), ("_full_text", "")):
        if not hasattr(cls, name):
            setattr(cls, name, default)

    def copied(message: Any, header: dict[str, str] | None = None) -> Any:
        copy = _read(cls, _written(cls, message))
        copy._connection_header = header
        return copy

    cls._freeze = cls._thaw = cls._thaw_numpy = cls._thaw_genpy_numpy = staticmethod(copied)
    cls._encode = staticmethod(lambda message: _written(cls, message))
    cls._read = staticmethod(lambda data, start, end: (_read(cls, data[start:end]), end))


def _field(kind: str, name: str) -> Field:
    base, bracket, size = kind.partition("[")
    count = size.removesuffix("]")
    return Field(kind, base, (int(count) if count.isdigit() else -1) if bracket else None, name, 0)


def _written(cls: type[MessageContract], message: Any) -> bytes:
    from .fields import ERRORS, explain

    buffer = BytesIO()
    try:
        message.serialize(buffer)
    except SerializationError:  # its message names the field
        raise
    except ERRORS as error:
        raise explain(cls, message, error) from error
    return buffer.getvalue()


def _read(cls: Any, data: bytes) -> Any:
    made = cls()
    found = made.deserialize(data)
    return made if found is None else found


def _missing(name: str, function: str) -> Callable[..., None]:
    def refuse(self: Any, *_: Any) -> None:  # noqa: ARG001 - a method
        raise SerializationError(f"the message class {name} is written by hand and has no {function}(): write one")

    return refuse
