"""Typed parameters of a node, each declared once with name, type, default, range, unit and meaning.

>>> @dataclass(frozen=True)
... class Settings(Parameters):
...     rate: float = parameter(10.0, "how often to look", unit="Hz", minimum=0.0)
>>> Settings.table()
[('~rate', 'float', '10.0', '0.0 ...', 'Hz', 'how often to look')]

`Settings.read(node)` reads them from the Parameter Server (http://wiki.ros.org/Parameter%20Server).
`rosmini.core.dynamic_reconfigure` changes them while the node runs.

The type of a field is bool, int, float or str; `tuple[T, ...]` for a list; a class of parameters for a namespace or,
in a list, for dictionaries; or a union of these. If the type allows None, the default may be None.

Numbers are converted as in roscpp's `ros::param`: an int to a float, and a float to the nearest int. The
original nodes silently ignore a value of another type and use the default; here it is an error.
"""

from __future__ import annotations

import math
import types
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import Field, dataclass, field, fields
from typing import TYPE_CHECKING, Any, ClassVar, Self, Union, get_args, get_origin, get_type_hints

from rosmini.core.errors import ParameterError, nearest
from rosmini.core.graph.parameter_client import expected

if TYPE_CHECKING:
    from rosmini.core.graph import Node


def parameter(
    default: Any,
    meaning: str,
    *,
    unit: str = "",
    minimum: float | None = None,
    maximum: float | None = None,
    limits: tuple[float | None, float | None] = (None, None),
    choices: tuple[str, ...] = (),
    level: int = 0,
    group: str = "",
) -> Any:
    """Declare a parameter in a class derived from `Parameters`; the field gives its name and type.

    A `dynamic` class limits values to the range; in others, a value outside the range is an error. `limits` is a
    narrower range for a node whose original accepts values that would be useless or too costly here: values outside
    it are limited, with a warning. Ranges and choices of a list apply to its elements. Without `choices`, any text is
    allowed. `level` and `group` are used for parameters that change while the node runs: see
    `rosmini.core.dynamic_reconfigure`.
    """
    about = {"meaning": meaning, "unit": unit, "minimum": minimum, "maximum": maximum, "choices": choices}
    return field(default=default, metadata={**about, "limits": limits, "level": level, "group": group})


@dataclass(frozen=True)
class Place:
    """A namespace on the Parameter Server: its global name, its label for messages, and the name of the node."""

    name: str
    label: str
    owner: str
    warn: Callable[[str], object]
    """Called with the text of each warning."""

    def inside(self, name: str) -> Place:
        """Return a namespace inside this one."""
        return Place(f"{self.name}/{name}", f"{self.label}{name}/", self.owner, self.warn)


@dataclass(frozen=True)
class Parameters:
    """Base class of the parameters of a node: a frozen data class whose fields are declared with `parameter`."""

    allowed: ClassVar[tuple[str, ...]] = ()
    """Additional names that are allowed, because other code reads them."""

    strict: ClassVar[bool] = False
    """If True, an unknown name is an error; otherwise there is a warning, since the original nodes ignore the name."""

    dynamic: ClassVar[bool] = False
    """If True, a `Server` of dynamic_reconfigure offers the fields of this class: it limits values to their ranges,
    with a warning, and accepts any text. Subclasses do not inherit this."""

    shared: ClassVar[bool] = False
    """If True, every namespace inside this one may belong to other code, such as a plugin."""

    def others(self) -> Iterable[str]:
        """Return additional allowed names that depend on the values of parameters, such as those of plugins."""
        return ()

    @classmethod
    def read(cls, node: Node, namespace: str = "~", /, **given: Any) -> Self:
        """Return the parameters in a namespace, by default the node's private one, without changing the server.

        Values in `given` take precedence unless they are None. Raises `ParameterError`, which names the parameter,
        for a wrong type or value, and for an unknown name if the class is `strict`; otherwise the node logs a warning.
        """
        name = node.resolve_parameter(namespace)
        label = "~" if namespace == "~" else namespace.rstrip("/") + "/"
        values = _read(cls, node.get_param(name, {}), Place(name.rstrip("/"), label, node.name, node.logwarn))
        return cls(**{**values, **{name: value for name, value in given.items() if value is not None}})

    @classmethod
    def table(cls, label: str = "~") -> list[tuple[str, str, str, str, str, str]]:
        """Return a row for each parameter: name (with `label` before it), type, default, range, unit and meaning."""
        rows = []
        for declared, kind in declared_fields(cls):
            about = declared.metadata
            namespace = next((option for option in _options(kind) if _is_namespace(option)), None)
            if namespace is not None:
                rows += namespace.table(f"{label}{declared.name}/")
                continue
            low, high = _range(about)
            span = ", ".join(about["choices"])
            span = span if low is None and high is None else f"{_shown(low)} ... {_shown(high)}".strip()
            default = "" if declared.default is None else _listed(declared.default)
            rows.append((label + declared.name, _spelled(kind), default, span, about["unit"], about["meaning"]))
        return rows


def _read(cls: type[Parameters], tree: Any, place: Place) -> dict[str, Any]:
    """Return the checked values of the parameters in a namespace. Raises `ParameterError` if one is invalid."""
    if not isinstance(tree, dict):
        raise ParameterError(
            f"parameter {place.name} is the {type(tree).__name__} {tree!r}, and {place.label} is a namespace of "
            f"parameters: {', '.join(each.name for each in fields(cls))}"
        )
    declared = {each.name: (each, kind) for each, kind in declared_fields(cls)}
    dynamic = {each.name for base in cls.__mro__ if vars(base).get("dynamic") for each in fields(base)}
    values = {
        name: _converted(tree[name], *one, place.inside(name), limited=name in dynamic)
        for name, one in declared.items()
        if name in tree
    }
    unknown = [name for name in tree if name not in declared and name not in cls.allowed]
    others = set(cls(**values).others()) if unknown else ()
    for name in unknown:
        if name in others or (cls.shared and isinstance(tree[name], dict)):
            continue
        problem = _unknown(name, list(declared), place)
        if cls.strict:
            raise ParameterError(problem)
        place.warn(problem)
    return values


def _unknown(name: str, names: list[str], place: Place) -> str:
    hint = nearest(name, names)
    if hint:
        hint = f"did you mean {place.label}{hint.removeprefix('did you mean ')}"
    else:
        hint = f"its parameters are {', '.join(place.label + each for each in names)}"
    whole = f"{place.name}/{name}"
    return (
        f"parameter {whole}: the node {place.owner} has no parameter {place.label}{name}; {hint} "
        f"(`rosparam delete {whole}` removes it)"
    )


def _converted(value: Any, declared: Field[Any], kind: Any, place: Place, *, limited: bool = False) -> Any:
    """Return a value converted to the type of a field. Raises `ParameterError` for a wrong type or range.

    With `limited`, a number beyond the field's range becomes the nearest bound instead.
    """
    options = _options(kind)
    for option in options:
        if isinstance(value, dict) and _is_namespace(option):
            return option(**_read(option, value, place))
        if isinstance(value, list) and get_origin(option) is tuple:
            item = get_args(option)[0]
            return tuple(_converted(each, declared, item, _element(place, number)) for number, each in enumerate(value))
    scalars = tuple(option for option in options if option in _SCALARS)
    value = expected(place.name, rounded(value) if scalars == (int,) else value, scalars, _spelled(kind))
    if limited:
        return limited_value(value, declared.metadata["minimum"], declared.metadata["maximum"])
    _check_range(place.name, declared.metadata, value)
    return value if isinstance(value, str) else _limited(value, declared.metadata, place)


def _limited(value: Any, about: Mapping[str, Any], place: Place) -> Any:
    """Return a number limited to the `limits` of its parameter, with a warning if that changes it."""
    found = limited_value(value, *about["limits"])
    if found != value:
        unit = f" {about['unit']}" if about["unit"] else ""
        place.warn(f"parameter {place.name} ({about['meaning']}) is {value}: it is limited to {found}{unit}")
    return found


def _range(about: Mapping[str, Any]) -> tuple[Any, Any]:
    """Return the bounds between which a value is used unchanged."""
    low, high = about["limits"]
    return about["minimum"] if low is None else low, about["maximum"] if high is None else high


def rounded(value: Any) -> Any:
    """Return a float as an int, rounded as by roscpp's `ros::param::get`, which rounds negative numbers down.

    Other values, and floats that are not finite, are returned unchanged.
    """
    if not isinstance(value, float) or not math.isfinite(value):
        return value
    return math.floor(value) if math.fmod(value, 1.0) < 0.5 else math.ceil(value)


def limited_value(value: Any, low: Any, high: Any) -> Any:
    """Return `value`, or the nearer bound (converted to the value's type) if it is out of range; None is no bound."""
    if high is not None and value > high:
        return type(value)(high)
    if low is not None and value < low:
        return type(value)(low)
    return value


def _element(place: Place, number: int) -> Place:
    label = f"{place.label.rstrip('/')}[{number}]/"
    return Place(f"{place.name}[{number}]", label, place.owner, place.warn)


def _check_range(name: str, about: Mapping[str, Any], value: Any) -> None:
    subject = f"parameter {name} ({about['meaning']}) is"
    choices = about["choices"]
    if choices and value not in choices:
        hint = nearest(value, choices) or f"it has to be one of {', '.join(choices)}"
        raise ParameterError(f"{subject} {value!r}; {hint}")
    low, high = about["minimum"], about["maximum"]
    if isinstance(value, str) or ((low is None or value >= low) and (high is None or value <= high)):
        return
    bounds = " and ".join(
        f"{word} {bound}"
        for word, bound in zip(("at least", "at most"), _range(about), strict=True)
        if bound is not None
    )
    unit = f" {about['unit']}" if about["unit"] else ""
    raise ParameterError(f"{subject} {value}; it has to be {bounds}{unit}")


_SCALARS = (bool, int, float, str)


def declared_fields(cls: type[Parameters]) -> tuple[tuple[Field[Any], Any], ...]:
    """Return the fields of a class with their types."""
    hints = get_type_hints(cls)
    return tuple((declared, hints[declared.name]) for declared in fields(cls))


def _options(kind: Any) -> tuple[Any, ...]:
    """Return the types of a union except None, or the single type."""
    union = get_origin(kind) in (Union, types.UnionType)
    return tuple(part for part in (get_args(kind) if union else (kind,)) if part is not type(None))


def _is_namespace(option: Any) -> bool:
    return isinstance(option, type) and issubclass(option, Parameters)


def is_scalar(kind: Any) -> bool:
    """Return whether a field of this type is neither a list nor a namespace."""
    return all(option in _SCALARS for option in _options(kind))


def _spelled(kind: Any) -> str:
    """Return a type in words."""
    return " or ".join(_spelled_options(kind))


def _spelled_options(kind: Any) -> Iterator[str]:
    for option in _options(kind):
        if get_origin(option) is tuple:
            yield f"list of {_spelled(get_args(option)[0])}"
        elif _is_namespace(option):
            yield f"dictionary of {', '.join(each.name for each in fields(option))}"
        else:
            yield option.__name__


def _listed(default: Any) -> str:
    """Return a default as YAML."""
    if isinstance(default, tuple):
        return f"[{', '.join(map(_listed, default))}]"
    if isinstance(default, Parameters):
        return f"{{{', '.join(f'{each.name}: {_listed(getattr(default, each.name))}' for each in fields(default))}}}"
    return str(default)


def _shown(bound: float | None) -> str:
    return "" if bound is None else str(bound)
