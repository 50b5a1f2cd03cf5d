"""Reads the properties of an entity as validated numbers and words, in metres and radians."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field

from rosmini.core.errors import Hints, nearest

from .errors import Place, StageError
from .parse import Entity, Property, Value, leading_number

DEGREE = math.pi / 180

UNITS = {"m": 1.0, "cm": 0.01, "mm": 0.001}
ANGLES = {"degrees": DEGREE, "radians": 1.0}


@dataclass
class Units:
    """The units of numbers in the file, and remarks about the file."""

    length: float = 1.0
    angle: float = DEGREE
    left_out: Counter[str] = field(default_factory=Counter)
    """Short descriptions of what is left out of the world, with their counts."""
    hint: Hints = field(default_factory=Hints)
    _notes: dict[str, list[str]] = field(default_factory=dict)

    def note(self, place: Place, what: str, who: str = "", left_out: str = "", unquoted: str = "") -> None:
        """Record a difference from the file, or from Stage; `{}` in `what` is replaced by the name `who`.

        `left_out` is a short description of what is left out. `unquoted` replaces a note that quotes the file, for
        included files: see `StageError`.
        """
        if place.included:
            what, who = unquoted or what, "a model of this file"
            left_out = "something in an included file" if unquoted and left_out else left_out
        self._notes.setdefault(what, []).append(f"{place}: {what.replace('{}', who)}")
        if left_out:
            self.left_out[left_out] += 1

    @property
    def notes(self) -> tuple[str, ...]:
        """All notes, each once, with its first location and the number of occurrences."""
        return tuple(
            found[0] if len(found) == 1 else f"{found[0]} ({len(found)} times in this world)"
            for found in self._notes.values()
        )


class Reader:
    """Reads the properties of one entity, as leniently as Stage.

    Stage reads a number from any text that begins like one, and 0 from any other; it uses the first of several values,
    and the default for an unknown choice. Each such case adds a note.
    """

    def __init__(self, entity: Entity, units: Units) -> None:
        self.entity = entity
        self.units = units
        self.read: set[str] = set()

    def find(self, name: str) -> Property | None:
        """Return the property of this name, or None."""
        self.read.add(name)
        return self.entity.properties.get(name)

    def place(self, name: str) -> Place:
        """Return the location of a property, or that of the entity if it does not exist."""
        found = self.entity.properties.get(name)
        return found.place if found else self.entity.place

    def text(self, name: str, default: str, choices: Sequence[str] = ()) -> str:
        """Return a string; `default` if there is no such property, or if it is not one of the `choices`."""
        found = self.find(name)
        if found is None:
            return default
        value = self._first(found)
        if not isinstance(value, str):
            value = f"{value:g}"
        if choices and value not in choices:
            hint = nearest(value, choices)
            options = " or ".join(f'"{choice}"' for choice in choices)
            what = f'{name} is "{value}", and it must be {options}; "{default}" is used, as in Stage'
            self.units.note(
                found.place,
                f"{what}{'; ' + hint if hint else ''}",
                unquoted=f'{name} must be {options}; "{default}" is used, as in Stage',
            )
            return default
        return value

    def number(self, name: str, default: float, *, minimum: float | None = None, above: float | None = None) -> float:
        """Return a number, at least the `minimum`. Raises `StageError` if it is not more than `above`."""
        found = self.find(name)
        if found is None:
            return default
        value = self._number(found, self._first(found))
        if minimum is not None and value < minimum:
            self.units.note(found.place, f"{name} is {value:g}; {minimum:g} is used, the least that is possible")
            return minimum
        if above is not None and value <= above:
            raise StageError(found.place, f"{name} is {value:g}; it must be more than {above:g}")
        return value

    def whole(self, name: str, default: int, *, minimum: int | None = None) -> int:
        """Return a whole number; as in Stage decimals are ignored."""
        value = self.number(name, default, minimum=minimum)
        if value != int(value):
            self.units.note(self.place(name), f"{name} is {value:g}; as in Stage it is cut to {int(value)}")
        return int(value)

    def flag(self, name: str, *, default: bool) -> bool:
        """Return True if a number is 1 or more, or -1 or less."""
        return int(self.number(name, float(default))) != 0

    def length(self, name: str, default: float, *, minimum: float | None = None) -> float:
        """Return a length [m]."""
        value = self.number(name, default / self.units.length, minimum=minimum)
        return value * self.units.length

    def angle(self, name: str, default: float) -> float:
        """Return an angle [rad]."""
        return self.number(name, default / self.units.angle) * self.units.angle

    def several(self, name: str, kinds: str, default: Sequence[float]) -> tuple[float, ...]:
        """Return numbers in brackets, one for each letter: l a length [m], a an angle [rad], f a plain number.

        Missing ones are taken from `default`, as in Stage 4.1; additional ones are ignored.
        """
        found = self.find(name)
        if found is None:
            return tuple(default)
        scale = {"l": self.units.length, "a": self.units.angle, "f": 1.0}
        pairs = zip(kinds, found.values, strict=False)
        values = [self._number(found, value) * scale[kind] for kind, value in pairs]
        if len(found.values) < len(kinds):
            what = f"{name} has {len(values)} of its {len(kinds)} numbers; the others are taken as they are by default"
            self.units.note(found.place, what)
        elif len(found.values) > len(kinds):
            self.units.note(found.place, f"{name} has {len(found.values)} numbers; only the first {len(kinds)} count")
        return (*values, *default[len(values) :])

    def _first(self, found: Property) -> Value:
        """Return the value of a property with a single value. Raises `StageError` if it has none."""
        if not found.values:
            raise StageError(found.place, f"{found.name} needs a value, and there is none in its brackets")
        if len(found.values) > 1:
            self.units.note(found.place, f"{found.name} has {len(found.values)} values; only the first counts")
        return found.values[0]

    def _number(self, found: Property, value: Value) -> float:
        if isinstance(value, float):
            return value
        number, whole = leading_number(value)
        if not whole:
            self.units.note(
                found.place,
                f'{found.name} is "{value}", which Stage reads as the number {number:g}',
                unquoted=f"{found.name} is not a number; Stage reads it as {number:g}",
            )
        return number

    def done(self, known: Sequence[str]) -> None:
        """Add notes for properties that have not been read and that Stage does not know either."""
        for name, found in self.entity.properties.items():
            if name in self.read or name in known:
                continue
            hint = self.units.hint(name, [*self.read, *known])
            title = self.entity.title or "the world"
            what = f"{name} is no property of {title} that is known here, and is left out{'; ' + hint if hint else ''}"
            self.units.note(
                found.place,
                what,
                left_out=f"the property {name}",
                unquoted=f"a property that is not known here is left out{'; ' + hint if hint else ''}",
            )


def units_of(root: Entity) -> Units:
    """Return the units of the lengths and angles of a world file."""
    units = Units()
    reader = Reader(root, units)
    units.length = UNITS[reader.text("unit_length", "m", tuple(UNITS))]
    units.angle = ANGLES[reader.text("unit_angle", "degrees", tuple(ANGLES))]
    return units
