"""The expression of ``rosbag filter``, confined: it reads ``topic``, ``m`` and ``t``, computes, and nothing else.

ROS's tool evaluates any Python. Here it is one of :mod:`rosmini.expressions`, which knows what is listed and nothing
else: of a message its fields and constants (and ``_type``), of a time its two numbers and what makes one number of it.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

from rosmini.errors import nearest, shown
from rosmini.expressions import Expression, ExpressionError
from rosmini.msgs import Message
from rosmini.time import TVal

from .errors import FilterError

if TYPE_CHECKING:
    from collections.abc import Callable

_METHODS: dict[type, tuple[str, ...]] = {TVal: ("to_sec", "to_nsec", "is_zero")}


def compile_expression(text: str) -> Callable[[str, Any, Any], Any]:
    """Return ``f(topic, m, t)`` that evaluates an expression on a message.

    Raises ``FilterError``, which says what is not allowed or where the expression breaks off; the function raises it,
    too, when an expression fails on a message (a field that this type does not have, for instance), or would take too
    long or too much memory.
    """
    try:
        expression = Expression(text, names=("topic", "m", "t"), fields=_field, methods=_METHODS)
    except ExpressionError as error:
        raise FilterError(f"{shown(text)}: {error}. An example: topic == '/scan' and t.secs > 5") from error

    def evaluate(topic: str, m: Any, t: Any) -> Any:
        try:
            return expression.evaluate({"topic": topic, "m": m, "t": t})
        except ExpressionError as error:
            kind = getattr(m, "_type", type(m).__name__)
            raise FilterError(
                f"{shown(text)} failed on a {kind} of {topic}: {error}. Test the topic first: topic == {topic!r} and "
                "..."
            ) from error

    return evaluate


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
    """What an expression may read of a message."""
    return frozenset(
        {"_type"} | {each.name for each in cls._spec.fields} | {each.name for each in cls._spec.constants}
    )
