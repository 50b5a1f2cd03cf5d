"""Publishing: one :class:`Publication` per node and topic, a :class:`Publisher` handle for each who asked for it."""

from __future__ import annotations

from _thread import get_ident
from itertools import count
from sys import maxsize
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import ROSException, TransportInitError, TypeMismatch

from .mismatch import describe_mismatch, recast
from .topic_handle import TopicHandle

if TYPE_CHECKING:
    from collections.abc import Callable

    from .node_port import NodePort
    from .transport import DirectReceiver, Header, Sender


_NOTHING: Any = object()
"""What was not given."""


def _packet(frozen: Any) -> bytes:
    """Return a message as it goes over a wire, its length in front."""
    body = frozen._encode(frozen)
    return b"".join((len(body).to_bytes(4, "little"), body))


class Publication:
    """A node's side of a topic that it publishes: the connections, the latched message, the sequence number."""

    def __init__(self, node: NodePort, topic: str, message_class: Any) -> None:
        self.node = node
        self.topic = topic
        self.message_class = message_class
        self._latch = False
        self._queue_size: int | None = None
        self.headers: Header = {}
        """The user's own fields of the connection header; they replace ROS's of the same name, as in rospy."""
        self.handles: list[Publisher] = []
        self.senders: dict[int, Sender] = {}
        self._next_number = count(1).__next__
        self._scheduler = node.scheduler
        self._list: tuple[Sender, ...] = ()
        self._wires: tuple[Sender, ...] = ()
        self._near: tuple[Sender, ...] = ()
        self.send: Callable[[Any], None] = self._send
        """Sends a message to every connection: a snapshot, taken now. From any thread.

        Raises ``SerializationError``, which names the field, when the message holds what its type cannot hold.
        """
        self.send_frozen: Callable[[Any], None] = self._send_frozen
        """Sends a frozen message that nobody else holds, with the next number in its header. In the hub's thread."""
        self._latched: Any = None
        self._later: Callable[[], Any] | None = None
        self.warns_unheard = True
        self.how_to_wait = "call wait_for_subscribers() first"
        """Whether it warns when it publishes and nobody is connected; it does so once."""
        self._stamp = bool(message_class._has_header)
        header: Any = message_class._nested.get("std_msgs/Header") if self._stamp else None
        self._header_class = header
        self._set_number: Any = None if header is None else header._fields_class.seq.__set__
        self._freeze = message_class._freeze
        self._thaw_numpy = message_class._thaw_numpy if message_class._plain_numpy else None

    @property
    def latch(self) -> bool:
        """Whether late subscribers get the last message."""
        return self._latch

    @latch.setter
    def latch(self, latch: bool) -> None:
        self._latch = latch
        self._connections_changed()

    @property
    def queue_size(self) -> int | None:
        """How many messages wait for one connection; None: no bound."""
        return self._queue_size

    @queue_size.setter
    def queue_size(self, queue_size: int | None) -> None:
        self._queue_size = queue_size
        self._connections_changed()

    def _connections_changed(self) -> None:
        self._list = tuple(self.senders.values())
        self._wires = tuple(sender for sender in self._list if sender.wants_bytes)
        self._near = tuple(sender for sender in self._list if not sender.wants_bytes)
        self.send, self.send_frozen = self._send, self._send_frozen
        if len(self._list) == 1 and not self._latch and self._scheduler.history is None:
            sender = self._list[0]
            if sender.receiver is not None:
                self.send, self.send_frozen = self._ways_to(sender, sender.receiver)

    def _ways_to(
        self, sender: Sender, receiver: DirectReceiver
    ) -> tuple[Callable[[Any], None], Callable[[Any], None]]:
        """Return `send` and `send_frozen` to one receiver in this process: all that publishing most messages costs."""
        freeze, dispatch, scheduler, header = self._freeze, self._dispatch, self._scheduler, receiver.header
        incoming, join, hand_over = receiver.incoming, receiver.incoming.append, sender.send
        size, room = self._queue_size, self._queue_size or maxsize
        number = self._number if self._stamp else None
        set_number, next_number = self._set_number, self._next_number

        def send(message: Any) -> None:
            if number is not None:
                number(message)
            frozen = freeze(message, header)
            if get_ident() != scheduler.thread:
                dispatch(frozen)
            elif receiver.pending and len(incoming) < room:
                join(frozen)
            else:
                hand_over(frozen, size)

        def send_frozen(frozen: Any) -> None:
            if set_number is not None:
                set_number(frozen.header, next_number())
            hand_over(frozen, size)

        return send, send_frozen

    def _send(self, message: Any) -> None:
        if self._stamp:
            self._number(message)
        self._dispatch(self._freeze(message))

    def _number(self, message: Any) -> None:
        """Fill in a header's number, and the frame that was never given, as rospy does."""
        header = message.header
        if header.frame_id is None:
            header.frame_id = "0"
        if self._list:  # rospy numbers only what somebody gets
            if type(header) is self._header_class:
                self._set_number(header, self._next_number())
            else:
                header.seq = self._next_number()

    def _send_frozen(self, frozen: Any) -> None:
        if self._stamp and self._list:
            self._set_number(frozen.header, self._next_number())
        self._hand_out(frozen)

    def send_late(self, make: Callable[[], Any]) -> None:
        """Send the message that ``make`` returns; if only a late subscriber can get it, make it when one comes."""
        if self._list or not self._latch or self._scheduler.history is not None:
            self.send(make())
        else:
            self._latched, self._later = None, make

    def _latch_now(self) -> None:
        """Make the message that waits for a subscriber, as if it had been sent when it was to be."""
        if self._later is not None:
            message, self._later = self._later(), None
            if self._stamp:
                self._number(message)
            self._latched = self._freeze(message)

    def relay(self, message: Any) -> None:
        """Send what another node published first: its header keeps its number, and nobody need listen."""
        frozen = self._freeze(message)
        self._scheduler.on_hub(lambda: self._hand_out(frozen, warn=False))

    def _dispatch(self, frozen: Any) -> None:
        if get_ident() == self._scheduler.thread:
            self._hand_out(frozen)
        else:
            self._scheduler.call_soon_threadsafe(lambda: self._hand_out(frozen))

    def record(self) -> None:
        """Learn that from now on, or no more, it is recorded what happens."""
        self._connections_changed()

    def _hand_out(self, frozen: Any, *, warn: bool = True) -> None:
        if self._scheduler.history is not None:
            self._scheduler.history.published(self.node.name, self.topic, frozen)
        if self._latch:
            self._latched, self._later = self._copy(frozen), None
        senders = self._near
        if not self._list:
            if warn and self.warns_unheard and not self.latch:
                self._warn_unheard()
            return
        size = self._queue_size
        if self._wires:  # encoded once for all of them
            packet = _packet(frozen)
            for wire in self._wires:
                wire.send(packet, size)
        if senders:
            senders[0].send(frozen, size)
            for sender in senders[1:]:
                sender.send(self._copy(frozen), size)

    def send_to(self, destination: str, message: Any) -> None:
        """Send ``message`` to the node ``destination`` only, as rospy's ``peer_publish`` does."""
        frozen = self._freeze(message)
        if self._scheduler.history is not None:
            self._scheduler.history.published(self.node.name, self.topic, frozen)
        for sender in [sender for sender in self._list if sender.destination == destination]:
            self._give(sender, frozen, self.queue_size)

    def _give(self, sender: Sender, frozen: Any, size: int | None) -> None:
        sender.send(_packet(frozen) if sender.wants_bytes else self._copy(frozen), size)

    def _copy(self, frozen: Any) -> Any:
        """Return a frozen message of which one receiver may become the owner."""
        if self._thaw_numpy is None:
            return frozen
        copy = self._thaw_numpy(frozen)
        if self._scheduler.history is not None:
            self._scheduler.history.same(copy, frozen)
        return copy

    def _warn_unheard(self) -> None:
        self.warns_unheard = False
        if self.topic in ("/rosout", "/rosout_agg"):
            return
        self.node.logwarn(
            f"published on {self.topic} while nobody was connected: the message is lost. Connections take a moment: "
            f"{self.how_to_wait}, or publish with latch=True if late subscribers need the last message."
        )

    def _warn_dropped(self, sender: Sender) -> None:
        """Say, once for each connection, that messages are dropped."""
        if self.topic in ("/rosout", "/rosout_agg"):
            return
        size = self._queue_size
        queue = "no queue_size, and too many bytes wait" if size is None else f"queue_size={size}"
        self.node.logwarn(
            f"{sender.destination} takes messages on {self.topic} more slowly than {self.node.name} publishes them: "
            f"with {queue}, the oldest are dropped. `rostopic info -v {self.topic}` counts them."
        )

    def accept(self, header: Header, sender: Sender) -> Header:
        """Take a subscriber's connection.

        Raises ``TransportInitError`` for another md5 sum: the type's name does not matter, as in ROS.
        """
        cls = self.message_class
        wanted = header.get("md5sum")
        if wanted is None:
            msg = "Missing required 'md5sum' field"
            raise TransportInitError(msg)
        fields = {
            "callerid": self.node.name,
            "latching": "1" if self.latch else "0",
            "md5sum": cls._md5sum,
            "message_definition": cls._full_text,
            "topic": self.topic,
            "type": cls._type,
            **self.headers,
        }
        mine = dict(sorted(fields.items()))
        if wanted not in ("*", cls._md5sum):
            theirs = {
                **header,
                "callerid": header.get("callerid", "unknown"),
                "type": header.get("type", "*"),
            }
            problem = TypeMismatch(describe_mismatch(self.topic, mine, theirs))
            self.node.graph.report(problem, self.node, raise_strict=False)
            msg = (
                f"Client [{theirs['callerid']}] wants topic [{self.topic}] to have datatype/md5sum "
                f"[{theirs['type']}/{wanted}], but our version has [{cls._type}/{cls._md5sum}] Dropping connection."
            )
            raise TransportInitError(msg, mine)
        self.add(sender)
        return mine

    def add(self, sender: Sender) -> None:
        """Add a connection and send it what is latched."""
        self._latch_now()
        number = self.node.next_connection_id()
        self.senders[number] = sender
        sender.on_closed = lambda: self.remove(number)
        sender.on_dropped = lambda: self._warn_dropped(sender)
        self._connections_changed()
        if self._latched is not None:
            latched = self._latched
            if self._stamp:
                latched = self._freeze(latched)
                latched.header.seq = self._next_number()
                if self._scheduler.history is not None:
                    self._scheduler.history.same(latched, self._latched)
            self._give(sender, latched, None)
        self.node.connections_changed()
        for handle in self.handles:
            handle.connected(sender.destination)

    def remove(self, number: int) -> None:
        """Forget a connection that its subscriber closed."""
        sender = self.senders.pop(number, None)
        if sender is not None:
            self._connections_changed()
            self.node.connections_changed()
            for handle in self.handles:
                handle.disconnected(sender.destination)

    def end(self) -> None:
        """Close because the node shuts down: the handles publish no more."""
        for handle in self.handles:
            handle.detach()
        self.close()

    def close(self) -> None:
        """Close all connections."""
        for sender in self._list:
            sender.close()
        self.senders.clear()
        self._connections_changed()


class Publisher(TopicHandle):
    """Publishes messages of one type on one topic.

    Made by :meth:`Node.publisher <rosmini.core.graph.node.Node.publisher>`.
    """

    def __init__(
        self,
        publication: Publication,
        on_connect: Callable[[str], object] | None = None,
        on_disconnect: Callable[[str], object] | None = None,
    ) -> None:
        self._publication: Publication | None = publication
        self.node = publication.node
        self.topic = publication.topic
        self.message_class = publication.message_class
        self._on_connect = on_connect
        self._on_disconnect = on_disconnect
        publication.handles.append(self)
        if on_connect is not None:
            for sender in publication.senders.values():
                self.connected(sender.destination)

    def __repr__(self) -> str:
        return f"<Publisher {self.topic} [{self.message_class._type}] of {self.node.name}>"

    def publish(self, message: Any = _NOTHING, /, *args: Any, **fields: Any) -> None:
        """Publish a message, or the message made from the given field values.

        Later changes to the message do not change what was sent. Raises ``ROSException`` after :meth:`unregister` or
        the node's shutdown, ``TypeError`` for a message of another type, and ``SerializationError`` for a field of the
        wrong type.
        """
        publication = self._publication
        if publication is None:
            raise ROSException(self._closed_message())
        if type(message) is self.message_class and not args and not fields:
            publication.send(message)
        else:
            publication.send(self._build(() if message is _NOTHING else (message, *args), fields))

    def publish_late(self, make: Callable[[], Any]) -> None:
        """Publish the message that ``make()`` returns; if only a late subscriber can get it, make it when one comes.

        For large or frequent messages of a latching publisher that mostly nobody hears. What ``make`` uses must not
        change afterwards. In the hub's thread. Raises as :meth:`publish`.
        """
        publication = self._publication
        if publication is None:
            raise ROSException(self._closed_message())
        publication.send_late(make)

    def expect_nobody(self) -> None:
        """Do not warn of messages that are published while nobody is connected."""
        if self._publication is not None:
            self._publication.warns_unheard = False

    def advise(self, how_to_wait: str) -> None:
        """Say so, in the words of another API, in the warning of a message that nobody gets."""
        if self._publication is not None:
            self._publication.how_to_wait = how_to_wait

    def publish_frozen(self, frozen: Any) -> None:
        """Publish what a `rosmini.msgs.template` made, and nobody holds: no snapshot of it is taken.

        For devices, whose hosts call them in the hub's thread. Raises ``ROSException`` as :meth:`publish`.
        """
        publication = self._publication
        if publication is None:
            raise ROSException(self._closed_message())
        publication.send_frozen(frozen)

    def relay(self, message: Any) -> None:
        """Publish a message as it is, with the number in its header: for what another node published first.

        Raises as :meth:`publish`.
        """
        publication = self._publication
        if publication is None:
            raise ROSException(self._closed_message())
        publication.relay(message)

    def publish_to(self, destination: str, message: Any) -> None:
        """Publish ``message`` to one connected node only; harmless when that has gone.

        Raises as :meth:`publish` does.
        """
        publication = self._publication
        if publication is None:
            raise ROSException(self._closed_message())
        self.node.scheduler.on_hub(lambda: publication.send_to(destination, message))

    def _build(self, args: tuple[Any, ...], fields: dict[str, Any]) -> Any:
        cls = self.message_class
        if len(args) == 1 and not fields:
            given = args[0]
            if isinstance(given, cls):
                return given
            if getattr(given, "_md5sum", None) == cls._md5sum:
                return recast(given, cls)
            if hasattr(given, "_md5sum"):
                msg = (
                    f"{self.topic} carries {cls._type}, and publish() was given a {given._type}. "
                    f"Publish a {cls._type}, or make the publisher with the type {given._type}."
                )
                raise TypeError(msg)
        return cls(*args, **fields)

    def _closed_message(self) -> str:
        if self.node.is_shutdown():
            reason = self.node.shutdown_reason or "no reason given"
            return (
                f"publish() on {self.topic} after node {self.node.name} was shut down ({reason}). "
                "Check is_shutdown() in loops."
            )
        return f"publish() on {self.topic} after unregister(): make a new publisher to publish again."

    @property
    def queue_size(self) -> int | None:
        """How many messages wait for a slow connection before the oldest is dropped; None or 0: no bound."""
        publication = self._publication
        return None if publication is None else publication.queue_size

    def num_connections(self) -> int:
        """Return the number of connected subscribers."""
        publication = self._publication
        return 0 if publication is None else len(publication.senders)

    def wait_for_subscribers(self, count: int = 1, timeout: float | None = None) -> None:
        """Block until ``count`` subscribers are connected. Raises ``ROSException`` after ``timeout`` seconds."""
        self.node.wait_until(
            lambda: self.num_connections() >= count,
            timeout,
            f"{count} subscriber{'s' * (count != 1)} of {self.topic}",
            lambda: f"{self.num_connections()} of {count} subscribers of {self.topic} are connected",
        )

    def _unregister(self) -> None:
        publication, self._publication = self._publication, None
        if publication is not None:
            publication.handles.remove(self)
            if not publication.handles:
                self.node.drop_publication(publication)

    def detach(self) -> None:
        """Learn that the node has shut down."""
        self._publication = None
