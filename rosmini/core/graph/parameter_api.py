"""Parameters as a node sees them (http://wiki.ros.org/Parameter%20Server)."""

from __future__ import annotations

import math
from datetime import datetime
from functools import partial
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import (
    ParameterError,
    ParameterNotSet,
    ParameterOverflow,
    ParameterTypeError,
    ROSException,
    nearest,
)
from rosmini.core.names import canonicalize, resolve

from .blocking_api import BlockingApi
from .logging_api import LoggingApi
from .parameters import wire_copy

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.names import Remappings

    from .lanes import Lane

_UNSET: Any = object()


def check_value(name: str, value: Any) -> Any:
    """Return ``value`` as the Parameter Server can hold it.

    Raises ``ParameterError``, which says where the value is wrong.
    """
    if hasattr(value, "tolist"):  # numpy scalars and arrays
        return check_value(name, value.tolist())
    if isinstance(value, bool):
        return value
    if isinstance(value, str):
        return str.__str__(value)  # an enumeration's member is its value
    if type(value).__name__ == "Binary" and hasattr(
        value, "data"
    ):  # xmlrpc.client's, which rospy's scripts use
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
                msg = (
                    f"parameter {name}: the key {key!r} is a {type(key).__name__}; "
                    "keys of a parameter tree are strings"
                )
                raise ParameterTypeError(msg)
        return {key: check_value(f"{name.rstrip('/')}/{key}", item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [check_value(f"{name}[{index}]", item) for index, item in enumerate(value)]
    msg = (
        f"parameter {name}: a {type(value).__name__} cannot be stored ({value!r}). "
        "Parameters are bool, int, float, str, bytes, datetime, lists of these, and dictionaries with string keys."
    )
    raise ParameterTypeError(msg)


def expected(name: str, value: Any, kinds: tuple[type, ...], wanted: str = "") -> Any:
    """Return a parameter's ``value`` if it is of one of these types; an int is welcome where a float is expected.

    Raises ``ParameterError``, which says what is ``wanted`` (the types by default).
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


def _is_in(name: str, tree: str) -> bool:
    """Return whether a canonical name is ``tree`` or is inside it."""
    return name == tree or name.startswith(tree.rstrip("/") + "/")


class ParameterApi(BlockingApi, LoggingApi):
    """The part of a node that reads and writes parameters.

    All raise ``MasterUnreachable`` if the Master does not answer.
    """

    uri: str
    namespace: str
    remappings: Remappings
    _hooks: list[Callable[[], object]]
    _parameter_callbacks: dict[str, list[Callable[[Any], object]]]
    _parameter_told: dict[str, Any]
    _parameter_lane: Lane | None

    def resolve(self, name: str) -> str:
        """Return the global name that ``name`` means here: namespace, private names and remappings applied."""
        return resolve(name, self.namespace, self.name, self.remappings)

    def resolve_parameter(self, name: str) -> str:
        """Return the global name that a parameter's ``name`` means here; as in rospy its characters are not checked."""
        return resolve(name, self.namespace, self.name, self.remappings, what="parameter name", check=False)

    def get_param(
        self, name: str, default: Any = _UNSET, *, expect: type | tuple[type, ...] | None = None
    ) -> Any:
        """Return a parameter's value, or ``default`` if it is not set.

        With ``expect`` a value of another type is an error (an int is welcome where a float is expected). Raises
        ``ParameterNotSet``, which names parameters with a similar name and other namespaces that have this one.
        """
        resolved = self.resolve_parameter(name)
        code, _, value = self.master.call("getParam", resolved)
        if code != 1:
            if default is not _UNSET:
                return default
            raise ParameterNotSet(self._not_set(name, resolved))
        if expect is not None:
            return expected(resolved, value, expect if isinstance(expect, tuple) else (expect,))
        return value

    def _not_set(self, name: str, resolved: str) -> str:
        names = self.master.ask("getParamNames")
        base = resolved.rpartition("/")[2]
        elsewhere = [other for other in names if other.rpartition("/")[2] == base]
        text = f"parameter {resolved} is not set"
        if name != resolved:
            text += f" ({name!r} in node {self.name} means {resolved})"
        if elsewhere:
            return f"{text}; it exists as {', '.join(elsewhere[:3])}. Use that name, or give a default."
        hint = nearest(resolved, names)
        return f"{text}. {hint or 'Set it first, or give a default.'}"

    def set_param(self, name: str, value: Any) -> None:
        """Set a parameter; a dictionary sets a whole tree. Raises ``ParameterError`` for what ROS cannot hold."""
        resolved = self.resolve_parameter(name)
        code, status, _ = self.master.call("setParam", resolved, check_value(resolved, value))
        if code != 1:
            raise ParameterError(status)
        self._note_parameters()

    def has_param(self, name: str) -> bool:
        """Tell whether a parameter, or a tree of them, is set."""
        return bool(self.master.ask("hasParam", self.resolve_parameter(name)))

    def delete_param(self, name: str) -> None:
        """Delete a parameter or a tree. Raises ``ParameterNotSet``."""
        resolved = self.resolve_parameter(name)
        if self.master.call("deleteParam", resolved)[0] != 1:
            raise ParameterNotSet(self._not_set(name, resolved))
        self._note_parameters()

    def search_param(self, name: str) -> str | None:
        """Return the full name of the nearest parameter upwards from the node's own namespace, or None."""
        found: str | None = self.master.find("searchParam", name)
        return found

    def param_names(self) -> list[str]:
        """Return the names of all parameters, sorted."""
        return sorted(self.master.ask("getParamNames"))

    def on_param(self, name: str, callback: Callable[[Any], object]) -> Any:
        """Call ``callback(value)`` when a parameter, or anything in a tree of them, changes; return its value now.

        ``{}`` stands for a parameter that is not set, or not any more, as in ROS. The node does not hear of what it
        sets itself, and to set a parameter to the value that it has is no change.
        Raises ``ROSException`` if the Master refuses.
        """
        resolved = self.resolve_parameter(name)
        if not self._parameter_callbacks:
            self._hooks.append(self._leave_parameters)
        key = canonicalize(resolved)
        callbacks = self._parameter_callbacks.setdefault(key, [])
        callbacks.append(callback)
        try:
            value = self.master.register("subscribeParam", self.uri, resolved, warn=self.logerr)
        except ROSException:
            callbacks.remove(callback)
            raise
        self._parameter_told.setdefault(key, value)
        return wire_copy(value)

    def off_param(self, name: str, callback: Callable[[Any], object] | None = None) -> None:
        """Undo :meth:`on_param`: for one callback, or for all of a parameter.

        Raises ``ParameterError`` if there is none.
        """
        resolved = canonicalize(self.resolve_parameter(name))
        callbacks = self._parameter_callbacks.get(resolved, [])
        if not callbacks or (callback is not None and callback not in callbacks):
            hint = nearest(resolved, self._parameter_callbacks)
            msg = f"node {self.name} has no such callback for changes of parameter {resolved}"
            raise ParameterError(f"{msg}; {hint}" if hint else msg)
        kept = list(callbacks)
        if callback is not None:
            kept.remove(callback)
        if callback is not None and kept:
            self._parameter_callbacks[resolved] = kept
            return
        del self._parameter_callbacks[resolved]
        self._parameter_told.pop(resolved, None)
        self.master.unregister("unsubscribeParam", self.uri, resolved, warn=self.logwarn)

    @property
    def watched_parameters(self) -> list[str]:
        """The parameters for which :meth:`on_param` was called."""
        return list(self._parameter_callbacks)

    def watches(self, key: str) -> bool:
        """Return whether :meth:`on_param` was called for this parameter or for a namespace that contains it."""
        return any(_is_in(canonicalize(key), name) for name in self.watched_parameters)

    def parameter_changed(self, key: str, value: Any) -> None:  # noqa: ARG002 - what the Master says
        """Learn from the Master that a parameter has changed to which this node subscribes.

        The Master calls once for each subscription, so that one change may be told several times; and by now the value
        may be another.
        """
        if self._parameter_lane is None:
            self._parameter_lane = self.spawn(f"{self.name} parameters")
        self._parameter_lane.submit(partial(self._look_at_parameters, canonicalize(key)))

    def _look_at_parameters(self, changed: str) -> None:
        for name in list(self._parameter_callbacks):
            if not _is_in(changed, name):
                continue
            now = self._value_now(name)
            callbacks = self._parameter_callbacks.get(name, [])
            if repr(self._parameter_told.get(name, _UNSET)) == repr(
                now
            ):  # 1, 1.0 and True are equal, but not the same
                continue
            self._parameter_told[name] = now
            for callback in callbacks:
                self._tell(name, callback, wire_copy(now))

    def _value_now(self, name: str) -> Any:
        code, _, value = self.master.insist("getParam", name, warn=self.logerr)
        return value if code == 1 else {}

    def _note_parameters(self) -> None:
        """Take what this node has just set as told: the Master spares it an echo."""
        for name in list(self._parameter_callbacks):
            self._parameter_told[name] = self._value_now(name)

    def _tell(self, name: str, callback: Callable[[Any], object], value: Any) -> None:
        self.spawn(
            f"{self.name} parameter {name}",
            partial(self.guarded, callback, value, what=f"parameter {name}"),
        )

    def _leave_parameters(self) -> None:
        """Leave no subscription at the Master when the node ends."""
        for name in list(self._parameter_callbacks):
            self.off_param(name)
