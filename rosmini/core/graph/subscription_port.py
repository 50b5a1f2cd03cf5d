"""What connections and subscribers need of their subscription."""

# ruff: noqa: D102 - the class Subscription describes the methods
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from .node_port import NodePort


class SubscriptionPort(Protocol):
    """A subscription as its parts see it; ``Subscription`` describes the methods."""

    node: NodePort
    topic: str
    message_class: Any
    handles: list[Any]
    queue_size: int | None
    tcp_nodelay: bool
    statistics: Any

    def add(self, handle: Any) -> None: ...
    def remove(self, handle: Any) -> None: ...
    def num_open(self) -> int: ...
    def way(self, message_class: Any) -> Any: ...
    def gave_up(self, connection: Any) -> None: ...
    def closed(self, connection: Any) -> None: ...
    def lost(self, connection: Any, error: Exception | None) -> None: ...
    def is_first_failure(self, connection: Any) -> bool: ...
