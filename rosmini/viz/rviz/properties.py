"""Properties of displays, views and tools, with RViz's names: type, default, range, and their form in a file.

In a `.rviz` file a property may contain others, and then its own value is under `Value`. Here such a property is
named by its path, `Line Style/Line Width`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from copy import deepcopy
from dataclasses import dataclass
from typing import Any, NamedTuple

from rosmini.core.errors import nearest

from .primitives import DisplayError, Floats


class Colour(NamedTuple):
    """Red, green and blue from 0 to 255; `255; 25; 0` in a file."""

    red: int
    green: int
    blue: int

    def rgba(self, alpha: float = 1.0) -> Floats:
        """Return the colour as four numbers from 0 to 1."""
        import numpy as np

        return np.array([self.red / 255, self.green / 255, self.blue / 255, alpha])


class Vector(NamedTuple):
    """Three numbers; in a file, a mapping with X, Y and Z."""

    x: float
    y: float
    z: float


class Tree(dict[str, Any]):
    """A mapping of a file that a display reads itself, such as the frames of TF."""

    def is_enabled(self, name: str) -> bool:
        """Return False if an entry is switched off, by itself or by its `Value`."""
        entry = self.get(name, True)
        return bool(entry.get("Value", True) if isinstance(entry, dict) else entry)


Value = bool | int | float | str | Colour | Vector | Tree


@dataclass(frozen=True)
class Property:
    """A property; its type is that of its default."""

    name: str
    default: Value
    meaning: str
    unit: str = ""
    minimum: float | None = None
    maximum: float | None = None
    choices: tuple[str, ...] = ()

    def value(self, given: Any) -> Value:
        """Return a value converted for this property; numbers outside the range become the nearest in it, as in RViz.

        Raises:
            DisplayError: it has another type, or is not one of the choices.

        """
        found = self._converted(given)
        if found is None:
            kind = type(self.default).__name__
            raise DisplayError(
                f"{self.name} is {given!r:.60}; it must be a {kind} such as {self.written(self.default)!r}"
            )
        if self.choices and found not in self.choices:
            hint = nearest(str(found), self.choices) or f"it must be one of {', '.join(self.choices)}"
            raise DisplayError(f"{self.name} is {found!r:.60}; {hint}")
        if isinstance(found, int | float) and not isinstance(found, bool):
            low = found if self.minimum is None else max(found, self.minimum)
            return type(found)(low if self.maximum is None else min(low, self.maximum))
        return found

    def _converted(self, given: Any) -> Value | None:
        default = self.default
        if isinstance(default, bool):
            return given if isinstance(given, bool) else None
        if isinstance(default, int | float):
            number = _number(given)
            return None if number is None else type(default)(number)
        if isinstance(default, Colour):
            return _colour(given)
        if isinstance(default, Vector):
            return _vector(given)
        if isinstance(default, Tree):
            return Tree(deepcopy(dict(given))) if isinstance(given, Mapping) else None
        return "" if given is None else None if isinstance(given, dict | list) else str(given)

    def written(self, value: Value) -> Any:
        """Return a value in the form that it has in a file."""
        if isinstance(value, Colour):
            return "; ".join(map(str, value))
        if isinstance(value, Vector):
            return dict(zip("XYZ", value, strict=True))
        return dict(value) if isinstance(value, Tree) else value


def _number(given: Any) -> float | None:
    if isinstance(given, bool) or not isinstance(given, int | float):
        return None
    return given if abs(given) < 1e15 and math.isfinite(given) else None


def _colour(given: Any) -> Colour | None:
    parts = given.split(";") if isinstance(given, str) else given
    try:
        red, green, blue = (int(part) for part in parts)
    except (TypeError, ValueError):
        return None
    return Colour(*(min(max(part, 0), 255) for part in (red, green, blue)))


def _vector(given: Any) -> Vector | None:
    if isinstance(given, Mapping):
        given = [given.get(axis, 0.0) for axis in "XYZ"]
    if not isinstance(given, list | tuple) or len(given) != 3:
        return None
    found = [_number(each) for each in given]
    return None if None in found else Vector(*(float(each) for each in found if each is not None))


class Properties:
    """The values of declared properties, and the rest of a file's mapping, which is preserved when it is saved."""

    def __init__(self, declared: tuple[Property, ...], tree: Mapping[str, Any] | None = None) -> None:
        self.declared = {each.name: each for each in declared}
        self._tree: dict[str, Any] = deepcopy(dict(tree or {}))
        self._values: dict[str, Value] = {each.name: each.default for each in declared}
        self.errors: list[str] = []
        """Errors in values of the file, in words."""
        for each in declared:
            written = self._find(each.name)
            if written is not _MISSING:
                try:
                    self._values[each.name] = each.value(written)
                except DisplayError as error:
                    self.errors.append(str(error))

    def __getitem__(self, name: str) -> Any:
        return self._values[self._known(name)]

    def __setitem__(self, name: str, given: Any) -> None:
        self._values[name] = self.declared[self._known(name)].value(given)

    def __contains__(self, name: object) -> bool:
        return name in self.declared

    def _known(self, name: str) -> str:
        if name not in self.declared:
            hint = nearest(name, self.declared) or f"there are {', '.join(self.declared)}"
            raise DisplayError(f"there is no property {name!r:.60}; {hint}")
        return name

    def unknown(self, besides: tuple[str, ...] = ()) -> list[str]:
        """Return the paths of undeclared properties of the file, sorted, except `besides`, which others read."""
        known = {*self.declared, *besides}
        groups = {name.rpartition("/")[0] for name in self.declared}
        return sorted(path for path in _paths(self._tree, "", groups, self.declared) if path not in known)

    def tree(self) -> dict[str, Any]:
        """Return the mapping for a file: its original contents, with the current values."""
        whole = deepcopy(self._tree)
        for name, declared in self.declared.items():
            *above, last = name.split("/")
            node = whole
            for part in above:
                there = node.get(part)
                node[part] = node = there if isinstance(there, dict) else {} if there is None else {"Value": there}
            written = declared.written(self._values[name])
            is_group = any(other.startswith(f"{name}/") for other in self.declared)
            if is_group or (isinstance(node.get(last), dict) and not isinstance(written, dict)):
                beneath = node.get(last)
                node[last] = {**(beneath if isinstance(beneath, dict) else {}), "Value": written}
            else:
                node[last] = written
        return whole

    def _find(self, name: str) -> Any:
        node: Any = self._tree
        for part in name.split("/"):
            if not isinstance(node, Mapping) or part not in node:
                return _MISSING
            node = node[part]
        if isinstance(node, Mapping) and not isinstance(self.declared[name].default, Vector | Tree):
            return node.get("Value", _MISSING)
        return node


_MISSING = object()


def _paths(tree: Mapping[str, Any], above: str, groups: set[str], declared: Mapping[str, Property]) -> Iterator[str]:
    for key, value in tree.items():
        path = f"{above}{key}"
        if path in groups and isinstance(value, Mapping):
            beneath = {name: each for name, each in value.items() if name != "Value"}
            yield from _paths(beneath, f"{path}/", groups, declared)
        elif path not in declared:
            yield path
