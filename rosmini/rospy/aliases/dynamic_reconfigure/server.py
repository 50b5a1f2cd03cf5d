"""``dynamic_reconfigure.server``: offers the script's parameters for change."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini import dynamic_reconfigure
from rosmini.rospy.session import require_node

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["Server"]


class Server(dynamic_reconfigure.Server):
    """Offers the parameters that ``type`` describes. Raises ``ROSInitException`` before ``init_node``."""

    def __init__(self, type: Any, callback: Callable[[Any, int], Any], namespace: str = "") -> None:
        super().__init__(require_node("a dynamic_reconfigure server"), type, callback, namespace)
