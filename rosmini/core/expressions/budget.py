"""The budget of an expression, charged in advance, and the errors of expressions."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from typing import Any

from rosmini.core.collisions import MAX_COLLISIONS, collide
from rosmini.core.errors import RosminiError

BITS = 4096
"""Maximum size of an integer [bits]."""

MAX_ELEMENTS = 1_000_000
"""Maximum total number of elements and characters in a value."""

STEPS = 2_000_000
"""Maximum number of loop iterations, new elements and new characters of one evaluation."""

STEPS_OF_A_FILE = 200_000
"""Initial budget for all expressions of a file together [steps]; each character adds `STEPS_OF_A_CHARACTER`."""

STEPS_OF_A_CHARACTER = 10

READ_AT_ONCE = 32
"""Number of elements that a built-in function reads in the time of one loop iteration."""

COMPARED_AT_ONCE = 1024
"""Number of characters that a built-in search compares in the time of one loop iteration."""

BITS_SQUARED = 1 << 18
"""Square of the size [bits] of two integers whose product takes as long as one loop iteration."""

_SHOWN = 60
_ATOMS = frozenset({bool, float, int, type(None)})
_VIEWS: tuple[Any, ...] = (type({}.keys()), type({}.values()), type({}.items()))
_HOLDERS: tuple[Any, ...] = (list, tuple, dict, set, *_VIEWS)
_NUMBERS = frozenset({bool, float, int})
_SMALL = 1 << 256
"""Integers of a smaller absolute value are not charged."""


class ExpressionError(RosminiError):
    """An expression is invalid or failed; ``__cause__`` is Python's error."""

    has_spot = False
    """True if the message already quotes the part of the expression that failed."""


class NotAllowed(ExpressionError):
    """An expression uses an unsupported feature, or would exceed its budget."""


class Budget:
    """The number of steps that some evaluations may still take. By default each evaluation has its own budget."""

    __slots__ = ("left",)

    def __init__(self, steps: int = STEPS) -> None:
        self.left = steps

    def earn(self, length: int) -> None:
        """Extend the budget for ``length`` characters of a file, so that a long file may take more steps."""
        self.left += STEPS_OF_A_CHARACTER * length

    def spend(self, steps: int) -> None:
        """Charge ``steps``. Raises `NotAllowed` when nothing is left."""
        self.left -= steps
        if self.left < 0:
            raise NotAllowed("this would take too many steps")

    def read(self, value: Any) -> None:
        """Charge for a built-in function that reads the whole value. Raises `NotAllowed` when nothing is left."""
        kind = type(value)
        if kind is int:
            if not -_SMALL < value < _SMALL:
                self.compute(value.bit_length())
        elif kind in _ATOMS:  # the usual case in loops
            return
        elif isinstance(value, _HOLDERS):
            self.spend(weight(value) // READ_AT_ONCE)
        elif isinstance(value, Collection):
            self.spend(len(value) // READ_AT_ONCE)

    def made(self, value: Any) -> Any:
        """Charge for a new value, and return it. Raises `NotAllowed` if it is too large."""
        if isinstance(value, int):
            if not -_SMALL < value < _SMALL:
                check_bits(value.bit_length())
                self.compute(value.bit_length())
        elif isinstance(value, (str, bytes, *_HOLDERS)):
            self.room(weight(value))
        return value

    def compute(self, bits: int) -> None:
        """Charge for arithmetic with integers of ``bits`` bits, which takes quadratic time."""
        self.spend(bits * bits // BITS_SQUARED)

    def search(self, text: Any, words: Any) -> None:
        """Charge for a built-in search in ``text`` for ``words``, which may compare every pair of characters."""
        if isinstance(text, str | bytes) and isinstance(words, str | bytes):
            self.spend(len(text) * len(words) // COMPARED_AT_ONCE)

    def unique(self, keys: Collection[Any]) -> Collection[Any]:
        """Return the keys of a set or dictionary. Raises `NotAllowed` if many of them have the same hash."""
        if collide(keys):
            raise NotAllowed(f"a set or a dictionary with more than {MAX_COLLISIONS} keys of the same hash")
        return keys

    def room(self, size: int) -> None:
        """Charge for a value of `size` elements before it is made. Raises `NotAllowed` if it would be too large."""
        if size > MAX_ELEMENTS:
            raise NotAllowed(f"a value of more than {MAX_ELEMENTS} elements")
        self.spend(size)

    def collect(self, values: Iterable[Any]) -> list[Any]:
        """Return a list of the elements of an iterable. Charge for a collection; other iterables charge themselves."""
        if isinstance(values, Collection):
            self.room(len(values))
        return list(values)  # loops in expressions are charged as they run


def check_bits(bits: int) -> None:
    """Raise `NotAllowed` for an integer of too many bits."""
    if bits > BITS:
        raise NotAllowed(f"a whole number of more than {BITS} bits")


def weight(value: Any) -> int:
    """Return the total number of elements and characters in a value, where large integers count by their digits.

    Counting stops above `MAX_ELEMENTS`.
    """
    total = 0
    waiting: list[Any] = [value]
    while waiting and total <= MAX_ELEMENTS:
        part = waiting.pop()
        if isinstance(part, (str, bytes)):
            total += len(part)
        elif isinstance(part, _HOLDERS):
            total += len(part)
            parts: tuple[Any, ...] = (part, part.values()) if isinstance(part, dict) else (part,)
            for items in parts:
                kinds = set(map(type, items))
                if not kinds <= _ATOMS:
                    waiting += items
                elif int in kinds and not (kinds <= _NUMBERS and min(items) > -_SMALL and max(items) < _SMALL):
                    total += sum(map(_digits, items))
        else:
            total += _digits(part)
    return total


def _digits(value: Any) -> int:
    return value.bit_length() // 3 if type(value) is int and not -_SMALL < value < _SMALL else 0


def cut(text: str) -> str:
    """Return a text of at most `_SHOWN` characters: the start of `text`, with "..." if it is longer."""
    return text if len(text) <= _SHOWN else text[: _SHOWN - 3] + "..."
