"""The two planners of `move_base`, which can be replaced at run time."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import ROSInterruptException
from rosmini.core.graph import Node, Subscriber
from rosmini.core.plugins import PluginError
from rosmini.navigation.nav_core import BaseGlobalPlanner, BaseLocalPlanner
from rosmini.navigation.nav_core.plugin_files import create, short_name

if TYPE_CHECKING:
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
        self._handles: dict[str, list[Any]] = {}

    def load(self, which: str, name: str) -> None:
        """Replace the `GLOBAL` or the `LOCAL` planner by a new one with this plugin name.

        Raises `PluginError` if it cannot be created or initialised; the previous planner, if any, stays.
        """
        planner, before = self._create(which, name), self.names.get(which)
        self._remove_handles(which)
        try:
            self._start(which, name, planner)
        except PluginError:
            if before is not None:
                self._remove_handles(which)
                self._start(which, before, self._create(which, before))
            raise
        if which == LOCAL:
            self._node.loginfo(f"Created local_planner {name}")

    def _create(self, which: str, name: str) -> Any:
        interface: Any = BaseGlobalPlanner if which == GLOBAL else BaseLocalPlanner
        try:
            return create(interface, name)
        except PluginError as error:
            raise PluginError(
                f"Failed to create the {name} planner, are you sure it is properly registered and that the containing "
                f"library is built? Exception: {error}"
            ) from error

    def _start(self, which: str, name: str, planner: Any) -> None:
        """Initialise a planner, and record the topics and services that it creates."""
        before = set(_all_handles(self._node))
        try:
            self._initialize(which, planner, name)
        finally:
            self._handles[which] = [each for each in _all_handles(self._node) if each not in before]
        self.of[which], self.names[which] = planner, name

    def _initialize(self, which: str, planner: Any, name: str) -> None:
        try:
            if which == GLOBAL:
                planner.initialize(short_name(name), self._global_costmap)
            else:
                planner.initialize(short_name(name), self._buffer, self.local_costmap)
        except ROSInterruptException:
            raise
        except Exception as error:
            if (type(planner).__module__ or "").startswith("rosmini."):
                raise
            raise PluginError(
                f"initialize() of the {which} planner {name} raised {type(error).__name__}: {error}"
            ) from error

    def subscribed_topics(self, which: str) -> frozenset[str]:
        """Return the topics that a planner has subscribed to."""
        return frozenset(each.topic for each in self._handles[which] if isinstance(each, Subscriber))

    def _remove_handles(self, which: str) -> None:
        """Remove the publishers, subscribers and services of a planner, so that the next can use the same names."""
        for handle in self._handles.pop(which, ()):
            remove = handle.unregister if hasattr(handle, "unregister") else handle.shutdown
            remove()


def _all_handles(node: Node) -> Iterator[Any]:
    """Yield every publisher, subscriber, service and timer of a node."""
    for topics in (node.publications, node.subscriptions):
        for topic in topics.values():
            yield from topic.handles
    yield from node.services.values()
    yield from node.timers
