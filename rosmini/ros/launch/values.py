"""Converts texts of launch files: parameters by their ``type``, and attributes that are booleans or numbers."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import ParameterError, nearest, shown
from rosmini.core.graph.parameter_client import check_value
from rosmini.core.rosparam import RosParamException
from rosmini.core.rosparam import parse as parse_yaml

if TYPE_CHECKING:
    from rosmini.core.markup import Element

TYPES = ("str", "string", "int", "double", "bool", "boolean", "yaml", "auto")

TRUTHS = {"true": True, "1": True, "false": False, "0": False}


def convert(text: str, kind: str = "auto") -> Any:
    """Return the value of a text according to ``<param type="...">`` (http://wiki.ros.org/roslaunch/XML/param).

    By default (``auto``) a number with a point is a double, one without an int, ``true`` and ``false`` are booleans
    and anything else is a string. Raises ``ParameterError``.
    """
    kind = kind.strip().lower()
    if kind not in TYPES:
        hint = nearest(kind, TYPES)
        raise ParameterError(f"Unknown type {kind!r}; {hint or 'the types are ' + ', '.join(TYPES)}")
    if kind in ("str", "string"):
        return text
    if kind == "auto":
        return _automatic(text)
    if kind == "yaml":
        try:
            return parse_yaml(text) if text.strip() else None
        except RosParamException as error:
            raise ParameterError(f"invalid YAML {shown(text)}: {error.message}") from error
    if kind in ("bool", "boolean"):
        truth = TRUTHS.get(text.strip().lower())
        if truth is None:
            raise ParameterError(f"{shown(text)} is not a {kind!r}: write true or false, 1 or 0")
        return truth
    try:
        return int(text) if kind == "int" else float(text)
    except ValueError:
        raise ParameterError(f"{shown(text)} is not a number of the type {kind!r}") from None


def _automatic(text: str) -> Any:
    try:
        if "." in text:
            return float(text)
        if "_" not in text:  # Python reads 1_000, ROS does not
            return int(text)
    except ValueError:
        pass
    return {"true": True, "false": False}.get(text.lower(), text)


def checked(name: str, value: Any) -> Any:
    """Return ``value`` in a form that the Parameter Server can store. Raises ``ParameterError``."""
    if value is None:
        raise ParameterError(f"parameter {name} has no value (YAML's null), which a parameter cannot be")
    return check_value(name, value)


def flag(element: Element, name: str, text: str | None, *, default: bool = False) -> bool:
    """Return a boolean attribute. Raises ``LaunchError``."""
    if text is None:
        return default
    truth = {"true": True, "false": False}.get(text.lower())
    if truth is None:
        raise element.error(f'<{element.tag}>: {name}="{text}" is neither true nor false')
    return truth


def positive(element: Element, name: str, text: str | None, default: float) -> float:
    """Return an attribute that is a positive number, or ``default`` if it is missing. Raises ``LaunchError``."""
    if text is None:
        return default
    value = seconds(element, name, text)
    if value <= 0.0:
        raise element.error(f'<{element.tag}>: {name}="{text}" must be a number above zero')
    return value


def seconds(element: Element, name: str, text: str | None) -> float:
    """Return an attribute that is a number of seconds, or 0 if it is missing. Raises ``LaunchError``."""
    try:
        value = float(text) if text is not None else 0.0
    except ValueError:
        value = math.nan
    if not math.isfinite(value) or value < 0.0:
        raise element.error(f'<{element.tag}>: {name}="{text}" is not a number of seconds')
    return value
