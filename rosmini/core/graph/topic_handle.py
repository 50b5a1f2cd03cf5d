"""What the handles of a topic have in common: a publisher's and a subscriber's."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from .node_port import NodePort


class TopicHandle(ABC):
    """A handle of a topic; ``on_connect`` and ``on_disconnect`` get the name of the node at the other end."""

    node: NodePort
    topic: str
    _on_connect: Callable[[str], object] | None
    _on_disconnect: Callable[[str], object] | None

    @abstractmethod
    def _unregister(self) -> None:
        """Leave the topic, in the hub's thread."""

    @abstractmethod
    def detach(self) -> None:
        """Learn that the node has shut down."""

    def unregister(self) -> None:
        """End this handle. The topic is left when the node's last one has gone. Harmless when repeated."""
        self.node.scheduler.on_hub(self._unregister)

    def connected(self, peer: str) -> None:
        """Learn that the node ``peer`` was connected."""
        self._tell(self._on_connect, peer)

    def disconnected(self, peer: str) -> None:
        """Learn that the node ``peer`` was disconnected."""
        self._tell(self._on_disconnect, peer)

    def _tell(self, callback: Callable[[str], object] | None, peer: str) -> None:
        if callback is not None:
            self.node.spawn(
                f"{self.node.name} connections of {self.topic}",
                lambda: self.node.guarded(callback, peer, what=f"connection callback of {self.topic}"),
            )
