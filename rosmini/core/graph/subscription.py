"""Subscribers: one :class:`Subscription` per node and topic, and a :class:`Subscriber` handle per callback."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from .callbacks import Callback, TopicHandle
from .connection import Connection, Route
from .transport import set_header

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from .connection import Observer
    from .node import Node
    from .observers.topic_statistics import TopicStatistics
    from .transport import Header

RETRY_S = 0.5
MAX_RETRY_S = 32.0
"""Bounds of the delay before a connection is tried again [s]; it doubles each time, as in rospy."""


def _assign_header(message: Any, header: Header) -> None:
    """Set the connection header on an object into which a subscriber's ``receipt`` has converted a message."""
    message._connection_header = header


class Subscription:
    """A node's side of a topic that it subscribes to."""

    def __init__(self, node: Node, topic: str, message_class: Any) -> None:
        self.node = node
        self.topic = topic
        self.message_class = message_class
        self.handles: list[Subscriber] = []
        self.connections: dict[str, Connection] = {}
        self.queue_size: int | None = None
        self.takes_batches = False
        self.tcp_nodelay = False
        """True if publishers in other processes should send each message at once."""
        self.skips_own_mismatch = False
        """True if there is no report when the node itself publishes the topic with another type."""
        self.statistics: TopicStatistics | None = None
        """The statistics of the connections, if they are enabled."""
        self.updates = 0
        """Number of lists of the topic's publishers received from the Master."""
        self._first: Subscriber | None = None
        self._publishers: dict[str, None] = {}
        self._is_closed = False
        self._attempts: dict[str, int] = {}
        """Number of consecutive failed connections to each publisher."""

    def disagrees_with(self, message_class: Any) -> bool:
        """Return True if this node cannot also subscribe with ``message_class``."""
        sums = self.message_class._md5sum, message_class._md5sum
        return "*" not in sums and sums[0] != sums[1]

    def update_publishers(self, uris: Iterable[str]) -> None:
        """Connect to those of the publishers at ``uris``, the Master's latest list, that are not connected yet.

        As in rospy, a connection outlives its registration: the publisher closes it after its last message, which may
        still be on its way, as may its response to a node that has just connected.
        """
        if self._is_closed:
            return
        self.updates += 1
        self._publishers = publishers = dict.fromkeys(uri for uri in uris if not self._is_skipped(uri))
        self._attempts = {uri: count for uri, count in self._attempts.items() if uri in publishers}
        for uri, link in self.connections.items():
            link.publisher_left = link.publisher_left or (uri not in publishers and not link.is_open)
        for uri in publishers:
            if uri not in self.connections:
                self.connections[uri] = Connection(self, uri)

    def _is_skipped(self, uri: str) -> bool:
        """Return True if this is the node itself, which intentionally publishes another type."""
        if not self.skips_own_mismatch or uri != self.node.uri:
            return False
        own = self.node.publications.get(self.topic)
        return own is not None and self.disagrees_with(own.message_class)

    def publishers_moved(self, uris: Mapping[str, str]) -> None:
        """Replace old addresses of publishers in this process by new ones; connections stay open."""
        for connection in self.connections.values():
            connection.uri = uris.get(connection.uri, connection.uri)
        self.connections = {connection.uri: connection for connection in self.connections.values()}
        self._publishers = {uris.get(uri, uri): None for uri in self._publishers}

    def forget(self, connection: Connection) -> None:
        """Drop a connection that was closed or refused."""
        if self.connections.get(connection.uri) is connection:
            del self.connections[connection.uri]

    def abandon(self, connection: Connection) -> None:
        """Drop a failed connection; reconnect if its publisher has left and come back meanwhile."""
        self.forget(connection)
        if connection.publisher_left:
            self._connect(connection.uri)

    def closed(self, connection: Connection) -> None:
        """Drop a connection that its publisher has closed; reconnect if the Master still lists the publisher."""
        self.forget(connection)
        if not self._try_again(connection):
            self._connect(connection.uri)

    def lost(self, connection: Connection, error: Exception | None) -> None:
        """Drop a connection that has failed or could not be made; warn once, and retry if the transport allows it."""
        self.abandon(connection)
        if connection.publisher_left:
            return
        is_first, was_open = self.is_first_failure(connection), connection.protocol
        again = self._try_again(connection)
        if error is not None and is_first:
            node, who = self.node, connection.peer or connection.uri
            hope = "tried again while the Master lists it" if again else "made again when a publisher registers"
            what = f"{node.name} cannot connect to {who}, which publishes {self.topic} at {connection.uri}"
            if was_open:
                what = f"the connection of {node.name} to {who} on {self.topic} failed and was closed"
                what += f": {type(error).__name__}"
            node.logwarn(f"{what}: {error}. It is {hope}.")

    def is_first_failure(self, connection: Connection) -> bool:
        """Return True if this is the first failure with its publisher since a successful connection."""
        return connection.had_success or connection.uri not in self._attempts

    def _try_again(self, connection: Connection) -> bool:
        """Connect again later, after a delay that grows with each attempt that brings no message, as in rospy.

        Return False if there will be no attempt. Only the first attempt is immediate, so that a publisher which closes
        after each message is not called all the time.
        """
        uri = connection.uri
        if self._is_closed or not self.handles or uri not in self._publishers:
            return False
        attempt = self._attempts.get(uri, 0)
        attempt = min(attempt, 1) if connection.had_success else attempt
        self._attempts[uri] = attempt + 1
        delay = min(RETRY_S * 2 ** (attempt - 1), MAX_RETRY_S) if attempt else 0.0
        return self.node.graph.transport.retry(uri, delay, partial(self._connect, uri))

    def _connect(self, uri: str) -> None:
        if not self._is_closed and self.handles and uri in self._publishers and uri not in self.connections:
            self.connections[uri] = Connection(self, uri)

    def add(self, handle: Subscriber) -> None:
        """Add a subscriber of this node; it gets the latched messages of connected publishers.

        All subscribers of a node get the same object, in the form that the first one requested, as in rospy.
        """
        first = self._first = self._first or handle
        self.handles.append(handle)
        self._changed()
        if handle.wants_other_than(first):
            self.node.logwarn(
                f"{self.node.name} subscribes to {self.topic} already, as {first.wish}: "
                f"this subscriber of {handle.wish} gets the same messages, as in rospy. "
                "Subscribe in another node, or give both the same type."
            )
        if handle.callback is not None:
            for connection in self.connections.values():
                connection.replay(handle.callback)

    def remove(self, handle: Subscriber) -> None:
        """Remove a subscriber; leave the topic with the last one."""
        self.handles.remove(handle)
        self._changed()
        if not self.handles:
            if self.statistics is not None:
                self.statistics.close()
            self.node.drop_subscription(self)

    def num_open(self) -> int:
        """Return the number of connected publishers."""
        return sum(connection.is_open for connection in self.connections.values())

    def _changed(self) -> None:
        sizes = [handle.queue_size for handle in self.handles]
        self.queue_size = None if not all(sizes) else max((size for size in sizes if size), default=None)
        self.takes_batches = any(handle.takes_batches for handle in self.handles)
        for connection in self.connections.values():
            connection.route = None

    def observers(self, connection: Connection) -> list[Observer]:
        """Return the observers of a connection: faults, the recording, and the statistics of the topic."""
        found = self.node.graph.observers(connection)
        return found if self.statistics is None else [*found, self.statistics.observer(connection)]

    def route(self, message_class: Any) -> Route:
        """Return the steps that pass frozen messages of a class to the callbacks."""
        first = self._first
        callbacks = [handle.callback for handle in self.handles if handle.callback is not None]
        return Route(
            None if self.message_class._type == "*" else self.message_class,
            None if first is None else first.thaw_for(message_class),
            set_header if first is None or first.receipt is None else _assign_header,
            tuple((callback.caller(), callback) for callback in callbacks),
        )

    def end(self) -> None:
        """Close because the node shuts down: the handles receive no more messages."""
        for handle in self.handles:
            handle.detach()
        self.close()

    def close(self) -> None:
        """Close all connections; none is made again, even if further updates of publishers arrive."""
        self._is_closed = True
        for connection in list(self.connections.values()):
            connection.close()
        self.connections.clear()


class Subscriber(TopicHandle):
    """Receives messages of one type on one topic. Made by ``Node.subscriber``.

    ``numpy`` chooses how numeric arrays arrive: as read-only numpy arrays, or as rospy's tuples and bytes. The choice
    of a node's first subscriber to a topic applies to all its subscribers to that topic.
    """

    def __init__(
        self,
        subscription: Subscription,
        message_class: Any,
        callback: Callable[..., object] | None,
        arguments: tuple[Any, ...] = (),
        *,
        queue_size: int | None = None,
        numpy: bool = True,
        on_connect: Callable[[str], object] | None = None,
        on_disconnect: Callable[[str], object] | None = None,
        receipt: Callable[[Any], Callable[[Any], Any] | None] | None = None,
        takes_batches: bool = False,
    ) -> None:
        self._subscription: Subscription | None = subscription
        self.node = subscription.node
        self.topic = subscription.topic
        self.message_class = message_class
        self.queue_size = queue_size
        self.callback = None if callback is None else Callback(callback, arguments)
        self._numpy = numpy
        self.receipt = receipt
        self.takes_batches = takes_batches
        self._on_connect = on_connect
        self._on_disconnect = on_disconnect
        subscription.add(self)

    def __repr__(self) -> str:
        return f"<Subscriber {self.topic} [{self.message_class._type}] of {self.node.name}>"

    def thaw_for(self, message_class: Any) -> Callable[[Any], Any] | None:
        """Return a function that converts a frozen message to this subscriber's own object; None if none is needed."""
        if self.receipt is not None:
            return self.receipt(message_class)
        thaw: Callable[[Any], Any] | None = message_class._thawer(numpy=self._numpy)
        return thaw

    @property
    def wish(self) -> str:
        """A description of the requested messages."""
        if self.message_class._type == "*":
            return "messages of any type"
        arrays = " with numpy arrays" if self._numpy or self.receipt is not None else ""
        return f"{self.message_class._type}{arrays}"

    def wants_other_than(self, other: Subscriber) -> bool:
        """Return True if this subscriber would get a different object from ``other`` for the same message."""
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
        """Stop receiving messages after the node has shut down."""
        self._subscription = None
