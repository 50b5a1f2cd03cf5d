"""The connection between a publisher and a subscriber: the sending end, the queue, and the lane of the callbacks."""

from __future__ import annotations

from collections import deque
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

from rosmini.core.errors import (
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
from .rosout import LEVELS
from .transport import LOCAL, set_header

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from .scheduler import Scheduler
    from .subscription import Subscription
    from .transport import Header, Triple

_NO_CLASS = (UnknownType, UnknownPackage, DefinitionError, IllegalName)
"""The errors for an unknown type, and for a header without a valid name or definition of a type."""


def _class_of(header: Header, protocol: str, default: Any) -> Any:
    """Return the message class of a connection, for subscribers of any type, or ``default`` if there is none.

    A class that this machine lacks, or has in another version, is made from the definition that the publisher sent.
    Messages that stay in the process already have their class.
    """
    name, md5sum, text = (header.get(key, "") for key in ("type", "md5sum", "message_definition"))
    makers = [partial(message_class, name)]
    if protocol != LOCAL:
        makers.append(partial(class_from, name, text))
    for make in makers:
        try:
            found = make()
        except _NO_CLASS:
            continue
        if found._md5sum == md5sum:
            return found
    return default


class Route(NamedTuple):
    """The steps that pass the frozen messages of a connection to the callbacks."""

    own: Any
    """The class of the messages that the callbacks receive; None for any class."""
    thaw: Callable[[Any], Any] | None
    """Returns a copy of a frozen message for the callbacks; None if they receive the frozen message itself."""
    set_header: Callable[[Any, Header], None]
    callbacks: tuple[tuple[Callable[[Any], object], Callback], ...]


class Observer:
    """Observes the messages of one connection: a recording, statistics, or a fault, which may also hold messages back.

    Its methods are called in the scheduler's thread; by default they change nothing.
    """

    holds_back = False
    """True if :meth:`pass_on` must be called."""

    def pass_on(self, messages: Iterable[Any], peer: str, accept: Callable[[Iterable[Any]], None]) -> None:  # noqa: ARG002
        """Call ``accept``, now or later, with those messages from ``peer`` that are to be delivered."""
        accept(messages)

    def before(self, frozen: Any) -> None:
        """Called before the callbacks get a message. Runs in the connection's lane, as does :meth:`after`."""

    def after(self) -> None:
        """Called when all callbacks have returned."""


def _notify_observers(observers: Iterable[Observer], frozen: Any) -> None:
    """Pass a message to the observers before the callbacks get it; None means that the callbacks have returned."""
    for observer in observers:
        if frozen is None:
            observer.after()
        else:
            observer.before(frozen)


def _nothing() -> None:
    """Do nothing; the default callback."""


IN_FLIGHT = 6 * 2**20
"""Size of a connection's buffers, like those of two sockets [bytes]; further messages wait in the queue."""

OVERHEAD = 64
"""Space that a message takes in these buffers in addition to its content [bytes]."""


class QueuedSender:
    """Collects the messages of a publisher for one subscriber, and delivers them at the scheduler's next event.

    As in rospy, whose threads send while the publisher continues, a burst does not fill the queue. A publisher's queue
    size matters only while the subscriber is so slow that the buffers between the two are full.
    """

    protocol = LOCAL
    info = ""
    __slots__ = (
        "_closed",
        "_queue",
        "_queued",
        "_ready",
        "_receiver",
        "destination",
        "dropped",
        "header",
        "on_closed",
        "on_dropped",
    )

    def __init__(self, scheduler: Scheduler, receiver: Connection, destination: str) -> None:
        self._ready = scheduler.ready
        self._receiver = receiver
        self._queue: deque[Any] = deque()
        self._closed = False
        self.destination = destination
        self.header = receiver.header
        """The connection header, which the publication sets on the messages."""
        self.on_closed: Callable[[], None] = _nothing
        self.on_dropped: Callable[[], None] = _nothing
        self._queued = 0
        self.dropped = 0

    @property
    def sent(self) -> int:
        """Number of messages sent, including dropped ones."""
        return self._queued

    def send(self, frozen: Any, size: int | None) -> None:
        """Queue a message. If the buffers are full and ``size`` messages wait, drop the oldest of these."""
        if size is not None and len(self._queue) >= size and self._is_full(frozen, size, len(self._queue)):
            del self._queue[-size]
            self._drop()
        self._add(frozen)

    def _add(self, frozen: Any) -> None:
        self._queued += 1
        if not self._queue:
            self._ready.append(self._flush)
        self._queue.append(frozen)

    @staticmethod
    def _is_full(frozen: Any, size: int, waiting: int) -> bool:
        """Return True if the buffers and a queue of ``size`` are full when ``waiting`` messages like this one wait."""
        return waiting - size >= IN_FLIGHT // (len(frozen._encode(frozen)) + OVERHEAD)

    def _drop(self) -> None:
        self.dropped += 1
        if self.dropped == 1:
            self.on_dropped()

    def _flush(self) -> None:
        queue = self._queue
        if not self._closed:
            self._receiver.deliver(queue)
        queue.clear()

    def close(self) -> None:
        """Close from the publisher's side: queued messages still arrive, then the receiver is notified."""
        if not self._closed:
            self._ready.append(self._close)

    def _close(self) -> None:
        if not self._closed:
            self._closed = True
            self._receiver.closed()

    def drop(self) -> None:
        """Close from the subscriber's side: no further message arrives, and the publisher is notified."""
        if not self._closed:
            self._closed = True
            self.on_closed()


class LocalSender(QueuedSender):
    """The publisher's end in the same process: appends to the connection's queue unless its callbacks are busy."""

    __slots__ = ("_incoming", "_join")

    def __init__(self, scheduler: Scheduler, receiver: Connection, destination: str) -> None:
        super().__init__(scheduler, receiver, destination)
        self._incoming = receiver.incoming
        self._join = receiver.incoming.append

    @property
    def sent(self) -> int:
        """Number of messages sent, including dropped ones."""
        to = self._receiver
        return self.dropped + len(self._queue) + len(self._incoming) + to.dropped + to.received

    def send(self, frozen: Any, size: int | None) -> None:
        """Hand a message over. If the buffers are full and ``size`` messages wait, drop the oldest of these."""
        receiver = self._receiver
        if size is not None and (waiting := len(self._incoming) + len(self._queue)) >= size:
            self._make_room(frozen, size, waiting)
        if receiver.pending or (not self._queue and receiver.begin()):
            self._join(frozen)
        else:
            self._add(frozen)

    def _make_room(self, frozen: Any, size: int, waiting: int) -> None:
        if self._is_full(frozen, size, waiting):
            if len(self._queue) >= size:
                del self._queue[-size]
            else:
                del self._incoming[len(self._queue) - size]
            self._drop()


class Connection:
    """A subscription's link to one publisher: its queue and the lane that runs the callbacks."""

    def __init__(self, subscription: Subscription, uri: str) -> None:
        node = subscription.node
        self.subscription = subscription
        self.uri = uri
        self.id = node.next_connection_id()
        self.peer = ""
        self.protocol = ""
        self.header: Header = {}
        """The publisher's connection header, which every message carries; always the same dictionary."""
        self.message_class = subscription.message_class
        self.route: Route | None = None
        """None until the next message sets it."""
        self.incoming: deque[Any] = deque()
        """The frozen messages that are waiting for the callbacks, oldest first."""
        self.pending = False
        """True while the callbacks are about to run: the sender may append to ``incoming`` itself."""
        self.received = 0
        """Number of messages passed to the callbacks."""
        self.dropped = 0
        """Number of messages dropped because too many were waiting."""
        self._batch_end = 0
        """The value of ``received`` after the batch that the callbacks are working through."""
        self.bytes_received = 0
        """Number of message bytes received over a wire."""
        self.info = ""
        """The connection's description in ``getBusInfo``; empty if the peer's name is enough."""
        self.on_drained: Callable[[], None] | None = None
        """Called when the callbacks have taken all messages; a wire that holds more back then continues."""
        self.is_open = False
        self.had_success = False
        """True if the connection received messages before it ended, and did not end with one that cannot be decoded."""
        self.publisher_left = False
        """True if the publisher left the topic while the connection was being made, so that it may fail."""
        self._is_over = False
        self._observers: tuple[Observer, ...] = ()
        self._filters: tuple[Observer, ...] = ()
        self._draining = False
        self._has_reported_drops = False
        self._last: Any = None
        self._is_latching = False
        self._drain_ref = self._drain
        self._close_link: Callable[[], None] | None = None
        self._lane = node.spawn(f"{node.name} <- {subscription.topic}", self._open)
        self.observe()

    def _open(self) -> None:
        """Ask the publisher for the topic and connect to it. Runs in the connection's lane."""
        if self._is_over:
            return
        subscription = self.subscription
        node = subscription.node
        transport = node.graph.transport
        try:
            code, status, parameters = self._request_topic()
            if code == -1:  # the publisher has already left the topic
                subscription.abandon(self)
                return
            if code != 1:
                raise TransportInitError(status)
            header, self._close_link = transport.connect_topic(node.uri, parameters, self._request(), self)
            self.header.update(header)
        except TransportInitError as error:
            self._refused(error)
            return
        except TransportTerminated:  # the publisher has gone; the Master will send an update
            subscription.lost(self, None)
            return
        except TransportException as error:
            if subscription.is_first_failure(self):
                self.peer = node.master.publisher_at(subscription.topic, self.uri)
            self.failed(error)
            return
        self.protocol = parameters[0]
        if self._is_over:  # left while the connection was being made
            self._close_link()
            return
        self.peer = self.header.get("callerid", "")
        self._is_latching = self.header.get("latching") == "1"
        self.is_open, self.publisher_left = True, False
        if self.message_class is None or self.message_class._type == "*":
            self.message_class = _class_of(self.header, self.protocol, self.message_class)
        for handle in subscription.handles:
            handle.connected(self.peer)
        node.connections_changed()

    def _request_topic(self) -> Triple:
        """Ask the publisher how to connect; code -1 means that it does not publish the topic."""
        node, transport = self.subscription.node, self.subscription.node.graph.transport
        return transport.call(self.uri, "requestTopic", node.name, self.subscription.topic, transport.offers(node.uri))

    def _has_left(self) -> bool:
        """Return True if the publisher has left the topic since its first response, which is not an error."""
        try:
            return bool(self._request_topic()[0] == -1)
        except TransportException:
            return True  # treat it as gone; if it still exists, it remains in the Master's list

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
        if self._is_over:
            return  # this end left while the connection was being made
        subscription = self.subscription
        subscription.abandon(self)
        if self.publisher_left:
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
    def first_callback(self) -> Any:
        """The first callback of the subscription; None if it has none."""
        callbacks = self._find_route().callbacks
        return callbacks[0][1].function if callbacks else None

    @property
    def queue_size(self) -> int | None:
        """Maximum number of messages that wait for the callbacks; None for no limit."""
        return self.subscription.queue_size

    def observe(self) -> None:
        """Get the observers of this connection from the graph; called again when they change."""
        self._observers = tuple(self.subscription.observers(self))
        self._filters = tuple(observer for observer in self._observers if observer.holds_back)
        self.route = None

    def begin(self) -> bool:
        """Schedule the callbacks for a message that the sender is about to append to ``incoming``.

        Return False if they are busy or if messages are held back: the message must then be delivered later.
        """
        if self._filters or self._is_over or not self._lane.post_if_idle(self._drain_ref):
            return False
        self.pending = True
        return True

    def deliver(self, messages: Iterable[Any]) -> None:
        """Queue frozen messages for the callbacks; while a callback blocks, drop the oldest beyond the queue size."""
        accept = self._accept
        for observer in reversed(self._filters):
            accept = partial(observer.pass_on, peer=self.peer, accept=accept)
        accept(messages)

    def _accept(self, messages: Iterable[Any]) -> None:
        if self._is_over:
            return
        for message in messages:
            set_header(message, self.header)
            self.incoming.append(message)
        if self._lane.waiter is not None:
            self._trim()
        if not self._draining and not self.pending:
            self._post()

    def _post(self) -> None:
        """Schedule the callbacks; messages sent meanwhile join the queue, unless they must pass a filter."""
        self.pending = not self._filters and not self._is_over
        self._lane.post(self._drain_ref)

    def _trim(self) -> None:
        """Drop the oldest messages beyond the queue size: the running callback is slower than the publisher."""
        size, incoming = self.subscription.queue_size, self.incoming
        batch = max(0, self._batch_end - self.received)
        while size and len(incoming) > size + batch:
            del incoming[batch]
            self.dropped += 1
        if self.dropped and not self._has_reported_drops:
            self._report_drops()

    def _report_drops(self) -> None:
        """Log on ``/rosout``, once for each connection, that messages are dropped, which may be intended."""
        self._has_reported_drops = True
        subscription = self.subscription
        node, topic = subscription.node, subscription.topic
        if topic not in ("/rosout", "/rosout_agg"):
            node.logger.log(
                LEVELS["INFO"],
                f"the callback of {node.name} takes messages on {topic} more slowly than {self.peer} publishes them: "
                f"with queue_size={subscription.queue_size}, the oldest are dropped. `rostopic info -v {topic}` counts "
                "them.",
                is_shown=False,
            )

    @property
    def waiting(self) -> int:
        """Number of messages that are waiting for the callbacks."""
        return len(self.incoming)

    def _drain(self) -> None:
        """Call the callbacks for the queued messages. Runs in the connection's lane."""
        incoming, take, header, lane = self.incoming, self.incoming.popleft, self.header, self._lane
        self.pending, self._draining = False, True
        parks, is_latching = lane.parks, self._is_latching
        try:
            while incoming:
                own, thaw, set_own_header, callbacks = route = self._find_route()
                observers, size = self._observers, self.subscription.queue_size
                while incoming and self.route is route:  # until a callback changes the subscribers
                    self.received += 1
                    message = take()
                    if observers:
                        _notify_observers(observers, message)
                    if type(message) is not own and own is not None:
                        message = recast(message, own)
                        set_header(message, header)
                    if thaw is not None:
                        message = thaw(message)
                        set_own_header(message, header)
                    if is_latching:
                        self._last = message
                    for call, callback in callbacks:
                        try:
                            call(message)
                        except Exception as error:
                            self._failed(error, callback, message)
                    if observers:
                        _notify_observers(observers, None)
                    if size and parks != lane.parks:  # a callback has blocked: messages may have piled up
                        parks = lane.parks
                        self._trim()
                        if self.subscription.takes_batches and self.received >= self._batch_end:
                            self._batch_end = self.received + len(incoming)
        finally:
            self._draining = False
            if incoming and not self._is_over:
                self._post()
            elif self.on_drained is not None:
                self.on_drained()

    def _find_route(self) -> Route:
        route = self.route
        if route is None:
            route = self.route = self.subscription.route(self.message_class)
        return route

    def _failed(self, error: Exception, callback: Callback, message: Any) -> None:
        subscription = self.subscription
        subscription.node.callback_failed(error, callback.function, subscription.topic, message)

    def _call(self, callback: Callback, message: Any) -> None:
        try:
            callback.caller()(message)
        except Exception as error:
            self._failed(error, callback, message)

    def replay(self, callback: Callback) -> None:
        """Pass the publisher's latched message, if any, to a callback that was added later."""
        if self._last is not None:
            message = self._last
            self._lane.submit(lambda: self._call(callback, message))

    def closed(self) -> None:
        """Clean up after the publisher has closed the connection."""
        self._shut()
        self.had_success = self.received > 0
        self.subscription.closed(self)

    def failed(self, error: Exception) -> None:
        """Clean up after the transport has failed and closed the connection."""
        if self._is_over:
            return
        self._shut()
        self.had_success = self.received > 0 and not isinstance(error, DeserializationError)
        self.subscription.lost(self, error)

    def close(self) -> None:
        """Close the connection; callbacks that have not started will not run."""
        self.incoming.clear()
        if self._close_link is not None:
            self._close_link()
        self._shut()

    def _shut(self) -> None:
        was_open, self.is_open = self.is_open, False
        self._is_over = True
        self._close_link = None
        if was_open:
            for handle in self.subscription.handles:
                handle.disconnected(self.peer)
            self.subscription.node.connections_changed()
