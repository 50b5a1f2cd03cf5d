"""The recovery behaviours listed in `recovery_behaviors`, or the default ones (http://wiki.ros.org/move_base)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from rosmini.core.plugins import PluginError
from rosmini.navigation.nav_core import RecoveryBehavior
from rosmini.navigation.nav_core.plugin_files import create, short_name

if TYPE_CHECKING:
    from rosmini.core.graph import Node
    from rosmini.core.tf import Buffer

CLEAR, ROTATE = "clear_costmap_recovery/ClearCostmapRecovery", "rotate_recovery/RotateRecovery"


class NamedBehavior(NamedTuple):
    """A behaviour and its name in the list."""

    name: str
    behavior: RecoveryBehavior


class InvalidList(Exception):
    """Raised if `recovery_behaviors` is invalid; the message goes to the log."""


def parsed_entries(entries: Any) -> list[tuple[str, str]]:
    """Return name and type of each entry of `recovery_behaviors`. Raises `InvalidList`, with ROS's messages."""
    if not isinstance(entries, list):
        raise InvalidList(
            "The recovery behavior specification must be a list, but is of the type "
            f"{type(entries).__name__}. We'll use the default recovery behaviors instead."
        )
    found: dict[str, str] = {}
    for entry in entries:
        if not isinstance(entry, dict):
            raise InvalidList(
                "Recovery behaviors must be specified as maps, but they are of the type "
                f"{type(entry).__name__}. We'll use the default recovery behaviors instead."
            )
        if "name" not in entry or "type" not in entry:
            raise InvalidList(
                "Recovery behaviors must have a name and a type and this does not. Using the default recovery "
                f"behaviors instead. It has {', '.join(map(str, entry)) or 'nothing'}."
            )
        name = str(entry["name"])
        if name in found:
            raise InvalidList(
                f"A recovery behavior with the name {name} already exists, this is not allowed. Using the default "
                "recovery behaviors instead."
            )
        found[name] = str(entry["type"])
    return list(found.items())


class Recoveries:
    """Creates the recovery behaviours of a node."""

    def __init__(self, node: Node, buffer: Buffer, global_costmap: Any, local_costmap: Any) -> None:
        self._node = node
        self._context = (buffer, global_costmap, local_costmap)

    def load(self, *, rotate: bool, reset_distance: float, circumscribed_radius: float) -> list[NamedBehavior]:
        """Return the behaviours that the parameter lists, or the default ones if it is missing or invalid."""
        if self._node.has_param("~recovery_behaviors"):
            try:
                listed = parsed_entries(self._node.get_param("~recovery_behaviors"))
                return [NamedBehavior(name, self._create(name, self._full_name(kind))) for name, kind in listed]
            except InvalidList as error:
                self._node.logerr(str(error))
            except PluginError as error:
                self._node.logerr(f"Failed to load a plugin. Using default recovery behaviors. Error: {error}")
        return self._default(rotate, reset_distance, circumscribed_radius)

    def _default(self, rotate: bool, reset_distance: float, circumscribed_radius: float) -> list[NamedBehavior]:
        """Return the default list: clear far away, rotate, clear closer, rotate again."""
        self._node.set_param("~conservative_reset/reset_distance", reset_distance)
        self._node.set_param("~aggressive_reset/reset_distance", circumscribed_radius * 4)
        conservative = NamedBehavior("conservative_reset", self._create("conservative_reset", CLEAR))
        turn = [NamedBehavior("rotate_recovery", self._create("rotate_recovery", ROTATE))] if rotate else []
        aggressive = NamedBehavior("aggressive_reset", self._create("aggressive_reset", CLEAR))
        return [conservative, *turn, aggressive, *turn]

    def _create(self, name: str, kind: str) -> RecoveryBehavior:
        interface: Any = RecoveryBehavior
        behavior: RecoveryBehavior = create(interface, kind)
        behavior.initialize(name, *self._context)
        return behavior

    def _full_name(self, kind: str) -> str:
        """Return the full name of a class that is given without its package, as in files for old ROS releases."""
        if "/" in kind or ":" in kind:
            return kind
        for name in RecoveryBehavior.names():
            if short_name(name) == kind:
                self._node.logwarn(
                    "Recovery behavior specifications should now include the package name. You are using a deprecated "
                    f"API. Please switch from {kind} to {name} in your yaml file."
                )
                return name
        return kind
