"""The operators of expressions, once it is known that the result will not be too large."""

from __future__ import annotations

import ast
import operator
import re
from collections.abc import Callable
from typing import Any

from .budget import BITS, Budget, weight
from .errors import NotAllowed, cut

__all__ = ["BINARY", "COMPARE", "UNARY", "compute"]


WIDEST = 2000
"""No number becomes longer than this in a format: its width and its precision have three digits, its value has `BITS`."""


def _power(left: int, right: int) -> int:
    return left.bit_length() * max(right, 0) if abs(left) > 1 else 1


_BITS_OF: dict[Callable[[Any, Any], Any], Callable[[int, int], int]] = {
    operator.mul: lambda left, right: left.bit_length() + right.bit_length(),
    operator.pow: _power,
    operator.lshift: lambda left, right: left.bit_length() + max(right, 0),
}
"""How many bits a whole number will have."""

BINARY: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
    ast.Pow: operator.pow,
    ast.LShift: operator.lshift,
    ast.RShift: operator.rshift,
    ast.BitAnd: operator.and_,
    ast.BitOr: operator.or_,
    ast.BitXor: operator.xor,
}
UNARY: dict[type[ast.unaryop], Callable[[Any], Any]] = {
    ast.UAdd: operator.pos,
    ast.USub: operator.neg,
    ast.Invert: operator.invert,
    ast.Not: operator.not_,
}
COMPARE: dict[type[ast.cmpop], Callable[[Any, Any], Any]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.Is: operator.is_,
    ast.IsNot: operator.is_not,
    ast.In: lambda left, right: left in right,
    ast.NotIn: lambda left, right: left not in right,
}


def compute(operate: Callable[[Any, Any], Any], left: Any, right: Any, budget: Budget) -> Any:
    """What an operator makes of two values, once it is known that the result is not too large."""
    if operate is operator.mod and isinstance(left, str | bytes):
        _pay_for_format(left, right, budget)
    elif isinstance(left, float) or isinstance(right, float):
        return operate(left, right)
    elif isinstance(left, int) and isinstance(right, int):
        bits = _BITS_OF.get(operate)
        if bits is not None and bits(left, right) > BITS:
            raise NotAllowed(f"a whole number of more than {BITS} bits")
    elif operate is operator.mul:
        for one, other in ((left, right), (right, left)):
            if isinstance(one, str | bytes | list | tuple) and hasattr(other, "__index__"):
                budget.room(len(one) * operator.index(other))
    elif operate is operator.add and isinstance(left, str | bytes | list | tuple):
        budget.room(len(left) + len(right))
    return budget.made(operate(left, right))


def _pay_for_format(text: str | bytes, values: Any, budget: Budget) -> None:
    """``'%1000000000d' % 1`` is a billion characters, and so is ``'%(a)s' * 10**5 % {'a': 'a' * 10**4}``."""
    found = text if isinstance(text, str) else text.decode("latin-1")
    budget.room(len(found) + found.count("%") * (WIDEST + weight(budget.made(values))))
    for width in re.findall(r"%(?:\([^)]*\))?([^a-zA-Z%]*)", found):
        if "*" in width or re.search(r"\d{4}", width):
            raise NotAllowed(f"the width of %{cut(width)}")
