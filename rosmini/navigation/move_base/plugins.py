"""The two planners of `move_base`, which can be replaced at run time."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import ROSInterruptException
from rosmini.core.graph import Subscriber
from rosmini.core.plugins import PluginError
from rosmini.navigation.nav_core import BaseGlobalPlanner, BaseLocalPlanner
from rosmini.navigation.nav_core.plugin_files import create, short_name

if TYPE_CHECKING:
    from rosmini.core.graph import Node
    from rosmini.core.tf import Buffer

GLOBAL, LOCAL = "global", "local"


class Planners:
    """Loads planners by name; `of` and `names` map `GLOBAL` and `LOCAL` to the planners and their names."""

    def __init__(self, node: Node, buffer: Buffer, global_costmap: Any) -> None:
        self._node, self._buffer = node, buffer
        self._global_costmap = global_costmap
        self.local_costmap: Any = None
        self.of: dict[str, Any] = {}
        self.names: dict[str, str] = {}
        self._made: dict[str, list[Any]] = {}

    def load(self, which: str, name: str) -> None:
        """Create and start a planner. Raises `PluginError`, in which case the previous planner stays."""
        made, before = self._created(which, name), self.names.get(which)
        self._withdraw(which)
        try:
            self._bring(which, name, made)
        except PluginError:
            if before is not None:
                self._withdraw(which)
                self._bring(which, before, self._created(which, before))
            raise
        if which == LOCAL:
            self._node.loginfo(f"Created local_planner {name}")

    def _created(self, which: str, name: str) -> Any:
        interface: Any = BaseGlobalPlanner if which == GLOBAL else BaseLocalPlanner
        try:
            return create(interface, name)
        except PluginError as error:
            raise PluginError(
                f"Failed to create the {name} planner, are you sure it is properly registered and that the containing "
                f"library is built? Exception: {error}"
            ) from error

    def _bring(self, which: str, name: str, made: Any) -> None:
        """Initialise a planner, and record the topics and services that it creates."""
        before = set(_handles(self._node))
        try:
            self._initialize(which, made, name)
        finally:
            self._made[which] = [each for each in _handles(self._node) if each not in before]
        self.of[which], self.names[which] = made, name

    def _initialize(self, which: str, made: Any, name: str) -> None:
        try:
            if which == GLOBAL:
                made.initialize(short_name(name), self._global_costmap)
            else:
                made.initialize(short_name(name), self._buffer, self.local_costmap)
        except ROSInterruptException:
            raise
        except Exception as error:
            if (type(made).__module__ or "").startswith("rosmini."):
                raise
            raise PluginError(
                f"initialize() of the {which} planner {name} raised {type(error).__name__}: {error}"
            ) from error

    def hears(self, which: str) -> frozenset[str]:
        """Return the topics that a planner has subscribed to."""
        return frozenset(each.topic for each in self._made[which] if isinstance(each, Subscriber))

    def _withdraw(self, which: str) -> None:
        """Remove the publishers, subscribers and services of a planner, so that the next can use the same names."""
        for handle in self._made.pop(which, ()):
            end = handle.unregister if hasattr(handle, "unregister") else handle.shutdown
            end()


def _handles(node: Node) -> Iterator[Any]:
    """Yield every publisher, subscriber, service and timer of a node."""
    for topics in (node.publications, node.subscriptions):
        for topic in topics.values():
            yield from topic.handles
    yield from node.services.values()
    yield from node.timers
