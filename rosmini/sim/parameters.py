"""Parameters of a node, declared once: name, type, default, range, unit and meaning.

>>> @dataclass(frozen=True)
... class Settings(Parameters):
...     rate: float = parameter(10.0, "how often to look", unit="Hz", minimum=0.0)
>>> Settings.table()
[('~rate', 'float', '10.0', '0.0 ...', 'Hz', 'how often to look')]

`Settings.read(node)` takes them from the node's private namespace on the Parameter Server (http://wiki.ros.org/Parameter%20Server).
"""

from __future__ import annotations

from dataclasses import Field, dataclass, field, fields
from typing import TYPE_CHECKING, Any, ClassVar, Self, get_args, get_type_hints

from rosmini.errors import ParameterError, nearest

if TYPE_CHECKING:
    from rosmini.graph import Node


def parameter(
    default: Any,
    meaning: str,
    *,
    unit: str = "",
    minimum: float | None = None,
    maximum: float | None = None,
    choices: tuple[str, ...] = (),
    level: int = 0,
    group: str = "",
) -> Any:
    """One parameter of a class derived from `Parameters`; its name and its type are those of the field. Without `choices` any text will do.

    `level` and `group` are for those that are changed while the node runs: see `rosmini.dynamic_reconfigure`.
    """
    about = {"meaning": meaning, "unit": unit, "minimum": minimum, "maximum": maximum, "choices": choices}
    return field(default=default, metadata={**about, "level": level, "group": group})


@dataclass(frozen=True)
class Parameters:
    """The base of a node's parameters; a field's type is bool, int, float or str, or one of these or None for one that may be missing."""

    allowed: ClassVar[tuple[str, ...]] = ()
    """Private names that may be set beside the parameters, because somebody else reads them."""

    @classmethod
    def read(cls, node: Node, **given: Any) -> Self:
        """The parameters as they are set in the node's private namespace; `given` comes before what is set there.

        Raises `ParameterError`, which names the parameter, for a wrong type, a value out of range, and a name that is no parameter of the node. Such a
        name is deleted from the Parameter Server, where it would be in the way of the next attempt.
        """
        set_there = node.get_param("~", {})
        names = [declared.name for declared in fields(cls)]
        for name in set_there:
            if name not in names and name not in cls.allowed:
                hint = nearest(name, names)
                hint = f"did you mean ~{hint.removeprefix('did you mean ')}" if hint else _listing(names)
                node.delete_param("~" + name)
                msg = f"parameter {node.resolve_parameter('~' + name)}: the node {node.name} has no parameter ~{name}; {hint}"
                raise ParameterError(msg)
        types = get_type_hints(cls)
        values = {
            declared.name: _checked(node, declared, types[declared.name], set_there[declared.name])
            for declared in fields(cls)
            if declared.name in set_there
        }
        return cls(**{**values, **{name: value for name, value in given.items() if value is not None}})

    @classmethod
    def table(cls) -> list[tuple[str, str, str, str, str, str]]:
        """Name, type, default, range, unit and meaning of each parameter, in the order of their declaration."""
        types = get_type_hints(cls)
        rows = []
        for declared in fields(cls):
            low, high = declared.metadata["minimum"], declared.metadata["maximum"]
            span = ", ".join(declared.metadata["choices"])
            span = span if low is None and high is None else f"{_shown(low)} ... {_shown(high)}".strip()
            default = "" if declared.default is None else str(declared.default)
            rows.append(
                (
                    f"~{declared.name}",
                    _kinds(types[declared.name])[0].__name__,
                    default,
                    span,
                    declared.metadata["unit"],
                    declared.metadata["meaning"],
                )
            )
        return rows


def _checked(node: Node, declared: Field[Any], kind: Any, value: Any) -> Any:
    name = node.resolve_parameter("~" + declared.name)
    value = node.get_param(name, expect=_kinds(kind))
    choices = declared.metadata["choices"]
    if choices and value not in choices:
        hint = nearest(value, choices) or f"it has to be one of {', '.join(choices)}"
        raise ParameterError(f"parameter {name} ({declared.metadata['meaning']}) is {value!r}; {hint}")
    low, high = declared.metadata["minimum"], declared.metadata["maximum"]
    if (low is not None and value < low) or (high is not None and value > high):
        unit = declared.metadata["unit"]
        bounds = " and ".join(
            f"{word} {bound}" for word, bound in (("at least", low), ("at most", high)) if bound is not None
        )
        msg = f"parameter {name} ({declared.metadata['meaning']}) is {value}; it has to be {bounds}{' ' + unit if unit else ''}"
        raise ParameterError(msg)
    return value


def _kinds(kind: Any) -> tuple[type, ...]:
    return tuple(part for part in get_args(kind) or (kind,) if part is not type(None))


def _shown(bound: float | None) -> str:
    return "" if bound is None else str(bound)


def _listing(names: list[str]) -> str:
    return f"its parameters are {', '.join('~' + name for name in names)}"
