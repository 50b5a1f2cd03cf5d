"""What an expression may cost: counted before it is spent."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from typing import Any

from .errors import NotAllowed

__all__ = ["BITS", "LARGEST", "STEPS", "Budget", "weight"]

BITS = 4096
"""How large a whole number may become."""

LARGEST = 1_000_000
"""How many elements and characters, all told, a value may have that an expression makes."""

STEPS = 2_000_000
"""How many turns of loops, made elements and made characters an evaluation may cost."""

READ_AT_ONCE = 32
"""So many elements a function of Python's own reads while a loop makes one turn."""


_ATOMS = frozenset({bool, float, int, type(None)})
_HOLDERS = (list, tuple, dict, set)
_SIZED = (str, bytes, *_HOLDERS)


class Budget:
    """What evaluations may cost together, in steps. One is made for each evaluation that is given none."""

    __slots__ = ("left",)

    def __init__(self, steps: int = STEPS) -> None:
        self.left = steps

    def spend(self, steps: int) -> None:
        """Raises `NotAllowed` when nothing is left."""
        self.left -= steps
        if self.left < 0:
            raise NotAllowed("this would take too many steps")

    def read(self, value: Any) -> None:
        """Pay for a function of Python's own that looks at all of a value."""
        if type(value) in _ATOMS:  # most are, in loops
            return
        if isinstance(value, _HOLDERS):
            self.spend(weight(value) // READ_AT_ONCE)
        elif isinstance(value, Collection):
            self.spend(len(value) // READ_AT_ONCE)

    def made(self, value: Any) -> Any:
        """Pay for a value that was made, and return it. Raises `NotAllowed` if it is too large."""
        if isinstance(value, int):
            if value.bit_length() > BITS:
                raise NotAllowed(f"a whole number of more than {BITS} bits")
        elif isinstance(value, _SIZED):
            self.room(weight(value))
        return value

    def room(self, size: int) -> None:
        """Pay for a value that is going to be made of so many elements. Raises `NotAllowed` if it would be too large."""
        if size > LARGEST:
            raise NotAllowed(f"a value of more than {LARGEST} elements")
        self.spend(size)

    def collect(self, values: Iterable[Any]) -> list[Any]:
        """Make a list of what can be looped over."""
        if isinstance(values, Collection):
            self.room(len(values))
        return list(values)  # a loop of ours pays for itself


def weight(value: Any) -> int:
    """How many elements and characters a value has, all told; a little more than `LARGEST` if it is more."""
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
