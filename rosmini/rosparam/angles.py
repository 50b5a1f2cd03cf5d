"""Angles in parameter files: ``deg(90)``, ``rad(2*pi)``, ``!degrees 90`` and ``!radians pi/2`` (http://wiki.ros.org/rosparam).

The real rosparam hands the expression to Python's ``eval``. Here its syntax tree is walked, and what is no arithmetic is refused.
"""

from __future__ import annotations

import ast
import math
import operator
from typing import TYPE_CHECKING, Any

from .errors import RosParamException

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["degrees", "radians"]

_BINARY: dict[type[ast.operator], Callable[[float, float], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
    ast.Pow: operator.pow,
}
_UNARY: dict[type[ast.unaryop], Callable[[float], float]] = {ast.UAdd: operator.pos, ast.USub: operator.neg}
_FUNCTIONS: dict[str, Callable[..., float]] = {
    name: getattr(math, name)
    for name in ("acos", "asin", "atan", "atan2", "cos", "radians", "sin", "sqrt", "tan")
}
_LONGEST = 200
"""How many characters an angle may have; the parser's depth is bounded by it."""


def degrees(text: str) -> float:
    """Return ``deg(<number>)``, or a number of degrees, in radians. Raises ``RosParamException``."""
    inner = text.strip()
    if inner.startswith("deg(") and inner.endswith(")"):
        inner = inner[4:-1]
    try:
        return float(inner) * math.pi / 180.0
    except ValueError as error:
        raise RosParamException(
            f"{text!r} is no angle in degrees: write a number, such as deg(90) or !degrees 90"
        ) from error


def radians(text: str) -> float:
    """Return ``rad(<expression>)``, or the expression alone, in radians.

    An expression has numbers, ``pi``, ``+ - * / // % **``, brackets, and functions of ``math``, such as ``math.sqrt(2)``.
    Raises ``RosParamException``.
    """
    inner = text.strip()
    if inner.startswith("rad(") and inner.endswith(")"):
        inner = inner[4:-1]
    if len(inner) > _LONGEST:
        raise RosParamException(f"an angle of {len(inner)} characters is too long; {_LONGEST} are allowed")
    try:
        value = _value(ast.parse(inner.strip(), mode="eval").body, text)
    except (SyntaxError, ArithmeticError, ValueError, TypeError) as error:
        raise RosParamException(
            f"{text!r} is no angle in radians ({error}): write a number or an expression, such as rad(2*pi) or !radians pi/2"
        ) from error
    return value


def _value(node: ast.expr, text: str) -> float:
    match node:
        case ast.Constant(value=int() | float() as number) if not isinstance(number, bool):
            return float(number)
        case ast.Name(id="pi") | ast.Attribute(value=ast.Name(id="math"), attr="pi"):
            return math.pi
        case ast.UnaryOp(op=op, operand=operand) if type(op) in _UNARY:
            return _UNARY[type(op)](_value(operand, text))
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _BINARY:
            result = _BINARY[type(op)](_value(left, text), _value(right, text))
            if not isinstance(result, float):  # a power of a negative number
                raise TypeError(f"{result} is no real number")
            return result
        case ast.Call(
            func=ast.Attribute(value=ast.Name(id="math"), attr=name), args=arguments, keywords=[]
        ) if name in _FUNCTIONS:
            return _FUNCTIONS[name](*(_value(argument, text) for argument in arguments))
    raise RosParamException(
        f"{text!r} is no angle in radians: {ast.unparse(node)!r} is neither a number, nor pi, nor arithmetic with them"
    )
