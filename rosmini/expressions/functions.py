"""The functions and methods that an expression may call."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping
from types import MappingProxyType
from typing import Any

from rosmini.errors import nearest, shown

from .budget import BITS, STEPS, Budget
from .errors import NotAllowed

__all__ = ["FUNCTIONS", "MATH", "METHODS", "Function", "Namespace", "method"]


class Function:
    """A function that expressions may call; nothing else can be called.

    ``call`` must be harmless whatever it is given: no access to files or attributes, and a result whose size is bounded by that of the
    arguments. If it `counts`, it is given the `Budget` first, and pays itself for more.
    """

    __slots__ = ("call", "counts", "name")

    def __init__(self, name: str, call: Callable[..., Any], *, counts: bool = False) -> None:
        self.name, self.call, self.counts = name, call, counts

    def __repr__(self) -> str:
        return f"<function {self.name}>"

    def apply(self, budget: Budget, arguments: Iterable[Any], named: Mapping[str, Any]) -> Any:
        """Call it, and pay for it."""
        for value in arguments:
            budget.read(value)
        first = (budget,) if self.counts else ()
        return budget.made(self.call(*first, *arguments, **named))


class Namespace:
    """Names with a dot before them: ``math.pi``."""

    __slots__ = ("members", "name")

    def __init__(self, name: str, members: Mapping[str, Any]) -> None:
        self.name, self.members = name, members

    def __repr__(self) -> str:
        return f"<names of {self.name}>"

    def member(self, name: str) -> Any:
        """What stands behind the dot."""
        if name not in self.members:
            hint = nearest(name, self.members)
            raise NameError(f"name '{self.name}.{name}' is not defined{f'; {hint}' if hint else ''}")
        return self.members[name]


def _text(budget: Budget, value: Any = "") -> str:
    budget.made(value)
    return str(value)


def _quoted(budget: Budget, value: Any) -> str:
    budget.made(value)
    return repr(value)


def _sum(values: Iterable[Any], start: Any = 0) -> Any:
    if isinstance(start, str | bytes | list | tuple):
        raise TypeError("sum() adds numbers")  # adding up lists takes the square of their length
    return sum(values, start)


def _round(value: Any, digits: int | None = None) -> Any:
    if digits is not None and abs(digits) > BITS:
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
    return {**dict(budget.collect(pairs)), **named}


def _join(budget: Budget, text: str, parts: Iterable[str]) -> str:
    found = budget.collect(parts)
    budget.room(sum(len(part) for part in found) + len(text) * len(found))
    return text.join(found)


def _replace(budget: Budget, text: str, old: str, new: str, count: int = -1) -> str:
    budget.room(len(text) + text.count(old) * len(new))
    return text.replace(old, new, count)


def _filled(budget: Budget, text: str, width: int) -> str:
    budget.room(width)
    return text.zfill(width)


def _collector(kind: Callable[[list[Any]], Any]) -> Callable[..., Any]:
    def collect(budget: Budget, values: Iterable[Any] = (), **named: Any) -> Any:
        return kind(budget.collect(values), **named)

    return collect


def _functions() -> dict[str, Function]:
    plain = (abs, all, any, bool, divmod, float, int, len, max, min, ord)
    counting: dict[str, Callable[..., Any]] = {
        **{kind.__name__: _collector(kind) for kind in (list, set, sorted, tuple)},
        "dict": _dict,
        "enumerate": lambda budget, values, start=0: list(enumerate(budget.collect(values), start)),
        "filter": _filter,
        "map": _map,
        "repr": _quoted,
        "reversed": lambda budget, values: budget.collect(values)[::-1],
        "str": _text,
        "zip": lambda budget, *values: list(zip(*map(budget.collect, values), strict=False)),
    }
    others = {"range": _range, "round": _round, "sum": _sum}
    return {
        **{function.__name__: Function(function.__name__, function) for function in plain},
        **{name: Function(name, function, counts=True) for name, function in counting.items()},
        **{name: Function(name, function) for name, function in others.items()},
    }


_OF_MATH = (
    "acos acosh asin asinh atan atan2 atanh ceil copysign cos cosh degrees dist erf erfc exp expm1 fabs floor fmod frexp fsum gamma gcd "
    "hypot isclose isfinite isinf isnan isqrt ldexp lgamma log log10 log1p log2 modf pow radians remainder sin sinh sqrt tan tanh trunc"
)

FUNCTIONS: Mapping[str, Function] = MappingProxyType(_functions())
"""Python's functions that an expression may call."""

MATH: Mapping[str, Any] = MappingProxyType(
    {
        **{name: Function(name, getattr(math, name)) for name in _OF_MATH.split()},
        "factorial": Function("factorial", _factorial),
        **{name: getattr(math, name) for name in ("e", "inf", "nan", "pi", "tau")},
    }
)
"""What an expression may use of Python's ``math``."""

_OF_TEXTS = (
    "capitalize count endswith find index isalnum isalpha isdecimal isdigit islower isnumeric isspace isupper lower lstrip partition "
    "removeprefix removesuffix rfind rindex rpartition rsplit rstrip split splitlines startswith strip swapcase title upper"
)

_COUNTING: dict[str, Callable[..., Any]] = {"join": _join, "replace": _replace, "zfill": _filled}

METHODS: Mapping[type, Collection[str]] = MappingProxyType(
    {
        str: frozenset(_OF_TEXTS.split()) | _COUNTING.keys(),
        list: frozenset({"count", "index"}),
        tuple: frozenset({"count", "index"}),
        dict: frozenset({"get", "items", "keys", "values"}),
    }
)
"""The methods that may be called, by the type of the value. They change nothing."""


def method(kind: type, name: str, methods: Mapping[type, Collection[str]]) -> Function | None:
    """The method of a type of values, if it may be called."""
    for base in kind.__mro__:
        if name in methods.get(base, ()):
            if base is str and name in _COUNTING:
                return Function(name, _COUNTING[name], counts=True)
            found: Callable[..., Any] = getattr(base, name)
            return Function(name, found)
    return None
