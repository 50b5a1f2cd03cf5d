"""The numbers and texts of small messages, as a history stores them: cheap to store and short to show."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import lru_cache
from operator import attrgetter
from typing import Any

from rosmini.core.errors import shown

MAX_FIELDS = 6
"""Maximum number of numbers and texts in a small message."""

MAX_TEXT_LENGTH = 32
"""Maximum number of characters of a text that are shown."""

SCALARS = frozenset(["bool", "byte", "char", "float32", "float64", "string"])
INTEGERS = frozenset(f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64))

Values = tuple[tuple[str, ...], tuple[Any, ...]]
"""The names of the fields (``linear.x``) and their values."""


def values(message: Any) -> Values | None:
    """Return the values of a small message without its header; None for any other message."""
    cls: Any = type(message)
    names, take = _reader(cls)
    return None if take is None else (names, take(message))


def brief(kept: Values | None) -> str:
    """Return the stored values of a message as one line; fields that are 0 or empty are left out."""
    if kept is None:
        return ""
    names, found = kept
    if not names:
        return ""
    if len(names) == 1:
        return _short(found[0])
    some = [f"{name}: {_short(value)}" for name, value in zip(names, found, strict=True) if value]
    return ", ".join(some) or "all 0"


def _short(value: Any) -> str:
    return f"{value:.4g}" if isinstance(value, float) else shown(value, MAX_TEXT_LENGTH)


@lru_cache(maxsize=1_000)
def _reader(cls: Any) -> tuple[tuple[str, ...], Callable[[Any], tuple[Any, ...]] | None]:
    try:
        names = tuple(_fields(cls))
    except _NotSmall:
        return (), None
    if len(names) > MAX_FIELDS:
        return (), None
    if not names:
        return (), lambda _: ()
    take = attrgetter(*names)
    return names, take if len(names) > 1 else lambda message: (take(message),)


class _NotSmall(Exception):
    """The message contains an array, or another field that cannot be shown in one line."""


def _fields(cls: Any) -> Iterator[str]:
    for field in cls._spec.fields:
        if field.size is not None or field.base != field.type:
            raise _NotSmall
        if field.type in SCALARS or field.type in INTEGERS:
            yield field.name
        elif field.type in cls._nested:
            if field.type != "std_msgs/Header":
                for inner in _fields(cls._nested[field.type]):
                    yield f"{field.name}.{inner}"
        else:
            raise _NotSmall
