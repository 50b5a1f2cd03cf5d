"""The operators, functions and methods of expressions."""

from __future__ import annotations

import ast
import math
import operator
import re
from collections.abc import Callable, Collection, Iterable, Mapping
from types import MappingProxyType
from typing import Any

from rosmini.core.errors import nearest, shown

from .budget import BITS, STEPS, Budget, NotAllowed, check_bits, cut, weight

MAX_NUMBER_WIDTH = 2000
"""Maximum length of a formatted number: width and precision have at most three digits, an integer `BITS` bits."""

MAX_ROUND_DIGITS = 400
"""Maximum number of digits for ``round``; floating-point numbers have fewer."""

_OPERATORS = (
    "Add add, Sub sub, Mult mul, Div truediv, FloorDiv floordiv, Mod mod, Pow pow, LShift lshift, RShift rshift, "
    "BitAnd and_, BitOr or_, BitXor xor, UAdd pos, USub neg, Invert invert, Not not_, "
    "Eq eq, NotEq ne, Lt lt, LtE le, Gt gt, GtE ge, Is is_, IsNot is_not"
)
OPERATORS: Mapping[type[ast.AST], Callable[..., Any]] = {
    **{getattr(ast, node): getattr(operator, name) for node, name in map(str.split, _OPERATORS.split(","))},
    ast.In: lambda left, right: left in right,
    ast.NotIn: lambda left, right: left not in right,
}
"""The function for each operator node."""

_BITS_OF: dict[Callable[..., Any], Callable[[int, int], int]] = {
    operator.mul: lambda left, right: left.bit_length() + right.bit_length(),
    operator.pow: lambda left, right: left.bit_length() * max(right, 0) if abs(left) > 1 else 1,
    operator.lshift: lambda left, right: left.bit_length() + max(right, 0),
}
"""An upper bound of the size of the result [bits] for each operator that can make large integers."""


def compute(operate: Callable[[Any, Any], Any], left: Any, right: Any, budget: Budget) -> Any:
    """Return the result of an operator of `OPERATORS`. Raises `NotAllowed`, before computing it, if it is too large."""
    if operate is operator.mod and isinstance(left, str | bytes):
        _pay_for_format(left, right, budget)
    elif isinstance(left, float) or isinstance(right, float):
        return operate(left, right)
    elif isinstance(left, int) and isinstance(right, int):
        budget.read(left)
        budget.read(right)
        if operate in _BITS_OF:
            check_bits(_BITS_OF[operate](left, right))
    elif operate is operator.mul:
        for one, other in ((left, right), (right, left)):
            if isinstance(one, str | bytes | list | tuple) and hasattr(other, "__index__"):
                budget.room(len(one) * operator.index(other))
    elif operate is operator.add and isinstance(left, str | bytes | list | tuple):
        budget.room(len(left) + len(right))
    found = operate(left, right)
    if isinstance(found, set | dict):
        budget.unique(found)
    return budget.made(found)


_CONVERSION = re.compile(r"%(?:\([^()]*\))?[-+ #0]*(\*|[0-9]*)(?:\.(\*|[0-9]*))?[hlL]?(.?)", re.DOTALL)
"""A conversion in a format string, with width, precision and type, as Python parses it. If a key contains
brackets, the type is ``(``."""


def _pay_for_format(text: str | bytes, values: Any, budget: Budget) -> None:
    """Charge in advance for ``text % values``, as ``'%1000000000d' % 1`` is huge. Raises `NotAllowed` if too large."""
    found = text if isinstance(text, str) else text.decode("latin-1")
    budget.room(len(found) + found.count("%") * (MAX_NUMBER_WIDTH + weight(budget.made(values))))
    for conversion in _CONVERSION.finditer(found):
        width, precision, kind = conversion.groups("")
        if "*" in (width, precision) or len(width) > 3 or len(precision) > 3:
            raise NotAllowed(f"the width of {cut(conversion[0])}")
        if kind == "(":
            raise NotAllowed("a format string with brackets in a name")


class Function:
    """A function that expressions may call; they cannot call anything else.

    ``call`` must be safe for all arguments: no access to files or attributes, and a result whose size is bounded
    by that of the arguments. With `counts`, the first argument of ``call`` is the `Budget`, which it charges itself.
    """

    __slots__ = ("call", "counts", "name")

    def __init__(self, name: str, call: Callable[..., Any], *, counts: bool = False) -> None:
        self.name, self.call, self.counts = name, call, counts

    def __repr__(self) -> str:
        return f"<function {self.name}>"

    def apply(self, budget: Budget, arguments: Iterable[Any], named: Mapping[str, Any]) -> Any:
        """Call the function, charge the budget, and return the result."""
        for value in arguments:
            budget.read(value)
        first = (budget,) if self.counts else ()
        return budget.made(self.call(*first, *arguments, **named))


class Namespace:
    """A set of names that are written after ``name`` and a dot: ``math.pi``."""

    __slots__ = ("members", "name")

    def __init__(self, name: str, members: Mapping[str, Any]) -> None:
        self.name, self.members = name, members

    def __repr__(self) -> str:
        return f"<names of {self.name}>"

    def member(self, name: str) -> Any:
        """Return the value of a name. Raises ``NameError`` if there is none."""
        if name not in self.members:
            hint = nearest(name, self.members)
            raise NameError(f"name '{self.name}.{name}' is not defined{f'; {hint}' if hint else ''}")
        return self.members[name]


def _sum(values: Iterable[Any], start: Any = 0) -> Any:
    if isinstance(start, str | bytes | list | tuple):
        raise TypeError("sum() adds numbers")  # adding lists would take quadratic time
    return sum(values, start)


def _round(value: Any, digits: int | None = None) -> Any:
    if digits is not None and abs(digits) > MAX_ROUND_DIGITS:
        raise NotAllowed(f"round() to {digits} digits")
    return round(value, digits)


def _factorial(value: int) -> int:
    if value > BITS // 8:
        raise NotAllowed(f"the factorial of {value}")
    return math.factorial(value)


def _range(*bounds: Any) -> range:
    found = range(*bounds)
    if len(found) > STEPS:
        raise NotAllowed(f"range() of {len(found)} numbers")
    return found


def _map(budget: Budget, function: Any, *values: Iterable[Any]) -> list[Any]:
    if not isinstance(function, Function):
        raise TypeError(f"map() takes a function, not {shown(function)}")
    rows = zip(*(budget.collect(each) for each in values), strict=False)
    return [function.apply(budget, row, {}) for row in rows]


def _filter(budget: Budget, function: Any, values: Iterable[Any]) -> list[Any]:
    if function is not None and not isinstance(function, Function):
        raise TypeError(f"filter() takes a function, not {shown(function)}")
    found = budget.collect(values)
    return [each for each in found if (function.apply(budget, (each,), {}) if function else each)]


def _dict(budget: Budget, pairs: Any = (), **named: Any) -> dict[Any, Any]:
    if isinstance(pairs, Mapping):
        pairs = pairs.items()
    found = [tuple(budget.collect(pair)) for pair in budget.collect(pairs)]
    budget.unique([pair[0] for pair in found if pair])
    return {**dict(found), **named}


def _join(budget: Budget, text: str, parts: Iterable[str]) -> str:
    found = budget.collect(parts)
    budget.room(sum(len(part) for part in found) + len(text) * len(found))
    return text.join(found)


def _searching(name: str) -> Callable[..., Any]:
    search = getattr(str, name)

    def call(budget: Budget, text: str, *arguments: Any, **named: Any) -> Any:
        for each in (*arguments, *named.values()):
            budget.search(text, each)
        return search(text, *arguments, **named)

    return call


def _replace(budget: Budget, text: str, old: str, new: str, count: int = -1) -> str:
    budget.room(len(text) + text.count(old) * len(new))
    return text.replace(old, new, count)


def _zfill(budget: Budget, text: str, width: int) -> str:
    budget.room(width)
    return text.zfill(width)


def _collector(kind: Callable[..., Any]) -> Callable[..., Any]:
    return lambda budget, values=(), **named: kind(budget.collect(values), **named)


def _named(functions: Mapping[str, Callable[..., Any]], *, counts: bool = False) -> dict[str, Function]:
    return {name: Function(name, function, counts=counts) for name, function in functions.items()}


FUNCTIONS: Mapping[str, Function] = MappingProxyType(
    {
        **_named({each.__name__: each for each in (abs, all, any, bool, divmod, float, int, len, max, min, ord)}),
        **_named({"range": _range, "round": _round, "sum": _sum}),
        **_named({each.__name__: _collector(each) for each in (list, sorted, tuple)}, counts=True),
        **_named({"dict": _dict, "filter": _filter, "map": _map}, counts=True),
        **_named(
            {
                "enumerate": lambda budget, values, start=0: list(enumerate(budget.collect(values), start)),
                "repr": lambda budget, value: repr(budget.made(value)),
                "reversed": lambda budget, values: budget.collect(values)[::-1],
                "set": lambda budget, values=(): set(budget.unique(budget.collect(values))),
                "str": lambda budget, value="": str(budget.made(value)),
                "zip": lambda budget, *values: list(zip(*map(budget.collect, values), strict=False)),
            },
            counts=True,
        ),
    }
)
"""The Python functions that an expression may call."""

_OF_MATH = (
    "acos acosh asin asinh atan atan2 atanh ceil copysign cos cosh degrees dist erf erfc exp expm1 fabs floor fmod "
    "frexp fsum gamma gcd hypot isclose isfinite isinf isnan isqrt ldexp lgamma log log10 log1p log2 modf pow radians "
    "remainder sin sinh sqrt tan tanh trunc"
)
MATH: Mapping[str, Any] = MappingProxyType(
    {
        **_named({name: getattr(math, name) for name in _OF_MATH.split()}),
        **_named({"factorial": _factorial}),
        **{name: getattr(math, name) for name in ("e", "inf", "nan", "pi", "tau")},
    }
)
"""The names of Python's ``math`` that an expression may use."""

_OF_TEXTS = (
    "capitalize count endswith find index isalnum isalpha isdecimal isdigit islower isnumeric isspace isupper lower "
    "lstrip partition removeprefix removesuffix rfind rindex rpartition rsplit rstrip split splitlines startswith "
    "strip swapcase title upper"
)
_SEARCHING = "lstrip rfind rindex rpartition rsplit rstrip strip"
"""Methods that may compare each character of a text with each character of their argument."""
_COUNTING = _named(
    {"join": _join, "replace": _replace, "zfill": _zfill, **{name: _searching(name) for name in _SEARCHING.split()}},
    counts=True,
)
METHODS: Mapping[type, Collection[str]] = MappingProxyType(
    {
        str: frozenset(_OF_TEXTS.split()) | _COUNTING.keys(),
        list: frozenset({"count", "index"}),
        tuple: frozenset({"count", "index"}),
        dict: frozenset({"get", "items", "keys", "values"}),
    }
)
"""The methods that may be called, by type. They do not modify anything."""


def method(kind: type, name: str, methods: Mapping[type, Collection[str]]) -> Function | None:
    """Return a method of a type if it may be called, or None."""
    for base in kind.__mro__:
        if name in methods.get(base, ()):
            return _COUNTING[name] if base is str and name in _COUNTING else Function(name, getattr(base, name))
    return None
