"""The client of another node's parameters: receives their values and changes them."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import ROSException, ROSInterruptException, ServiceException
from rosmini.msgs import message_class, service_class

from .description import (
    KINDS,
    Description,
    DynamicReconfigureCallbackException,
    DynamicReconfigureParameterException,
    ReconfigurableParameter,
)
from .encoding import Config, decode_description, decode_values, encode_values, group_tree

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from rosmini.core.graph import Node, Waiter

_TRUE = ("yes", "true", "t", "1")
_PATIENCE = 1.0
"""Time after which a client without timeout logs that it is waiting [s]."""


class Client:
    """Changes the parameters of the server ``name`` (usually the name of its node), and receives its updates.

    The constructor waits for the server, for at most ``timeout`` seconds of the node's time, and raises
    ``ROSException`` after that. ``config_callback(config)`` is called for each new configuration, and
    ``description_callback(parameters)`` for each description.
    """

    def __init__(
        self,
        node: Node,
        name: str,
        timeout: float | None = None,
        config_callback: Callable[[Config], object] | None = None,
        description_callback: Callable[[list[dict[str, Any]]], object] | None = None,
    ) -> None:
        self.node = node
        self.name = name
        self.config: Config | None = None
        self.description: Description | None = None
        self._early: Any = None
        self._waiters: list[Waiter] = []
        self._config_callback = config_callback
        self._description_callback = description_callback
        service = f"{name}/set_parameters"
        self._wait_for_service(service, timeout or None)
        self._set_service = node.service_client(service, service_class("dynamic_reconfigure/Reconfigure"), numpy=False)
        self._subscribers = [
            node.subscriber(f"{name}/{topic}", message_class(f"dynamic_reconfigure/{kind}"), callback, numpy=False)
            for topic, kind, callback in (
                ("parameter_descriptions", "ConfigDescription", self._described),
                ("parameter_updates", "Config", self._updated),
            )
        ]

    def _wait_for_service(self, service: str, timeout: float | None) -> None:
        if timeout is None:
            try:
                self.node.wait_for_service(service, _PATIENCE)
            except ROSException as error:
                if isinstance(error, ROSInterruptException):
                    raise
                self.node.logwarn(f"waiting for the service {self.node.resolve(service)}")
            else:
                return
        self.node.wait_for_service(service, timeout)

    # -- received from the server --------------------------------------------------------------------------------

    def get_configuration(self, timeout: float | None = None) -> Config | None:
        """Return the latest configuration; wait for the first one.

        Returns None after ``timeout`` seconds, or when the node shuts down.
        """
        self._wait(lambda: self.config is not None, timeout, "configuration")
        return self.config

    def get_parameter_descriptions(self, timeout: float | None = None) -> list[dict[str, Any]] | None:
        """Return a dictionary for each parameter: name, type, default, min, max, level, description, edit_method.

        Returns None after ``timeout`` seconds, or when the node shuts down.
        """
        self._wait(lambda: self.description is not None, timeout, "description")
        return None if self.description is None else [one.as_dict() for one in self.description.parameters]

    def get_group_descriptions(self, timeout: float | None = None) -> Config | None:
        """Return the tree of groups: id, parent, name, type, state, ``parameters``, and ``groups``.

        Returns None after ``timeout`` seconds, or when the node shuts down.
        """
        self._wait(lambda: self.description is not None, timeout, "description")
        if self.description is None:
            return None
        tree = group_tree(self.description.root, {})
        _describe(tree, self.description)
        return tree

    def _wait(self, holds: Callable[[], bool], timeout: float | None, what: str) -> None:
        deadline = self.node.now().to_sec() + timeout if timeout else None
        try:
            while not holds():
                waiter = self.node.waiter(f"the {what} of {self.name}")
                self._waiters.append(waiter)
                left = None if deadline is None else deadline - self.node.now().to_sec()
                if left is not None and (left <= 0 or not self.node.wait(waiter, left)):
                    return
                if left is None:
                    self.node.wait(waiter)
        except ROSInterruptException:
            return

    def _described(self, message: Any) -> None:
        self.description = decode_description(message)
        self._wake()
        if self._description_callback is not None:
            self._description_callback([one.as_dict() for one in self.description.parameters])
        early, self._early = self._early, None
        if early is not None:
            self._updated(early)

    def _updated(self, message: Any) -> None:
        if self.description is None:  # messages on two topics may change order
            self._early = message
            return
        self.config = self._decoded(message, self.description)
        self._wake()
        if self._config_callback is not None:
            self._config_callback(self.config)

    def _wake(self) -> None:
        waiters, self._waiters = self._waiters, []
        for waiter in waiters:
            waiter.wake()

    @staticmethod
    def _decoded(message: Any, description: Description) -> Config:
        values, states = decode_values(message)
        return Config({**values, "groups": group_tree(description.root, states, values)})

    # -- requests ------------------------------------------------------------------------------------------------

    def update_configuration(self, changes: Mapping[str, Any]) -> Config:
        """Change parameters, and states of groups (``{"groups": {name: state}}``); return the new configuration.

        Values are converted to the parameter's type where possible: the text "2.5" to a double, "yes" and "true" to a
        bool, the name of an enumeration constant to its value. Raises ``DynamicReconfigureParameterException`` for an
        unknown parameter or an unsuitable value, ``DynamicReconfigureCallbackException`` if the server refuses.
        """
        self._wait(lambda: self.description is not None, None, "description")
        description = self.description
        if description is None:
            raise DynamicReconfigureCallbackException(
                f"{self.name} has not described its parameters, and the node is shutting down"
            )
        values = {name: _converted(description[name], value) for name, value in changes.items() if name != "groups"}
        states = {name: bool(state) for name, state in changes.get("groups", {}).items()}
        request = encode_values(description, values, states)
        try:
            answer = self._set_service(request)
        except ServiceException as error:
            raise DynamicReconfigureCallbackException(f"{self.name} did not change its parameters: {error}") from error
        return self._decoded(answer.config, description)

    def close(self) -> None:
        """Stop receiving updates. Safe to call again."""
        for subscriber in self._subscribers:
            subscriber.unregister()

    @property
    def config_callback(self) -> Callable[[Config], object] | None:
        """The callback for configurations. Setting it calls it with the latest configuration, if there is one."""
        return self._config_callback

    @config_callback.setter
    def config_callback(self, value: Callable[[Config], object] | None) -> None:
        self._config_callback = value
        if value is not None and self.config is not None:
            value(self.config)

    @property
    def description_callback(self) -> Callable[[list[dict[str, Any]]], object] | None:
        """The callback for descriptions. Setting it calls it with the latest description, if there is one."""
        return self._description_callback

    @description_callback.setter
    def description_callback(self, value: Callable[[list[dict[str, Any]]], object] | None) -> None:
        self._description_callback = value
        if value is not None and self.description is not None:
            value([one.as_dict() for one in self.description.parameters])


def _describe(tree: Config, description: Description) -> None:
    """Set ``parameters`` of each group in ``tree`` to the descriptions of the group's parameters."""
    tree["parameters"] = [one.as_dict() for one in description.group(tree["name"]).parameters]
    for inner in tree["groups"].values():
        _describe(inner, description)


def _converted(parameter: ReconfigurableParameter, value: Any) -> Any:
    """Convert a value to the parameter's type. Raises ``DynamicReconfigureParameterException`` if that fails."""
    kind = KINDS[parameter.type]
    if isinstance(value, str) and kind is bool:
        return value.lower() in _TRUE
    if isinstance(value, str) and parameter.edit_method:
        for constant in ast.literal_eval(parameter.edit_method)["enum"]:
            if constant["name"].lower() == value.lower():
                return KINDS[constant["type"]](constant["value"])
    try:
        return kind(value)
    except (TypeError, ValueError, OverflowError) as error:
        raise DynamicReconfigureParameterException(
            f"parameter {parameter.name} has the type {parameter.type}; {value!r} cannot be converted to it: {error}"
        ) from error
