"""A subscription's link to one publisher, with a lane in which the callbacks run."""

from __future__ import annotations

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
from .transport import DirectReceiver, LocalTransport, refuse, set_header

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from .gates import Chain, Gate
    from .subscription_port import SubscriptionPort
    from .transport import Header, Triple

_NO_CLASS = (UnknownType, UnknownPackage, DefinitionError, IllegalName)
"""What is raised where there is no such type, and for a header that names or defines none."""


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


class Way(NamedTuple):
    """How a frozen message reaches the callbacks: its class, what thaws it, what adds the header, what calls each."""

    own: Any
    thaw: Callable[[Any], Any] | None
    label: Callable[[Any, Header], None]
    callbacks: tuple[tuple[Callable[[Any], object], Callback], ...]


class Connection(DirectReceiver):
    """A subscription's link to one publisher: its queue and the lane in which callbacks run."""

    def __init__(self, subscription: SubscriptionPort, uri: str) -> None:
        super().__init__()
        node = subscription.node
        self.subscription = subscription
        self.uri = uri
        self.id = node.next_connection_id()
        self.peer = ""
        self.protocol = ""
        self.message_class = subscription.message_class
        self.way: Way | None = None
        self.is_open = False
        self.was_of_use = False
        """True of one that has ended after messages, and not because what came was none."""
        self.was_left = False
        """Whether the publisher has left the topic while the connection was being made: it may come to nothing."""
        self._gone = False
        self._gate: Gate | Chain | None = node.graph.gates.gate(subscription.topic, node.name)
        self._draining = False
        self._has_told = False
        self._parks = 0
        self._last: Any = None
        self._keep = False
        self._drain_ref = self._drain
        self._close_link: Callable[[], None] | None = None
        self._lane = node.spawn(f"{node.name} <- {subscription.topic}", self._open)
        self._be_direct(self._gate is None)

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

    def _be_direct(self, is_direct: bool) -> None:
        """Let what is sent join the queue at once, or not: it has to pass a gate then, or comes too late."""
        self._is_direct = is_direct
        self.begin = partial(self._lane.post_if_idle, self._drain_ref) if is_direct else refuse

    def deliver(self, messages: Iterable[Any]) -> None:
        """Queue frozen messages for the callbacks; while one is busy, the oldest beyond the queue size are dropped."""
        if self._gate is None:
            self._accept(messages)
        else:
            self._gate.pass_on(messages, self.peer, self._accept)

    def set_gate(self, gate: Gate | Chain | None) -> None:
        """Let everything that is sent from now on pass a fault, or nothing any more."""
        self._gate = gate
        self._be_direct(gate is None and not self._gone)

    def _accept(self, messages: Iterable[Any]) -> None:
        if self._gone:
            return
        for message in messages:
            set_header(message, self.header)
            self.incoming.append(message)
        if self._lane.waiter is not None:
            self._trim()
        if self._draining or self.pending:
            return
        self.pending = self._is_direct  # else what is sent would join the queue past the gate
        self._lane.post(self._drain_ref)

    def _trim(self) -> None:
        """Drop the oldest messages beyond the queue size: the callback that is running takes longer than they do."""
        size = self.subscription.queue_size
        while size and len(self.incoming) > size:
            self.incoming.popleft()
            self.dropped += 1
        if self.dropped and not self._has_told:
            self._tell_dropped()

    def _tell_dropped(self) -> None:
        """Log on ``/rosout``, once for each connection, that messages are dropped; that may well be meant to be so."""
        self._has_told = True
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
        """How many messages wait for the callbacks."""
        return len(self.incoming)

    def _drain(self) -> None:
        """Call the callbacks for what is queued. In the connection's lane."""
        incoming, take, header = self.incoming, self.incoming.popleft, self.header
        self.pending, self._draining = False, True
        try:
            while incoming:
                way = self.way or self._find_way()
                own, thaw, label, callbacks = way
                while incoming and self.way is way:  # until a callback changes who subscribes
                    self.received += 1
                    message = take()
                    if type(message) is not own and own is not None:
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
                self.pending = self._is_direct
                self._lane.post(self._drain_ref)
            elif self.on_drained is not None:
                self.on_drained()

    def _find_way(self) -> Way:
        way = self.subscription.way(self.message_class)
        if self.subscription.queue_size and way.callbacks:
            self._parks = self._lane.parks
            own_step = self._trim_after_block, Callback(self._trim_after_block, ())
            way = Way(way.own, way.thaw, way.label, (*way.callbacks, own_step))
        way = way if self.subscription.node.scheduler.history is None else self._recorded(way)
        statistics = self.subscription.statistics
        self.way = way = way if statistics is None else statistics.observed(way, self.peer)
        return way

    def _trim_after_block(self, _: Any) -> None:
        """Drop what came while a callback was blocked, beyond the queue size. Called after the callbacks."""
        parks = self._lane.parks
        if parks != self._parks:
            self._parks = parks
            self._trim()

    def _recorded(self, way: Way) -> Way:
        """Return a way on which it is recorded what is delivered, and that callbacks act on it."""
        node, topic, thaw = self.subscription.node, self.subscription.topic, way.thaw
        history = node.scheduler.history
        if not way.callbacks:
            return way
        first = way.callbacks[0][1].function

        def note(message: Any) -> Any:
            history.delivered(node.name, self.peer, topic, message, first)
            return message if thaw is None else thaw(message)

        def forget(_: Any) -> None:
            history.act_on(None)

        callbacks = (*way.callbacks, (forget, Callback(forget, ())))
        return Way(way.own, note, way.label, callbacks)

    def record(self) -> None:
        """Learn that from now on, or no more, it is recorded what happens."""
        self.way = None

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
        self._be_direct(False)
        self._close_link = None
        if was_open:
            for handle in self.subscription.handles:
                handle.disconnected(self.peer)
            self.subscription.node.connections_changed()
