"""The server: makes a node's parameters changeable, and publishes each change."""

from __future__ import annotations

import copy
from collections import deque
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from rosmini.core.parameters import rounded
from rosmini.msgs import message_class, service_class

from .description import (
    Description,
    DynamicReconfigureCallbackException,
    DynamicReconfigureParameterException,
    cast_value,
)
from .encoding import Config, decode_values, encode_description, encode_values, group_states, group_tree

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from rosmini.core.graph import Node, Waiter
    from rosmini.core.graph.lanes import Lane

_ALL_LEVELS = -1
"""Level passed to the first call of the callback: all bits set."""


class Server:
    """Makes parameters of ``node`` changeable, in ``namespace`` (by default the node's private one).

    ``type`` is any source that :meth:`Description.of` accepts. Initial values come from the Parameter Server, or are
    the defaults. They are limited to their ranges with a warning; a float is rounded for an int, as in roscpp.
    ``callback(config, level)`` is called with all values, at the start and after each change, and returns the
    configuration to apply. ``level`` is the bitwise OR of the levels of the changed parameters, 0 if none changed, and
    -1 (all bits set) in the first call. Calls never overlap, and nothing changes if the callback fails.

    The new values are written to the Parameter Server and published on ``parameter_updates``. The description is
    published on ``parameter_descriptions``. The service ``set_parameters`` accepts changes.

    Raises ``DynamicReconfigureParameterException`` for a wrong description or a value of the wrong type on the
    Parameter Server, and ``DynamicReconfigureCallbackException`` if the callback returns None.
    """

    def __init__(self, node: Node, type: Any, callback: Callable[[Config, int], Any], namespace: str = "") -> None:
        self.node = node
        self.ns = _prefix(namespace)
        self.type = type
        self.description = Description.of(type)
        self.callback = callback
        self._owner: Lane | None = None
        self._queue: deque[Waiter] = deque()
        values = self._values_at_start()
        self.config = self._config(values, {})
        self.descr_topic = node.publisher(
            self.ns + "parameter_descriptions", message_class("dynamic_reconfigure/ConfigDescription"), latch=True
        )
        self.descr_topic.publish(encode_description(self.description))
        self.update_topic = node.publisher(
            self.ns + "parameter_updates", message_class("dynamic_reconfigure/Config"), latch=True
        )
        with self._alone():
            self._change(values, {}, _ALL_LEVELS)
        self.set_service = node.service(
            self.ns + "set_parameters", service_class("dynamic_reconfigure/Reconfigure"), self._set, numpy=False
        )

    def update_configuration(self, changes: Mapping[str, Any]) -> Config:
        """Change parameters, and states of groups in the item ``groups`` (as in a configuration).

        Returns the new configuration. Values are limited to their range. Raises `DynamicReconfigureParameterException`
        for an unknown parameter or a value of another type, the errors of the callback, and
        ``DynamicReconfigureCallbackException`` if the callback calls this method or returns nothing.
        """
        values = {name: value for name, value in changes.items() if name != "groups"}
        return self._update(values, group_states(changes["groups"]) if "groups" in changes else {})

    def _update(self, changes: Mapping[str, Any], states: Mapping[str, bool]) -> Config:
        for name in states:
            self.description.group(name)
        with self._alone():
            values = self._values_of(self.config)
            level = 0
            for name, value in changes.items():
                parameter = self.description[name]
                limited = parameter.clamp(cast_value(name, parameter.type, value))
                if limited != values[name]:
                    level |= parameter.level
                values[name] = limited
            return self._change(values, {**group_states(self.config["groups"]), **states}, level)

    def _set(self, request: Any) -> Any:
        """Handle a request to the service."""
        config = self._update(*decode_values(request.config))
        return [self._encoded(config)]

    def _change(self, values: Mapping[str, Any], states: Mapping[str, bool], level: int) -> Config:
        answer = self.callback(copy.deepcopy(self._config(values, states)), level)
        if answer is None:
            raise DynamicReconfigureCallbackException(
                f"the parameter callback of {self.node.name} returned nothing: it must return the "
                "configuration, changed or not"
            )
        unknown = next((name for name in answer if name != "groups" and name not in values), None)
        if unknown is not None:
            self.description[unknown]
        values = {
            one.name: cast_value(one.name, one.type, answer.get(one.name, values[one.name]))
            for one in self.description.parameters
        }
        self.config = self._config(values, group_states(answer["groups"]) if "groups" in answer else states)
        for name, value in values.items():
            self.node.set_param(self.ns + name, value)
        self.update_topic.publish(self._encoded(self.config))
        return copy.deepcopy(self.config)

    def _config(self, values: Mapping[str, Any], states: Mapping[str, bool]) -> Config:
        return Config({**values, "groups": group_tree(self.description.root, states, values)})

    def _values_of(self, config: Config) -> dict[str, Any]:
        return {one.name: config[one.name] for one in self.description.parameters}

    def _encoded(self, config: Config) -> Any:
        return encode_values(self.description, self._values_of(config), group_states(config["groups"]))

    def _values_at_start(self) -> dict[str, Any]:
        values = {}
        for parameter in self.description.parameters:
            name = self.node.resolve_parameter(self.ns + parameter.name)
            found = self.node.get_param(name, None)
            if parameter.type == "int":
                found = rounded(found)
            try:
                value = parameter.default if found is None else cast_value(name, parameter.type, found)
            except DynamicReconfigureParameterException as error:
                raise DynamicReconfigureParameterException(
                    f"{error} on the Parameter Server: set it again, or delete it"
                ) from None
            values[parameter.name] = limited = parameter.clamp(value)
            if found is not None and limited != value:
                self.node.logwarn(
                    f"node {self.node.name}: parameter {name} is {found!r}: {limited!r} is used, as its range is "
                    f"{parameter.min!r} ... {parameter.max!r}"
                )
        return values

    @contextmanager
    def _alone(self) -> Iterator[None]:
        """Wait until no other change is being made. Raises an exception if the callback itself starts a change."""
        me = self.node.scheduler.current()
        if self._owner is me:
            raise DynamicReconfigureCallbackException(
                "the callback of a server cannot call update_configuration: it must return the new configuration"
            )
        while self._owner is not None:
            waiter = self.node.waiter("another change of parameters to be done")
            self._queue.append(waiter)
            self.node.wait(waiter)
        self._owner = me
        try:
            yield
        finally:
            self._owner = None
            if self._queue:
                self._queue.popleft().wake()


def _prefix(namespace: str) -> str:
    """Return the prefix of the names of topics and parameters: ``~`` or a namespace that ends with ``/``."""
    if not namespace:
        return "~"
    if namespace[0] not in "/~":
        namespace = "~" + namespace
    return (namespace + "/").replace("//", "/")
