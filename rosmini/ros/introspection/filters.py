"""Restricted expressions on messages: ``m.pose.position.x > 0``, ``topic == '/scan' and t.secs > 5``.

ROS's tools pass them to Python's ``eval``. Here they use :mod:`rosmini.core.expressions`, which allow only these
names: the fields and constants of a message (and ``_type``), the two numbers of a time and its conversions to one
number.
"""

from __future__ import annotations

from collections.abc import Collection
from functools import cache
from typing import Any

from rosmini.core.errors import nearest
from rosmini.core.expressions import FUNCTIONS, MATH, Expression, Function, Namespace
from rosmini.core.time import TVal
from rosmini.msgs import Message

_METHODS: dict[type, tuple[str, ...]] = {TVal: ("to_sec", "to_nsec", "is_zero")}


def message_expression(text: str, names: Collection[str]) -> Expression:
    """Return an expression on messages and times with these names. Raises ``ExpressionError``."""
    return Expression(text, names=names, functions=_FUNCTIONS, fields=_field, methods=_METHODS)


def _has_field(value: Any, name: str) -> bool:
    try:
        _field(value, name)
    except AttributeError:
        return False
    return True


_FUNCTIONS: dict[str, Any] = {
    **MATH,
    **FUNCTIONS,
    "math": Namespace("math", MATH),
    "hasattr": Function("hasattr", _has_field),
}


def _field(value: Any, name: str) -> Any:
    cls: Any = type(value)
    names: frozenset[str] = frozenset()
    if issubclass(cls, Message):
        names = _names(cls)
    elif issubclass(cls, TVal):
        names = frozenset(("secs", "nsecs"))
    if name in names:
        return getattr(value, name)
    kind = cls._type if issubclass(cls, Message) else cls.__name__
    hint = nearest(name, names)
    raise AttributeError(f"a {kind} has no {name!r}{f': {hint}' if hint else ''}")


@cache
def _names(cls: Any) -> frozenset[str]:
    """Return the attributes of a message that an expression may read."""
    return frozenset({"_type"} | {each.name for each in cls._spec.fields} | {each.name for each in cls._spec.constants})
