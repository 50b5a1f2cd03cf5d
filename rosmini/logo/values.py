"""Logo's two kinds of values: words, of which numbers are some, and lists; how they are read, compared and written."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Any, TypeAlias

from .errors import BadInput, LogoError

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

LARGEST = 1_000_000
"""How many characters and members a value may have, all told."""

DEEPEST = 100
"""How deep brackets may be nested."""

EXACT = 2**53
"""Whole numbers beyond it are rounded, as all numbers in UCBLogo's floating point are."""

NUMBER = re.compile(r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]{1,3})?")

TRUE, FALSE = "true", "false"


class LogoList:
    """An immutable list; where it was written in a program, ``lines`` are its members' lines.

    Raises ``LogoError`` for one that is too large, or nested too deep.
    """

    __slots__ = ("cache", "depth", "items", "lines", "weight")

    def __init__(self, items: Iterable[Value] = (), lines: tuple[int, ...] | None = None) -> None:
        self.items: tuple[Value, ...] = tuple(items)
        self.lines = lines
        self.depth: int = 1 + max(
            (item.depth for item in self.items if isinstance(item, LogoList)), default=0
        )
        self.weight: int = 1 + sum(weight(item) for item in self.items)
        self.cache: Any = None
        """What the list is as a program: see `rosmini.logo.compiler`."""
        self._check()

    def _check(self) -> None:
        if self.depth > DEEPEST:
            raise LogoError(f"lists are nested more than {DEEPEST} deep")
        if self.weight > LARGEST:
            raise LogoError(f"a list has more than {LARGEST} members and letters")

    def __add__(self, other: LogoList) -> LogoList:
        """The members of both, without a look at each: a list that grows by one member costs no more than a copy."""
        made = LogoList.__new__(LogoList)
        made.items, made.lines, made.cache = self.items + other.items, None, None
        made.depth, made.weight = max(self.depth, other.depth), self.weight + other.weight - 1
        made._check()
        return made

    def without(self, place: int) -> LogoList:
        """All members but the first (0) or the last (-1)."""
        gone = self.items[place]
        if isinstance(gone, LogoList):
            return LogoList(self.items[1:] if place == 0 else self.items[:-1])
        made = LogoList.__new__(LogoList)
        made.items, made.lines, made.cache = self.items[1:] if place == 0 else self.items[:-1], None, None
        made.depth, made.weight = self.depth, self.weight - weight(gone)
        return made

    def __len__(self) -> int:
        return len(self.items)

    def __iter__(self) -> Iterator[Value]:
        return iter(self.items)

    def __repr__(self) -> str:
        return show(self)


Value: TypeAlias = str | int | float | LogoList


def weight(value: Value) -> int:
    """How many members and characters a value has."""
    return value.weight if isinstance(value, LogoList) else len(value) + 1 if isinstance(value, str) else 1


def number_in(value: Value) -> int | float | None:
    """The number that a word is, or None."""
    if isinstance(value, int | float):
        return value
    if isinstance(value, LogoList) or len(value) > 400 or not NUMBER.fullmatch(value):
        return None
    try:
        return tidy(int(value))
    except ValueError:
        found = float(value)
        return found if math.isfinite(found) else None


def number(value: Value, wanted: str = "a number") -> int | float:
    """The number that a word is. Raises ``BadInput``."""
    if type(value) is int or type(value) is float:
        return value
    found = number_in(value)
    if found is None:
        raise BadInput(show(value), wanted)
    return found


def whole(value: Value, least: int | None = None, most: int = EXACT, wanted: str = "a whole number") -> int:
    """The whole number that a word is. Raises ``BadInput``, also where it is out of bounds."""
    found = number(value, wanted)
    if found != int(found) or (least is not None and found < least) or abs(found) > most:
        raise BadInput(show(value), wanted)
    return int(found)


def tidy(value: float) -> int | float:
    """A result of arithmetic. Raises ``LogoError`` where it is no number that Logo has."""
    if isinstance(value, int):
        return value if -EXACT <= value <= EXACT else tidy(_float(value))
    if not math.isfinite(value):
        raise LogoError("the result is too large for a number")
    return value


def _float(value: int) -> float:
    try:
        return float(value)
    except OverflowError:
        return math.inf


def word(value: Value, wanted: str = "a word") -> str:
    """The text of a word. Raises ``BadInput`` for a list."""
    if isinstance(value, LogoList):
        raise BadInput(show(value), wanted)
    return value if isinstance(value, str) else write(value)


def as_list(value: Value, wanted: str = "a list") -> LogoList:
    """Return a list. Raises ``BadInput`` for a word."""
    if not isinstance(value, LogoList):
        raise BadInput(show(value), wanted)
    return value


def truth(value: Value) -> bool:
    """What is true or false. Raises ``BadInput`` for anything else."""
    folded = value.lower() if isinstance(value, str) else value
    if folded == TRUE:
        return True
    if folded == FALSE:
        return False
    raise BadInput(show(value), "true or false")


def boolean(value: bool) -> str:
    """The word for it."""
    return TRUE if value else FALSE


def is_equal(first: Value, second: Value) -> bool:
    """Whether two values are equal: numbers by value, other words without regard to case, lists member by member."""
    if isinstance(first, LogoList) or isinstance(second, LogoList):
        if not (isinstance(first, LogoList) and isinstance(second, LogoList)) or len(first) != len(second):
            return False
        return first is second or all(map(is_equal, first, second))
    a, b = number_in(first), number_in(second)
    if a is not None and b is not None:
        return a == b
    return word(first).lower() == word(second).lower()


def write(value: Value) -> str:
    """A value as `print` writes it: a list without its outer brackets, a number with at most 15 digits."""
    if isinstance(value, str):
        return value
    if isinstance(value, LogoList):
        return " ".join(show(item) for item in value)
    if isinstance(value, int) or (value == int(value) and abs(value) < 1e15):
        return str(int(value))
    return f"{value:.15g}"


def show(value: Value) -> str:
    """A value as `show` writes it: a list with its brackets.

    >>> show(LogoList(["a", LogoList([1, 0.5])]))
    '[a [1 0.5]]'
    """
    return f"[{write(value)}]" if isinstance(value, LogoList) else write(value)
