"""The budget of an expression, counted before it is spent, and the errors of expressions."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from typing import Any

from rosmini.errors import RosminiError

BITS = 4096
"""The size of the largest whole number."""

LARGEST = 1_000_000
"""How many elements and characters, all told, a value may have that an expression makes."""

STEPS = 2_000_000
"""How many turns of loops, made elements and made characters an evaluation may cost."""

READ_AT_ONCE = 32
"""How many elements one of Python's own functions reads while a loop makes one turn."""

_SHOWN = 60
_ATOMS = frozenset({bool, float, int, type(None)})
_HOLDERS = (list, tuple, dict, set)


class ExpressionError(RosminiError):
    """An expression is not valid, or it failed; ``__cause__`` is Python's error."""

    has_spot = False
    """Whether the message already names the part of the expression."""


class NotAllowed(ExpressionError):
    """An expression uses what a confined one may not use, or would cost more than it may."""


class Budget:
    """What evaluations may cost together, in steps. By default each evaluation has its own."""

    __slots__ = ("left",)

    def __init__(self, steps: int = STEPS) -> None:
        self.left = steps

    def spend(self, steps: int) -> None:
        """Raises `NotAllowed` when nothing is left."""
        self.left -= steps
        if self.left < 0:
            raise NotAllowed("this would take too many steps")

    def read(self, value: Any) -> None:
        """Pay for one of Python's own functions that looks at all of a value."""
        if type(value) in _ATOMS:  # most are, in loops
            return
        if isinstance(value, _HOLDERS):
            self.spend(weight(value) // READ_AT_ONCE)
        elif isinstance(value, Collection):
            self.spend(len(value) // READ_AT_ONCE)

    def made(self, value: Any) -> Any:
        """Pay for a value that was made, and return it. Raises `NotAllowed` if it is too large."""
        if isinstance(value, int):
            check_bits(value.bit_length())
        elif isinstance(value, (str, bytes, *_HOLDERS)):
            self.room(weight(value))
        return value

    def room(self, size: int) -> None:
        """Pay for a value of `size` elements before it is made. Raises `NotAllowed` if it would be too large."""
        if size > LARGEST:
            raise NotAllowed(f"a value of more than {LARGEST} elements")
        self.spend(size)

    def collect(self, values: Iterable[Any]) -> list[Any]:
        """Make a list of what can be looped over."""
        if isinstance(values, Collection):
            self.room(len(values))
        return list(values)  # a loop of ours pays for itself


def check_bits(bits: int) -> None:
    """Raises `NotAllowed` for a whole number of too many bits."""
    if bits > BITS:
        raise NotAllowed(f"a whole number of more than {BITS} bits")


def weight(value: Any) -> int:
    """How many elements and characters a value has, all told; slightly more than `LARGEST` if it is more."""
    total, waiting = 0, [value]
    while waiting and total <= LARGEST:
        part = waiting.pop()
        if isinstance(part, (str, bytes)):
            total += len(part)
        elif isinstance(part, _HOLDERS):
            total += len(part)
            for items in (part, part.values()) if isinstance(part, dict) else (part,):
                if not _ATOMS.issuperset(map(type, items)):
                    waiting += items
    return total


def cut(text: str) -> str:
    """A text, shortened if it is long."""
    return text if len(text) <= _SHOWN else text[: _SHOWN - 3] + "..."
