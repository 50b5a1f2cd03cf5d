"""The restricted expressions of ``rosbag filter``: they read ``topic``, ``m`` and ``t``, compute, and do nothing else.

ROS's tool evaluates any Python. Here :mod:`rosmini.core.expressions` evaluates the expression, and allows only
these
names: the fields and constants of a message (and ``_type``), the two numbers of a time and its conversions to a number.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rosmini.core.errors import shown
from rosmini.core.expressions import ExpressionError
from rosmini.ros.introspection.filters import message_expression

from .errors import FilterError


def compile_expression(text: str) -> Callable[[str, Any, Any], Any]:
    """Return ``f(topic, m, t)`` that evaluates an expression on a message.

    Raises ``FilterError``, which says what is not allowed or where the expression is incomplete. The function raises it
    as well if the expression fails on a message (a field that this type does not have, for instance), or needs too much
    time or memory.
    """
    try:
        expression = message_expression(text, ("topic", "m", "t"))
    except ExpressionError as error:
        raise FilterError(f"{shown(text)}: {error}. An example: topic == '/scan' and t.secs > 5") from error

    def evaluate(topic: str, m: Any, t: Any) -> Any:
        try:
            return expression.evaluate({"topic": topic, "m": m, "t": t})
        except ExpressionError as error:
            kind = getattr(m, "_type", type(m).__name__)
            is_tested = repr(topic) in text or f'"{topic}"' in text
            advice = "" if is_tested else " Test the topic first: topic == '...' and ..."
            raise FilterError(f"{shown(text)} failed on a {kind} of {topic}: {error}.{advice}") from error

    return evaluate
