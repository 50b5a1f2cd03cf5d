"""Angles in parameter files: ``deg(90)``, ``rad(2*pi)``, ``!degrees 90``, ``!radians pi/2`` (wiki.ros.org/rosparam).

The real rosparam passes the expression to Python's ``eval``. Here it is confined: see `rosmini.core.expressions`.
"""

from __future__ import annotations

import math

from rosmini.core.errors import shown
from rosmini.core.expressions import MATH, Budget, Expression, ExpressionError, Namespace

from .errors import RosParamException

_NAMES = {"pi": math.pi, "math": Namespace("math", MATH)}


def degrees(text: str) -> float:
    """Return ``deg(<number>)``, or a number in degrees, in radians. Raises ``RosParamException``."""
    inner = text.strip()
    if inner.startswith("deg(") and inner.endswith(")"):
        inner = inner[4:-1]
    try:
        return float(inner) * math.pi / 180.0
    except ValueError as error:
        raise RosParamException(
            f"{shown(text)} is no angle in degrees: write a number, such as deg(90) or !degrees 90"
        ) from error


def radians(text: str, budget: Budget | None = None) -> float:
    """Return ``rad(<expression>)``, or the expression alone, in radians.

    Expressions may contain numbers, ``pi``, ``+ - * / // % **``, brackets, and functions of ``math``, such as
    ``math.sqrt(2)``. The evaluation is charged to ``budget``. Raises ``RosParamException``.
    """
    inner = text.strip()
    if inner.startswith("rad(") and inner.endswith(")"):
        inner = inner[4:-1]
    try:
        value = Expression(inner, names=(), functions=_NAMES).evaluate({}, budget)
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise ExpressionError(f"{shown(value)} is no real number")
        return float(value)
    except (ExpressionError, OverflowError) as error:
        raise RosParamException(
            f"{shown(text)} is no angle in radians ({error}): write a number or an expression, such as rad(2*pi)"
        ) from error
