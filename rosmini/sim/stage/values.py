"""From the properties of an entity to numbers and words, checked, in metres and radians."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

from rosmini.errors import nearest

from .errors import Place, StageError
from .parse import Entity, Property

DEGREE = math.pi / 180

UNITS = {"m": 1.0, "cm": 0.01, "mm": 0.001}
ANGLES = {"degrees": DEGREE, "radians": 1.0}


@dataclass
class Units:
    """What a number in the file stands for, and what there is to say about the file."""

    length: float = 1.0
    angle: float = DEGREE
    _notes: dict[str, list[str]] = field(default_factory=dict)

    def note(self, place: Place, what: str, who: str = "") -> None:
        """Remember what is left out or not as it looks; in `what`, {} stands for the name of `who` it is said of."""
        self._notes.setdefault(what, []).append(f"{place}: {what.replace('{}', who)}")

    @property
    def notes(self) -> tuple[str, ...]:
        """All notes, each once, with the place where it was found first, and how often it was found."""
        return tuple(
            found[0] if len(found) == 1 else f"{found[0]} ({len(found)} times in this world)"
            for found in self._notes.values()
        )


class Reader:
    """Reads the properties of one entity. Each method raises `StageError` for a value of another kind."""

    def __init__(self, entity: Entity, units: Units) -> None:
        self.entity = entity
        self.units = units
        self.read: set[str] = set()

    def find(self, name: str) -> Property | None:
        """The property of this name, if it is there."""
        self.read.add(name)
        return self.entity.properties.get(name)

    def place(self, name: str) -> Place:
        """Where a property stands; if it is not there, where the entity does."""
        found = self.entity.properties.get(name)
        return found.place if found else self.entity.place

    def text(self, name: str, default: str, choices: Sequence[str] = ()) -> str:
        """A string, one of the `choices` if there are any."""
        found = self.find(name)
        if found is None:
            return default
        if len(found.values) != 1 or not isinstance(found.values[0], str):
            raise StageError(found.place, f"{name} needs a string in double quotes, not {_shown(found)}")
        value = found.values[0]
        if choices and value not in choices:
            hint = nearest(value, choices)
            options = " or ".join(f'"{choice}"' for choice in choices)
            raise StageError(
                found.place, f'{name} is "{value}"; it has to be {options}{"; " + hint if hint else ""}'
            )
        return value

    def number(
        self, name: str, default: float, *, minimum: float | None = None, above: float | None = None
    ) -> float:
        """A number, at least the `minimum`, or more than `above`."""
        found = self.find(name)
        if found is None:
            return default
        if len(found.values) != 1 or not isinstance(found.values[0], float):
            raise StageError(found.place, f"{name} needs a number, not {_shown(found)}")
        value = found.values[0]
        if minimum is not None and value < minimum:
            raise StageError(found.place, f"{name} is {value:g}; it has to be at least {minimum:g}")
        if above is not None and value <= above:
            raise StageError(found.place, f"{name} is {value:g}; it has to be more than {above:g}")
        return value

    def whole(self, name: str, default: int, *, minimum: int | None = None) -> int:
        """A whole number."""
        value = self.number(name, default, minimum=minimum)
        if value != int(value):
            raise StageError(self.place(name), f"{name} is {value:g}; it has to be a whole number")
        return int(value)

    def flag(self, name: str, *, default: bool) -> bool:
        """1 or 0."""
        return self.number(name, float(default)) != 0

    def length(self, name: str, default: float, *, minimum: float | None = None) -> float:
        """A length [m]."""
        value = self.number(name, default / self.units.length, minimum=minimum)
        return value * self.units.length

    def angle(self, name: str, default: float) -> float:
        """An angle [rad]."""
        return self.number(name, default / self.units.angle) * self.units.angle

    def several(self, name: str, kinds: str, default: Sequence[float]) -> tuple[float, ...]:
        """Numbers in brackets, one for each letter: l a length [m], a an angle [rad], f a number as it is.

        If there are fewer, the rest is that of `default`, as in Stage.
        """
        found = self.find(name)
        if found is None:
            return tuple(default)
        if not found.bracketed:
            raise StageError(
                found.place, f"{name} needs {len(kinds)} numbers in brackets, not {_shown(found)}"
            )
        if not 0 < len(found.values) <= len(kinds):
            msg = f"{name} has {len(found.values)} values in its brackets; it needs {len(kinds)}"
            raise StageError(found.place, msg)
        scale = {"l": self.units.length, "a": self.units.angle, "f": 1.0}
        values = []
        for kind, value in zip(kinds, found.values, strict=False):
            if not isinstance(value, float):
                raise StageError(found.place, f'{name} holds numbers, not "{value}"')
            values.append(value * scale[kind])
        if len(values) < len(kinds):
            what = f"{name} has {len(values)} of its {len(kinds)} numbers; the others are taken as they are by default"
            self.units.note(found.place, what)
        return (*values, *default[len(values) :])

    def done(self, known: Sequence[str]) -> None:
        """Note the properties that nobody has read and that Stage does not know either."""
        for name, found in self.entity.properties.items():
            if name in self.read or name in known:
                continue
            hint = nearest(name, [*self.read, *known])
            title = self.entity.title or "the world"
            what = f"{name} is no property of {title} that is known here, and is left out{'; ' + hint if hint else ''}"
            self.units.note(found.place, what)


def _shown(found: Property) -> str:
    values = " ".join(f'"{value}"' if isinstance(value, str) else f"{value:g}" for value in found.values)
    return f"[{values}]" if found.bracketed else values


def units_of(root: Entity) -> Units:
    """What lengths and angles of a world file are in. Raises `StageError`."""
    units = Units()
    reader = Reader(root, units)
    units.length = UNITS[reader.text("unit_length", "m", tuple(UNITS))]
    units.angle = ANGLES[reader.text("unit_angle", "degrees", tuple(ANGLES))]
    return units
