"""A node's access to the Parameter Server (http://wiki.ros.org/Parameter%20Server), and checks of values."""

from __future__ import annotations

import math
from datetime import datetime
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import ParameterError, ParameterNotSet, ParameterOverflow, ParameterTypeError, nearest

if TYPE_CHECKING:
    from .node import Node

UNSET: Any = object()
"""Marks a default that was not given."""


def check_value(name: str, value: Any) -> Any:
    """Return ``value`` in a form that the Parameter Server can store.

    Raises ``ParameterError``, which names the invalid part.
    """
    if hasattr(value, "tolist"):  # numpy scalars and arrays
        return check_value(name, value.tolist())
    if isinstance(value, bool):
        return value
    if isinstance(value, str):
        return str.__str__(value)  # a member of an enumeration becomes its value
    if type(value).__name__ == "Binary" and hasattr(value, "data"):  # xmlrpc.client's, which rospy's scripts use
        value = value.data
    if isinstance(value, bytes):
        return bytes(value)
    if isinstance(value, datetime):
        return value
    if isinstance(value, float):
        return float.__float__(value)
    if isinstance(value, int):
        if not -(2**31) <= value < 2**31:
            msg = (
                f"parameter {name}: {value} does not fit into the 32 bits of a ROS parameter; "
                "store it as a float or a string"
            )
            raise ParameterOverflow(msg)
        return int(value)
    if isinstance(value, dict):
        for key in value:
            if not isinstance(key, str):
                raise ParameterTypeError(f"parameter {name}: the key {key!r} is not a string")
        return {key: check_value(f"{name.rstrip('/')}/{key}", item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [check_value(f"{name}[{index}]", item) for index, item in enumerate(value)]
    msg = (
        f"parameter {name}: a {type(value).__name__} cannot be stored ({value!r}). "
        "Parameters are bool, int, float, str, bytes, datetime, lists of these, and dictionaries with string keys."
    )
    raise ParameterTypeError(msg)


def expected(name: str, value: Any, kinds: tuple[type, ...], wanted: str = "") -> Any:
    """Return a parameter's ``value`` if it has one of these types; an int is accepted for a float.

    Raises ``ParameterError``; ``wanted`` describes the expected value in its text (by default the types).
    """
    if float in kinds and isinstance(value, int) and not isinstance(value, bool):
        return float(value)
    if isinstance(value, kinds) and not (isinstance(value, bool) and bool not in kinds):
        if isinstance(value, float) and math.isnan(value):
            msg = f"parameter {name} is not a number (nan)"
            raise ParameterError(msg)
        return value
    wanted = wanted or " or ".join(kind.__name__ for kind in kinds)
    article = "an" if wanted.startswith("int") else "a"
    msg = (
        f"parameter {name} is the {type(value).__name__} {value!r}, and {article} {wanted} is needed. "
        f"Set it again: set_param({name!r}, ...)."
    )
    raise ParameterError(msg)


class ParameterClient:
    """A node's access to the Parameter Server; :class:`~rosmini.core.graph.node.Node` has short names for it.

    All methods raise ``MasterUnreachable`` if the Master does not respond.
    """

    def __init__(self, node: Node) -> None:
        self._node = node

    def get(self, name: str, default: Any = UNSET, *, expect: type | tuple[type, ...] | None = None) -> Any:
        """Return a parameter's value, or ``default`` if it is not set.

        Raises ``ParameterNotSet``, which names similar parameters and other namespaces that contain this one, if it is
        not set and there is no default. Raises ``ParameterError`` if the value does not have a type in ``expect`` (an
        int is accepted for a float).
        """
        resolved = self._node.resolve_parameter(name)
        code, _, value = self._node.master.call("getParam", resolved)
        if code != 1:
            if default is not UNSET:
                return default
            raise ParameterNotSet(self._not_set(name, resolved))
        if expect is not None:
            return expected(resolved, value, expect if isinstance(expect, tuple) else (expect,))
        return value

    def _not_set(self, name: str, resolved: str) -> str:
        names = self._node.master.ask("getParamNames")
        base = resolved.rpartition("/")[2]
        elsewhere = [other for other in names if other.rpartition("/")[2] == base]
        text = f"parameter {resolved} is not set"
        if name != resolved:
            text += f" ({name!r} in node {self._node.name} means {resolved})"
        if elsewhere:
            return f"{text}; it exists as {', '.join(elsewhere[:3])}. Use that name, or give a default."
        hint = nearest(resolved, names)
        return f"{text}. {hint or 'Set it first, or give a default.'}"

    def set(self, name: str, value: Any) -> None:
        """Set a parameter; a dictionary sets a whole tree. Raises ``ParameterError`` if ROS cannot store the value."""
        resolved = self._node.resolve_parameter(name)
        code, status, _ = self._node.master.call("setParam", resolved, check_value(resolved, value))
        if code != 1:
            raise ParameterError(status)

    def has(self, name: str) -> bool:
        """Return True if a parameter, or a tree of them, is set."""
        return bool(self._node.master.ask("hasParam", self._node.resolve_parameter(name)))

    def delete(self, name: str) -> None:
        """Delete a parameter or a tree of them. Raises ``ParameterNotSet`` if it is not set."""
        resolved = self._node.resolve_parameter(name)
        if self._node.master.call("deleteParam", resolved)[0] != 1:
            raise ParameterNotSet(self._not_set(name, resolved))

    def search(self, name: str) -> str | None:
        """Return the full name of the nearest parameter, searching upwards from the node's namespace, or None."""
        found: str | None = self._node.master.find("searchParam", name)
        return found

    def names(self) -> list[str]:
        """Return the names of all parameters, sorted."""
        return sorted(self._node.master.ask("getParamNames"))
