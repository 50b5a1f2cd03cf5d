"""Subscribing: a :class:`Subscription` per node and topic, a :class:`Connection` with a lane per publisher."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

from rosmini.errors import (
    DefinitionError,
    DeserializationError,
    IllegalName,
    TransportException,
    TransportInitError,
    TransportTerminated,
    TypeMismatch,
    UnknownPackage,
    UnknownType,
)
from rosmini.msgs import message_class
from rosmini.msgs.full_text import class_from

from .callbacks import Callback
from .mismatch import describe_mismatch, recast
from .transport import DirectReceiver, LocalTransport, set_header

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from .node_port import NodePort
    from .transport import Header, Triple


_NO_CLASS = (UnknownType, UnknownPackage, DefinitionError, IllegalName)
"""What is raised where there is no such type, and for a header that names or defines none."""

RETRY_S = 0.5
LONGEST_RETRY_S = 32.0
"""After how many seconds a connection is tried again: twice as many each time, as in rospy."""


def _assign_header(message: Any, header: Header) -> None:
    """Set it on whatever a subscriber of its own kind makes of a message."""
    message._connection_header = header


def _class_of(header: Header, protocol: str, default: Any) -> Any:
    """Return the class of what a connection carries, for subscribers of any type; else ``default``.

    One that this machine does not have, or has otherwise, is made from the definition that the publisher sent; not so
    for messages that stay in the process, which have their class already.
    """
    name, md5sum, text = (header.get(key, "") for key in ("type", "md5sum", "message_definition"))
    makers = [partial(message_class, name)]
    if protocol != LocalTransport.protocol:
        makers.append(partial(class_from, name, text))
    for make in makers:
        try:
            found = make()
        except _NO_CLASS:
            continue
        if found._md5sum == md5sum:
            return found
    return default


class _Way(NamedTuple):
    """How a frozen message reaches the callbacks: its class, what thaws it, what adds the header, what calls each."""

    own: Any
    thaw: Callable[[Any], Any] | None
    label: Callable[[Any, Header], None]
    callbacks: tuple[tuple[Callable[[Any], object], Callback], ...]


class Connection(DirectReceiver):
    """A subscription's link to one publisher: its queue and the lane in which callbacks run."""

    def __init__(self, subscription: Subscription, uri: str) -> None:
        super().__init__()
        node = subscription.node
        self.subscription = subscription
        self.uri = uri
        self.id = node.next_connection_id()
        self.peer = ""
        self.protocol = ""
        self.message_class = subscription.message_class
        self.way: _Way | None = None
        self.is_open = False
        self.was_of_use = False
        """True of one that has ended after messages, and not because what came was none."""
        self.was_left = False
        """Whether the publisher has left the topic while the connection was being made: it may come to nothing."""
        self._gone = False
        self._draining = False
        self._last: Any = None
        self._keep = False
        self._drain_ref = self._drain
        self._close_link: Callable[[], None] | None = None
        self._lane = node.spawn(f"{node.name} <- {subscription.topic}", self._open)

    def _open(self) -> None:
        """Ask the publisher for the topic and connect to it. In the connection's lane."""
        if self._gone:
            return
        subscription = self.subscription
        node = subscription.node
        transport = node.graph.transport
        try:
            code, status, parameters = self._request_topic()
            if code == -1:  # the publisher has left the topic meanwhile
                subscription.gave_up(self)
                return
            if code != 1:
                raise TransportInitError(status)
            header, self._close_link = transport.connect_topic(node.uri, parameters, self._request(), self)
            self.header.update(header)
        except TransportInitError as error:
            self._refused(error)
            return
        except TransportTerminated:  # the publisher went away meanwhile; the Master will say so
            subscription.lost(self, None)
            return
        except TransportException as error:
            if subscription.is_first_failure(self):
                self.peer = node.master.publisher_at(subscription.topic, self.uri)
            self.failed(error)
            return
        self.protocol = parameters[0]
        if self._gone:  # left while the connection was being made
            self._close_link()
            return
        self.peer = self.header.get("callerid", "")
        self._keep = self.header.get("latching") == "1"
        self.is_open, self.was_left = True, False
        if self.message_class is None or self.message_class._type == "*":
            self.message_class = _class_of(self.header, self.protocol, self.message_class)
        for handle in subscription.handles:
            handle.connected(self.peer)
        node.connections_changed()

    def _request_topic(self) -> Triple:
        """Ask the publisher how to connect; -1 says that it does not publish the topic."""
        node, transport = self.subscription.node, self.subscription.node.graph.transport
        return transport.call(
            self.uri, "requestTopic", node.name, self.subscription.topic, transport.offers(node.uri)
        )

    def _has_left(self) -> bool:
        """Tell whether the publisher left between its two answers, which is no reason to complain."""
        try:
            return bool(self._request_topic()[0] == -1)
        except TransportException:
            return True  # if it is there after all, the Master still lists it and says so

    def _request(self) -> Header:
        subscription = self.subscription
        cls = subscription.message_class
        return {
            "callerid": subscription.node.name,
            "md5sum": cls._md5sum,
            "message_definition": cls._full_text,
            "topic": subscription.topic,
            "type": cls._type,
            "tcp_nodelay": "1" if subscription.tcp_nodelay else "0",
        }

    def _refused(self, error: TransportInitError) -> None:
        if self._gone:
            return  # this end left while the connection was being made
        subscription = self.subscription
        subscription.gave_up(self)
        if self.was_left:
            return
        node = subscription.node
        publisher = {"callerid": self.uri, **error.header}
        mine = subscription.message_class._md5sum
        if "type" in publisher and publisher.get("md5sum", mine) != mine:
            text = describe_mismatch(subscription.topic, publisher, self._request())
            problem: Exception = TypeMismatch(text)
        elif self._has_left():
            return
        else:
            who = error.header.get("callerid") or node.master.publisher_at(subscription.topic, self.uri)
            problem = TransportInitError(
                f"{who} refused the connection of {node.name} to {subscription.topic}: {error}"
            )
        problem.__cause__ = error
        node.graph.report(problem, node)

    @property
    def queue_size(self) -> int | None:
        """How many messages may wait for the callbacks."""
        return self.subscription.queue_size

    def begin(self) -> bool:
        """Post a turn of the callbacks, unless something of this connection is under way."""
        self.pending = not self._gone and self._lane.post_if_idle(self._drain_ref)
        return self.pending

    def deliver(self, messages: Iterable[Any]) -> None:
        """Queue frozen messages for the callbacks; beyond the queue size the oldest are dropped."""
        if self._gone:
            return
        for message in messages:
            set_header(message, self.header)
            self.incoming.append(message)
        self._trim()
        if not self.pending and not self._draining:
            self.pending = True
            self._lane.post(self._drain_ref)

    def _trim(self) -> None:
        size = self.subscription.queue_size
        while size and len(self.incoming) > size:
            self.incoming.popleft()
            self.dropped += 1

    @property
    def waiting(self) -> int:
        """How many messages wait for the callbacks."""
        return len(self.incoming)

    def _drain(self) -> None:
        """Call the callbacks for what is queued. In the connection's lane."""
        incoming, take, header = self.incoming, self.incoming.popleft, self.header
        self.pending, self._draining = False, True
        if self.subscription.queue_size:
            self._trim()
        try:
            while incoming:
                way = self.way or self._find_way()
                own, thaw, label, callbacks = way
                while incoming and self.way is way:  # until a callback changes who subscribes
                    self.received += 1
                    message = take()
                    if message.__class__ is not own and own is not None:
                        message = recast(message, own)
                        set_header(message, header)
                    if thaw is not None:
                        message = thaw(message)
                        label(message, header)
                    if self._keep:
                        self._last = message
                    for call, callback in callbacks:
                        try:
                            call(message)
                        except Exception as error:
                            self._failed(error, callback, message)
        finally:
            self._draining = False
            if incoming and not self._gone:
                self.pending = True
                self._lane.post(self._drain_ref)
            elif self.on_drained is not None:
                self.on_drained()

    def _find_way(self) -> _Way:
        self.way = self.subscription.way(self.message_class)
        return self.way

    def _failed(self, error: Exception, callback: Callback, message: Any) -> None:
        subscription = self.subscription
        subscription.node.callback_failed(error, callback.function, subscription.topic, message)

    def _call(self, callback: Callback, message: Any) -> None:
        try:
            callback.caller()(message)
        except Exception as error:
            self._failed(error, callback, message)

    def replay(self, callback: Callback) -> None:
        """Give a late callback the message that the publisher latched, as the others got it."""
        if self._last is not None:
            message = self._last
            self._lane.submit(lambda: self._call(callback, message))

    def closed(self) -> None:
        """Learn that the publisher closed the connection."""
        self._shut()
        self.was_of_use = self.received > 0
        self.subscription.closed(self)

    def failed(self, error: Exception) -> None:
        """Learn that the transport failed and closed the connection."""
        if self._gone:
            return
        self._shut()
        self.was_of_use = self.received > 0 and not isinstance(error, DeserializationError)
        self.subscription.lost(self, error)

    def close(self) -> None:
        """Close the connection: callbacks that have not started do not come."""
        self.incoming.clear()
        if self._close_link is not None:
            self._close_link()
        self._shut()

    def _shut(self) -> None:
        was_open, self.is_open = self.is_open, False
        self._gone = True
        self._close_link = None
        if was_open:
            for handle in self.subscription.handles:
                handle.disconnected(self.peer)
            self.subscription.node.connections_changed()


class Subscription:
    """A node's side of a topic that it subscribes to."""

    def __init__(self, node: NodePort, topic: str, message_class: Any) -> None:
        self.node = node
        self.topic = topic
        self.message_class = message_class
        self.handles: list[Subscriber] = []
        self.connections: dict[str, Connection] = {}
        self.queue_size: int | None = None
        self.tcp_nodelay = False
        """Whether publishers elsewhere are asked to send each message at once."""
        self.updates = 0
        """How many times the Master has told who publishes the topic."""
        self._first: Subscriber | None = None
        self._wanted: dict[str, None] = {}
        self._is_closed = False
        self._attempts: dict[str, int] = {}
        """How many times in a row a connection to a publisher came to nothing."""

    def disagrees_with(self, message_class: Any) -> bool:
        """Tell whether a further subscriber of this node cannot be one with ``message_class``."""
        sums = self.message_class._md5sum, message_class._md5sum
        return "*" not in sums and sums[0] != sums[1]

    def update_publishers(self, uris: Iterable[str]) -> None:
        """Connect to new publishers: what ``publisherUpdate`` asks for.

        As in rospy a connection outlives its registration: the publisher closes it after its last message, which may
        still be on its way, and so may be its answer to who has just connected.
        """
        if self._is_closed:
            return
        self.updates += 1
        self._wanted = wanted = dict.fromkeys(uris)
        self._attempts = {uri: count for uri, count in self._attempts.items() if uri in wanted}
        for uri, link in self.connections.items():
            link.was_left = link.was_left or (uri not in wanted and not link.is_open)
        for uri in wanted:
            if uri not in self.connections:
                self.connections[uri] = Connection(self, uri)

    def publishers_moved(self, uris: Mapping[str, str]) -> None:
        """Take up new addresses of publishers in this process, by the old ones; connections stay as they are."""
        for connection in self.connections.values():
            connection.uri = uris.get(connection.uri, connection.uri)
        self.connections = {connection.uri: connection for connection in self.connections.values()}
        self._wanted = {uris.get(uri, uri): None for uri in self._wanted}

    def forget(self, connection: Connection) -> None:
        """Drop a connection that is closed or was refused."""
        if self.connections.get(connection.uri) is connection:
            del self.connections[connection.uri]

    def gave_up(self, connection: Connection) -> None:
        """Drop a connection that came to nothing; if its publisher left meanwhile and is back, connect to it anew."""
        self.forget(connection)
        if connection.was_left:
            self._connect(connection.uri)

    def closed(self, connection: Connection) -> None:
        """Learn that a publisher closed a connection; if it is on the topic again meanwhile, connect to it anew."""
        self.forget(connection)
        if not self._try_again(connection):
            self._connect(connection.uri)

    def lost(self, connection: Connection, error: Exception | None) -> None:
        """Learn that a connection failed, or could not be made; say so once, and try again if the way allows it."""
        self.gave_up(connection)
        if connection.was_left:
            return
        is_first, was_open = self.is_first_failure(connection), connection.protocol
        again = self._try_again(connection)
        if error is not None and is_first:
            node, who = self.node, connection.peer or connection.uri
            hope = (
                "tried again while the Master lists it" if again else "made again when a publisher registers"
            )
            what = f"{node.name} cannot connect to {who}, which publishes {self.topic} at {connection.uri}"
            if was_open:
                what = f"the connection of {node.name} to {who} on {self.topic} failed and was closed"
                what += f": {type(error).__name__}"
            node.logwarn(f"{what}: {error}. It is {hope}.")

    def is_first_failure(self, connection: Connection) -> bool:
        """Tell whether the attempts before this connection to its publisher, if there were any, had no success."""
        return connection.was_of_use or connection.uri not in self._attempts

    def _try_again(self, connection: Connection) -> bool:
        """Connect again later; each time without a message in between later still, as in rospy.

        At once the first time only: a publisher that closes each connection after a message is not asked all the time.
        """
        uri = connection.uri
        if self._is_closed or not self.handles or uri not in self._wanted:
            return False
        attempt = self._attempts.get(uri, 0)
        attempt = min(attempt, 1) if connection.was_of_use else attempt
        self._attempts[uri] = attempt + 1
        delay = min(RETRY_S * 2 ** (attempt - 1), LONGEST_RETRY_S) if attempt else 0.0
        return self.node.graph.transport.retry(uri, delay, partial(self._connect, uri))

    def _connect(self, uri: str) -> None:
        if not self._is_closed and self.handles and uri in self._wanted and uri not in self.connections:
            self.connections[uri] = Connection(self, uri)

    def add(self, handle: Subscriber) -> None:
        """Add a subscriber of this node; it gets what connected publishers latched.

        All subscribers of a node get the same object, of the kind that the first asked for, as in rospy.
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
        """Remove a subscriber; the last one leaves the topic."""
        self.handles.remove(handle)
        self._changed()
        if not self.handles:
            self.node.drop_subscription(self)

    def _changed(self) -> None:
        sizes = [handle.queue_size for handle in self.handles]
        self.queue_size = None if not all(sizes) else max((size for size in sizes if size), default=None)
        for connection in self.connections.values():
            connection.way = None

    def way(self, message_class: Any) -> _Way:
        """Return how messages of a class reach the callbacks."""
        first = self._first
        callbacks = [handle.callback for handle in self.handles if handle.callback is not None]
        return _Way(
            None if self.message_class._type == "*" else self.message_class,
            None if first is None else first.thaw_for(message_class),
            set_header if first is None or first.receipt is None else _assign_header,
            tuple((callback.caller(), callback) for callback in callbacks),
        )

    def end(self) -> None:
        """Close because the node shuts down: the handles receive no more."""
        for handle in self.handles:
            handle.detach()
        self.close()

    def close(self) -> None:
        """Close all connections; none is made again, whatever news of publishers is still on its way."""
        self._is_closed = True
        for connection in list(self.connections.values()):
            connection.close()
        self.connections.clear()


class Subscriber:
    """Receives messages of one type on one topic. Made by :meth:`Node.subscriber <rosmini.graph.node.Node.subscriber>`.

    ``numpy`` chooses how numeric arrays arrive: as read-only numpy arrays, or as rospy's tuples and bytes. What the
    first subscriber of a node to a topic chose holds for all of that node's.
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
    ) -> None:
        self._subscription: Subscription | None = subscription
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
        subscription = self._subscription
        if subscription is None:
            return 0
        return sum(connection.is_open for connection in subscription.connections.values())

    def unregister(self) -> None:
        """Stop receiving. The topic is left when the node's last subscriber of it has gone. Harmless when repeated."""
        self.node.scheduler.on_hub(self._unregister)

    def _unregister(self) -> None:
        subscription, self._subscription = self._subscription, None
        if subscription is not None:
            subscription.remove(self)

    def detach(self) -> None:
        """Learn that the node has shut down."""
        self._subscription = None

    def connected(self, peer: str) -> None:
        """Learn that a publisher was connected."""
        self._tell(self._on_connect, peer)

    def disconnected(self, peer: str) -> None:
        """Learn that a publisher was disconnected."""
        self._tell(self._on_disconnect, peer)

    def _tell(self, callback: Callable[[str], object] | None, peer: str) -> None:
        if callback is not None:
            self.node.spawn(
                f"{self.node.name} connections of {self.topic}",
                lambda: self.node.guarded(callback, peer, what=f"connection callback of {self.topic}"),
            )
