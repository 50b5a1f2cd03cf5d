"""The handle of who subscribes to a topic: a callback, and in what form the messages arrive."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .callbacks import Callback
from .topic_handle import TopicHandle

if TYPE_CHECKING:
    from collections.abc import Callable

    from .subscription_port import SubscriptionPort


class Subscriber(TopicHandle):
    """Receives messages of one type on one topic. Made by ``Node.subscriber``.

    ``numpy`` chooses how numeric arrays arrive: as read-only numpy arrays, or as rospy's tuples and bytes. What the
    first subscriber of a node to a topic chose holds for all of that node's.
    """

    def __init__(
        self,
        subscription: SubscriptionPort,
        message_class: Any,
        callback: Callable[..., object] | None,
        arguments: tuple[Any, ...] = (),
        *,
        queue_size: int | None = None,
        numpy: bool = True,
        on_connect: Callable[[str], object] | None = None,
        on_disconnect: Callable[[str], object] | None = None,
        receipt: Callable[[Any], Callable[[Any], Any] | None] | None = None,
    ) -> None:
        self._subscription: SubscriptionPort | None = subscription
        self.node = subscription.node
        self.topic = subscription.topic
        self.message_class = message_class
        self.queue_size = queue_size
        self.callback = None if callback is None else Callback(callback, arguments)
        self._numpy = numpy
        self.receipt = receipt
        self._on_connect = on_connect
        self._on_disconnect = on_disconnect
        subscription.add(self)

    def __repr__(self) -> str:
        return f"<Subscriber {self.topic} [{self.message_class._type}] of {self.node.name}>"

    def thaw_for(self, message_class: Any) -> Callable[[Any], Any] | None:
        """Return how a frozen message becomes this subscriber's own; None: as it is."""
        if self.receipt is not None:
            return self.receipt(message_class)
        thaw: Callable[[Any], Any] | None = message_class._thawer(numpy=self._numpy)
        return thaw

    @property
    def wish(self) -> str:
        """What this subscriber asked for, in words."""
        if self.message_class._type == "*":
            return "messages of any type"
        arrays = " with numpy arrays" if self._numpy or self.receipt is not None else ""
        return f"{self.message_class._type}{arrays}"

    def wants_other_than(self, other: Subscriber) -> bool:
        """Tell whether this one would get another object than ``other`` does for the same message."""
        cls = other.message_class
        return self.message_class._type != cls._type or self.thaw_for(cls) != other.thaw_for(cls)

    def num_connections(self) -> int:
        """Return the number of connected publishers."""
        return 0 if self._subscription is None else self._subscription.num_open()

    def _unregister(self) -> None:
        subscription, self._subscription = self._subscription, None
        if subscription is not None:
            subscription.remove(self)

    def detach(self) -> None:
        """Learn that the node has shut down."""
        self._subscription = None
