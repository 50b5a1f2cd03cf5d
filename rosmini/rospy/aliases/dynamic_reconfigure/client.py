"""``dynamic_reconfigure.client``: changes the parameters of another node."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini import dynamic_reconfigure
from rosmini.rospy.session import require_node

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["Client"]


class Client(dynamic_reconfigure.Client):
    """Changes the parameters of the server ``name``. Raises ``ROSInitException`` before ``init_node``."""

    def __init__(
        self,
        name: str,
        timeout: float | None = None,
        config_callback: Callable[[Any], object] | None = None,
        description_callback: Callable[[Any], object] | None = None,
    ) -> None:
        node = require_node(f"a dynamic_reconfigure client of {name}")
        super().__init__(node, name, timeout, config_callback, description_callback)

    def get_config_callback(self) -> Callable[[Any], object] | None:
        """Return what is called with each new configuration: the attribute ``config_callback``."""
        return self.config_callback

    def set_config_callback(self, value: Callable[[Any], object] | None) -> None:
        """Set it."""
        self.config_callback = value

    def get_description_callback(self) -> Callable[[Any], object] | None:
        """Return what is called with each new description: the attribute ``description_callback``."""
        return self.description_callback

    def set_description_callback(self, value: Callable[[Any], object] | None) -> None:
        """Set it."""
        self.description_callback = value
