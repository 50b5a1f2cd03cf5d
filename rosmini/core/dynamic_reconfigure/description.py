"""Descriptions of reconfigurable parameters, with types, ranges and levels, in groups.

A :class:`Description` is made from the module generated from a ``.cfg`` file (its ``config_description``, or that
dictionary itself: http://wiki.ros.org/dynamic_reconfigure/Tutorials), or from a node's typed parameters,
:class:`rosmini.core.parameters.Parameters`.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, fields, replace
from typing import Any

from rosmini.core.errors import RosminiError, nearest
from rosmini.core.parameters import Parameters, declared_fields, is_scalar, limited_value


class DynamicReconfigureException(RosminiError):
    """Base class of dynamic_reconfigure's errors."""


class DynamicReconfigureParameterException(DynamicReconfigureException):
    """There is no such parameter or group, the value is not allowed, or the description is wrong."""


class DynamicReconfigureCallbackException(DynamicReconfigureException):
    """The callback of a server failed or was misused, or a client's service call failed."""


KINDS: dict[str, type] = {"bool": bool, "int": int, "str": str, "double": float}
"""dynamic_reconfigure's type names, with the Python types."""
_RANGES: dict[str, tuple[Any, Any, Any]] = {
    "bool": (False, False, True),
    "int": (0, -(2**31), 2**31 - 1),
    "str": ("", "", ""),
    "double": (0.0, -math.inf, math.inf),
}
"""Default, minimum and maximum of each type, for descriptions that omit them."""


def cast_value(name: str, kind: str, value: Any) -> Any:
    """Return ``value`` as the Python type of ``kind``.

    An int is accepted as a double, and a scalar of numpy as one of Python. Raises
    ``DynamicReconfigureParameterException`` for a value of another type or an int of more than 32 bits.
    """
    if hasattr(value, "tolist"):
        value = value.tolist()
    if kind == "double" and isinstance(value, int) and not isinstance(value, bool):
        return float(value)
    python: type = KINDS[kind]
    if type(value) is not python:
        raise DynamicReconfigureParameterException(
            f"parameter {name} has the type {kind} and cannot be set to the {type(value).__name__} {value!r}"
        )
    if isinstance(value, int) and not -(2**31) <= value < 2**31:
        raise DynamicReconfigureParameterException(f"parameter {name}: {value} does not fit into the 32 bits of an int")
    return value


@dataclass(frozen=True)
class ReconfigurableParameter:
    """One parameter: ``type`` is bool, int, str or double, ``level`` is a bit mask.

    The callback receives the bitwise OR of the levels of all changed parameters. Several parameters may share a bit:
    ``level & bit`` is non-zero if at least one of them changed.

    ``edit_method`` is the text of a dictionary for user interfaces (an enumeration), or empty.
    """

    name: str
    type: str
    level: int
    description: str
    default: Any
    min: Any
    max: Any
    edit_method: str = ""

    def clamp(self, value: Any) -> Any:
        """Return ``value`` limited to the range.

        An empty text as a bound means no limit, as in ROS.
        """
        low, high = (None if bound == "" else bound for bound in (self.min, self.max))
        return limited_value(value, low, high)

    def as_dict(self) -> dict[str, Any]:
        """Return the dictionary that describes the parameter to clients."""
        return {each.name: getattr(self, each.name) for each in fields(self)}


@dataclass(frozen=True)
class ParameterGroup:
    """A group of parameters, with subgroups.

    ``type`` determines how user interfaces show it (``collapse``, ``tab``, ``hide``...).
    """

    name: str
    type: str = ""
    state: bool = True
    id: int = 0
    parent: int = 0
    parameters: tuple[ReconfigurableParameter, ...] = ()
    groups: tuple[ParameterGroup, ...] = ()

    def walk(self) -> Iterator[ParameterGroup]:
        """Yield this group and all its subgroups, parents first."""
        yield self
        for group in self.groups:
            yield from group.walk()


class Description:
    """All parameters of a server. ``root`` is the outermost group, number 0.

    Raises ``DynamicReconfigureParameterException`` for a duplicate name or group number.
    """

    def __init__(self, root: ParameterGroup) -> None:
        self.root = root
        self.groups = tuple(root.walk())
        self.parameters = tuple(parameter for group in self.groups for parameter in group.parameters)
        self._by_name = {parameter.name: parameter for parameter in self.parameters}
        counted: tuple[tuple[str, list[Any]], ...] = (
            ("parameter", [parameter.name for parameter in self.parameters]),
            ("group", [group.name for group in self.groups]),
            ("group number", [group.id for group in self.groups]),
        )
        for what, names in counted:
            twice = sorted({str(name) for name in names if names.count(name) > 1})
            if twice:
                raise DynamicReconfigureParameterException(
                    f"the description has the {what} {', '.join(twice)} more than once: give each its own"
                )

    def __getitem__(self, name: str) -> ReconfigurableParameter:
        """Return the parameter ``name``. Raises ``DynamicReconfigureParameterException`` if there is none."""
        try:
            return self._by_name[name]
        except KeyError:
            hint = nearest(name, self._by_name) or f"the parameters are {', '.join(self._by_name) or 'none at all'}"
            raise DynamicReconfigureParameterException(f"there is no parameter {name!r}; {hint}") from None

    def group(self, name: str) -> ParameterGroup:
        """Return the group ``name``. Raises ``DynamicReconfigureParameterException`` if there is none."""
        for group in self.groups:
            if group.name == name:
                return group
        names = [group.name for group in self.groups]
        hint = nearest(name, names) or f"the groups are {', '.join(names)}"
        raise DynamicReconfigureParameterException(f"there is no group {name!r}; {hint}")

    @property
    def defaults(self) -> dict[str, Any]:
        """Default of each parameter."""
        return {parameter.name: parameter.default for parameter in self.parameters}

    @property
    def min(self) -> dict[str, Any]:
        """Minimum of each parameter."""
        return {parameter.name: parameter.min for parameter in self.parameters}

    @property
    def max(self) -> dict[str, Any]:
        """Maximum of each parameter."""
        return {parameter.name: parameter.max for parameter in self.parameters}

    @classmethod
    def of(cls, source: Any) -> Description:
        """Return a description made from a ``.cfg`` module, its dictionary, or a class of typed parameters.

        A description is returned unchanged. Raises ``DynamicReconfigureParameterException`` for any other source, and
        if the source is invalid.
        """
        if isinstance(source, Description):
            return source
        if isinstance(source, Mapping):
            return cls(_group_of(source, _Numbers()))
        tree = getattr(source, "config_description", None)
        if isinstance(tree, Mapping):
            return cls(_with_module_values(_group_of(tree, _Numbers()), source))
        if isinstance(source, type) and issubclass(source, Parameters):
            return cls(_group_of_fields(source))
        raise DynamicReconfigureParameterException(
            f"{source!r} does not describe parameters: give the module of a .cfg file (with config_description), such "
            "a dictionary, or a class derived from Parameters"
        )


class _Numbers:
    """Assigns ids to groups that have none."""

    def __init__(self) -> None:
        self.next = 0

    def take(self, given: Any) -> int:
        number = self.next if given is None else int(given)
        self.next = max(self.next, number) + 1
        return number


def _group_of(tree: Mapping[str, Any], numbers: _Numbers, parent: int = 0) -> ParameterGroup:
    try:
        number = numbers.take(tree.get("id"))
        return ParameterGroup(
            name=str(tree.get("name", "Default")),
            type=str(tree.get("type", "")),
            state=bool(tree.get("state", True)),
            id=number,
            parent=parent,
            parameters=tuple(_parameter(**_known_items(one)) for one in tree["parameters"]),
            groups=tuple(_group_of(one, numbers, number) for one in tree.get("groups", ())),
        )
    except (KeyError, TypeError, AttributeError) as error:
        raise DynamicReconfigureParameterException(
            f"the description of the group {tree.get('name', 'Default')!r} does not have dynamic_reconfigure's form: "
            f"{type(error).__name__}: {error}"
        ) from error


def _known_items(one: Mapping[str, Any]) -> dict[str, Any]:
    """Return the items of a parameter's dictionary that we use; it also contains file lines and C++ types."""
    return {each.name: one[each.name] for each in fields(ReconfigurableParameter) if each.name in one}


def filled_parameter(
    name: str,
    type: str,
    level: int = 0,
    description: str = "",
    default: Any = None,
    min: Any = None,
    max: Any = None,
    edit_method: str = "",
) -> ReconfigurableParameter:
    """Return a parameter; a default, minimum or maximum of None is replaced by that of the type.

    The default may be out of range. Raises ``DynamicReconfigureParameterException`` for an unknown type, and for a
    value that is not of that type.
    """
    if type not in KINDS:
        hint = nearest(str(type), KINDS) or f"types are {', '.join(KINDS)}"
        raise DynamicReconfigureParameterException(f"parameter {name} has the type {type!r}; {hint}")
    given = zip((default, min, max), _RANGES[type], strict=True)
    values = [otherwise if value is None else cast_value(name, type, value) for value, otherwise in given]
    return ReconfigurableParameter(name, type, level, description, values[0], values[1], values[2], edit_method)


def _parameter(*args: Any, **named: Any) -> ReconfigurableParameter:
    made = filled_parameter(*args, **named)
    if made.clamp(made.default) != made.default:
        raise DynamicReconfigureParameterException(
            f"parameter {made.name}: its default {made.default!r} is not in its range, {made.min!r} ... {made.max!r}"
        )
    return made


def _with_module_values(group: ParameterGroup, module: Any) -> ParameterGroup:
    """Return the group with a module's ``defaults``, ``min`` and ``max``, which the program may have changed."""
    tables = [
        (field, getattr(module, table, {}))
        for field, table in (("default", "defaults"), ("min", "min"), ("max", "max"))
    ]

    def changed(one: ReconfigurableParameter) -> ReconfigurableParameter:
        values = {
            field: cast_value(one.name, one.type, table[one.name]) for field, table in tables if one.name in table
        }
        return replace(one, **values)

    return replace(
        group,
        parameters=tuple(map(changed, group.parameters)),
        groups=tuple(_with_module_values(inner, module) for inner in group.groups),
    )


_KIND_OF = {python: kind for kind, python in KINDS.items()}


def _enumeration(choices: tuple[str, ...], meaning: str) -> str:
    """Return the ``edit_method`` of a string parameter with these choices, as generated from ``.cfg`` files."""
    constants = [
        {"name": each, "type": "str", "value": each, "description": "", "ctype": "std::string"} for each in choices
    ]
    return repr({"enum": constants, "enum_description": meaning})


def _group_of_fields(source: type[Parameters]) -> ParameterGroup:
    """Return the declared parameters of a class, without namespaces and lists, which are read only at start-up."""
    members: dict[str, list[ReconfigurableParameter]] = {}
    for declared, python in declared_fields(source):
        about = declared.metadata
        if not is_scalar(python):
            continue
        kind = _KIND_OF.get(python)
        if kind is None:
            raise DynamicReconfigureParameterException(
                f"{source.__name__}.{declared.name} may be {python}; a reconfigurable parameter is one of "
                f"{', '.join(one.__name__ for one in _KIND_OF)}, and cannot be None"
            )
        bounds = [None if about[bound] is None else KINDS[kind](about[bound]) for bound in ("minimum", "maximum")]
        unit = f" [{about['unit']}]" if about["unit"] else ""
        made = _parameter(
            declared.name,
            kind,
            about["level"],
            about["meaning"] + unit,
            declared.default,
            bounds[0],
            bounds[1],
            _enumeration(about["choices"], about["meaning"]) if about["choices"] else "",
        )
        members.setdefault(about["group"], []).append(made)
    names: Iterable[str] = (name for name in members if name)
    inner = tuple(
        ParameterGroup(name, id=number, parameters=tuple(members[name])) for number, name in enumerate(names, 1)
    )
    return ParameterGroup("Default", parameters=tuple(members.get("", ())), groups=inner)
