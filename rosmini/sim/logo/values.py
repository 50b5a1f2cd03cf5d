"""Values of Logo programs, which are words and lists, and the errors of a program."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator
from itertools import islice
from typing import Any, TypeAlias

from rosmini.core.errors import RosminiError, nearest

MAX_SIZE = 1_000_000
"""Maximum number of members and characters in a value."""

MAX_DEPTH = 100
"""Maximum nesting depth of brackets and of expressions."""

EXACT = 2**53
"""Integers beyond this become floating-point numbers, which is what all numbers of UCBLogo are."""

NUMBER = re.compile(r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]{1,3})?")


class LogoError(RosminiError):
    """A Logo program is invalid or failed: ``message``, in ``line`` (counted from 1) of ``procedure``."""

    def __init__(self, message: str, line: int | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.line = line
        self.procedure: str | None = None

    def __str__(self) -> str:
        where = [] if self.line is None else [f"line {self.line}"]
        where += [f"in {self.procedure}"] if self.procedure else []
        return f"{', '.join(where)}: {self.message}" if where else self.message


class LogoStopped(LogoError):
    """A Logo program reached one of its limits."""


class BadInput(LogoError):
    """A primitive does not accept a value; the interpreter adds the name of the primitive."""

    def __init__(self, given: Value, wanted: str) -> None:
        self.given, self.wanted = described(given), wanted
        super().__init__(f"{self.given} is not {wanted}")


def suggestion(name: str, known: Iterable[str]) -> str:
    """Return ``"; did you mean ...?"``, or an empty text."""
    guess = nearest(name, list(islice(known, 1000)))
    return f"; {guess}" if guess else ""


class LogoList:
    """An immutable list; ``lines`` has the line of each member if the list was written in a program.

    Raises ``LogoError`` for a list that is too large or nested too deeply.
    """

    __slots__ = ("depth", "items", "lines", "parsed", "weight")

    def __init__(self, items: Iterable[Value] = (), lines: tuple[int, ...] | None = None) -> None:
        self.items: tuple[Value, ...] = tuple(items)
        self.lines = lines
        inner = [item.depth for item in self.items if isinstance(item, LogoList)]
        self.depth: int = 1 + max(inner, default=0)
        self.weight: int = 1 + sum(map(weight, self.items))
        self.parsed: Any = None
        """The list as a program; see `rosmini.sim.logo.interpreter`."""
        if self.depth > MAX_DEPTH:
            raise LogoError(f"lists are nested more than {MAX_DEPTH} deep")
        if self.weight > MAX_SIZE:
            raise LogoError(f"a list has more than {MAX_SIZE} members and letters")

    def __repr__(self) -> str:
        return show(self)

    def __len__(self) -> int:
        return len(self.items)

    def __iter__(self) -> Iterator[Value]:
        return iter(self.items)


Value: TypeAlias = str | int | float | LogoList


def weight(value: Value) -> int:
    """Return the number of members and characters in a value."""
    return value.weight if isinstance(value, LogoList) else len(value) + 1 if isinstance(value, str) else 1


def number_in(value: Value) -> int | float | None:
    """Return the number that a word represents, or None."""
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
    """Return the number that a word represents. Raises ``BadInput``."""
    found = number_in(value)
    if found is None:
        raise BadInput(value, wanted)
    return found


def whole(value: Value, least: int, most: int = EXACT, wanted: str = "a whole number") -> int:
    """Return the integer that a word represents. Raises ``BadInput`` if it is out of range."""
    found = number(value, wanted)
    if found != int(found) or not least <= found <= most:
        raise BadInput(value, wanted)
    return int(found)


def tidy(value: float) -> int | float:
    """Check a result of arithmetic. Raises ``LogoError`` if it is not finite."""
    if isinstance(value, int):
        if abs(value) <= EXACT:
            return value
        value = float(value) if value.bit_length() <= 1023 else math.inf
    if not math.isfinite(value):
        raise LogoError("the result is too large for a number")
    return value


def word(value: Value, wanted: str = "a word") -> str:
    """Return the text of a word. Raises ``BadInput`` for a list."""
    if isinstance(value, LogoList):
        raise BadInput(value, wanted)
    return write(value)


def as_list(value: Value, wanted: str = "a list") -> LogoList:
    """Return the value as a list. Raises ``BadInput`` for a word."""
    if not isinstance(value, LogoList):
        raise BadInput(value, wanted)
    return value


def truth(value: Value) -> bool:
    """Return the truth value that a word represents. Raises ``BadInput``."""
    folded = value.lower() if isinstance(value, str) else value
    if folded not in ("true", "false"):
        raise BadInput(value, "true or false")
    return folded == "true"


def is_equal(first: Value, second: Value) -> bool:
    """Return True if two values are equal: numbers by value, other words ignoring case, lists member by member."""
    if isinstance(first, LogoList) or isinstance(second, LogoList):
        if not (isinstance(first, LogoList) and isinstance(second, LogoList)) or len(first) != len(second):
            return False
        return first is second or all(map(is_equal, first, second))
    a, b = number_in(first), number_in(second)
    if a is not None and b is not None:
        return a == b
    return write(first).lower() == write(second).lower()


def write(value: Value) -> str:
    """Return a value as `print` writes it: a list without its outer brackets, a number with at most 15 digits."""
    if isinstance(value, str):
        return value
    if isinstance(value, LogoList):
        return " ".join(map(show, value))
    if isinstance(value, int) or (value == int(value) and abs(value) < 1e15):
        return str(int(value))
    return f"{value:.15g}"


def show(value: Value) -> str:
    """Return a value as `show` writes it: a list with its brackets.

    >>> show(LogoList(["a", LogoList([1, 0.5])]))
    '[a [1 0.5]]'
    """
    return f"[{write(value)}]" if isinstance(value, LogoList) else write(value)


def described(value: Value) -> str:
    """Return a value for an error message, shortened."""
    text = show(value) or "the empty word"
    return text if len(text) <= 60 else text[:57] + "..."
