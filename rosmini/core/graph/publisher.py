"""Publishers: one :class:`Publication` for each node and topic, and a :class:`Publisher` handle for each user of it.

A message goes from here to a :mod:`~rosmini.core.graph.connection` for each subscriber, waits there for its lane
(:mod:`~rosmini.core.graph.lanes`), and is then passed to the user's callbacks (:mod:`~rosmini.core.graph.callbacks`).
"""

from __future__ import annotations

from _thread import get_ident
from functools import partial
from itertools import count
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import ROSException, TransportInitError, TypeMismatch

from .callbacks import TopicHandle
from .connection import QueuedSender
from .mismatch import describe_mismatch, recast
from .transport import set_header

if TYPE_CHECKING:
    from collections.abc import Callable

    from .node import Node
    from .transport import Header, Sender

_NOTHING: Any = object()
"""Marks an argument that was not given."""


def _packet(frozen: Any) -> bytes:
    """Return a message as it is sent over a wire: its length, then its bytes."""
    body = frozen._encode(frozen)
    return b"".join((len(body).to_bytes(4, "little"), body))


class MessageFactory:
    """A message that is made only if it has a receiver: ``publish(MessageFactory(make))`` sends ``make()``.

    Use it for large or frequent messages that usually have no subscriber. A latching publisher makes its last one
    again when a subscriber connects. The data that ``make`` uses must not change afterwards. With ``is_frozen`` the
    result comes from a :func:`rosmini.msgs.template`: no other code holds it, and it is not copied. With
    ``keeps_number`` its header keeps its sequence number, for a message that another node published first.
    """

    __slots__ = ("is_frozen", "keeps_number", "make")

    def __init__(self, make: Callable[[], Any], *, is_frozen: bool = False, keeps_number: bool = False) -> None:
        self.make = make
        self.is_frozen = is_frozen
        self.keeps_number = keeps_number


class Publication:
    """A node's side of a topic that it publishes: the connections, the latched message, the sequence number."""

    def __init__(self, node: Node, topic: str, message_class: Any) -> None:
        self.node = node
        self.topic = topic
        self.message_class = message_class
        self._latch = False
        self.queue_size: int | None = None
        """Maximum number of messages that wait for one connection; None: no limit."""
        self.headers: Header = {}
        """The user's own fields of the connection header; they replace ROS's of the same name, as in rospy."""
        self.handles: list[Publisher] = []
        self.senders: dict[int, Sender] = {}
        self._next_number = count(1).__next__
        self._scheduler = node.scheduler
        self._local: tuple[QueuedSender, ...] = ()
        self._wires: tuple[Sender, ...] = ()
        self._header: Header | None = None
        self._only: QueuedSender | None = None
        """The only connection, if it is in this process and messages need only be sent: the usual case."""
        self._latched: Any = None
        """The last message, frozen, or the `MessageFactory` that makes it."""
        self._latched_original: Any = None
        """What the connections received of a latched factory."""
        self.warns_unheard = True
        """True until the warning about publishing without connections has been logged."""
        self.how_to_wait = "call wait_for_subscribers() first"
        """The advice in that warning."""
        self._has_header = bool(message_class._has_header)
        header: Any = message_class._nested.get("std_msgs/Header") if self._has_header else None
        self._header_class = header
        self._set_number: Any = None if header is None else header._fields_class.seq.__set__
        self._freeze = message_class._freeze
        self._thaw_numpy = message_class._thaw_numpy if message_class._plain_numpy else None

    @property
    def latch(self) -> bool:
        """True if late subscribers get the last message."""
        return self._latch

    @latch.setter
    def latch(self, latch: bool) -> None:
        self._latch = latch
        self.connections_changed()

    def send(self, message: Any, to: str = "") -> None:
        """Send a snapshot of a message, taken now, to every connection, or only to those of the node ``to``.

        May be called from any thread; with a `MessageFactory` only from the scheduler's. Raises
        ``SerializationError``, which names the field, if the message contains a value that its type cannot hold.
        """
        scheduler = self._scheduler
        if type(message) is MessageFactory:
            if self._latch and not (to or self.senders) and scheduler.history is None:
                self._latched, self._latched_original = message, None
                return
            frozen = self._made(message)
            set_header(frozen, self._header)
        else:
            if self._has_header:
                self._number(message)
            frozen = self._freeze(message, self._header)
        if get_ident() != scheduler.thread:
            scheduler.call_soon_threadsafe(partial(self._hand_out, frozen, to, message))
        elif self._only is not None and not to:
            self._only.send(frozen, self.queue_size)
        else:
            self._hand_out(frozen, to, message)

    def _made(self, factory: MessageFactory, *, late: bool = False) -> Any:
        """Return the message of a factory, frozen, and numbered unless it is late."""
        message = factory.make()
        if self._has_header and not factory.keeps_number:
            self._number(message, late=late)
        return message if factory.is_frozen else self._freeze(message)

    def _number(self, message: Any, *, late: bool = False) -> None:
        """Set the sequence number of a header, and the frame if it was never set, as rospy does."""
        header = message.header
        if header.frame_id is None:
            header.frame_id = "0"
        if self.senders and not late:  # rospy numbers only messages that have a receiver
            if type(header) is self._header_class:
                self._set_number(header, self._next_number())
            else:
                header.seq = self._next_number()

    def connections_changed(self) -> None:
        """Choose how :meth:`send` works, after a connection was added or closed, or a recording has begun or ended."""
        senders = self.senders.values()
        self._local = tuple(sender for sender in senders if isinstance(sender, QueuedSender))
        self._wires = tuple(sender for sender in senders if not isinstance(sender, QueuedSender))
        is_simple = len(self._local) == len(senders) == 1 and not self._latch and self._scheduler.history is None
        if senders:
            self.warns_unheard = False  # the warning explains that connections take a moment
        self._only = self._local[0] if is_simple else None
        self._header = None if self._only is None else self._only.header

    def _hand_out(self, frozen: Any, to: str, message: Any) -> None:
        """Pass a frozen message, of `message`, to the connections. Runs in the scheduler's thread."""
        history = self._scheduler.history
        if history is not None:
            history.published(self.node.name, self.topic, frozen)
        if to:
            for sender in [sender for sender in self.senders.values() if sender.destination == to]:
                self._give(sender, frozen, self.queue_size)
            return
        if self._latch:
            if type(message) is MessageFactory:  # to make it again takes less than a copy of each message
                self._latched, self._latched_original = message, frozen
            else:
                self._latched, self._latched_original = self._copy(frozen), None
        size = self.queue_size
        if self._wires:
            packet = _packet(frozen)  # encoded once for all wires
            for wire in self._wires:
                wire.send(packet, size)
        local = self._local
        for sender in local:
            message = frozen if sender is local[0] else self._copy(frozen)
            set_header(message, sender.header)
            sender.send(message, size)
        if not local and not self._wires and self.warns_unheard and not self._latch:
            self._warn_unheard()

    def _give(self, sender: Sender, frozen: Any, size: int | None) -> None:
        if isinstance(sender, QueuedSender):
            message = self._copy(frozen)
            set_header(message, sender.header)
            sender.send(message, size)
        else:
            sender.send(_packet(frozen), size)

    def _copy(self, frozen: Any) -> Any:
        """Return a copy of a frozen message for one receiver, which may write to its arrays."""
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
        """Warn, once for each connection, that messages are dropped."""
        if self.topic in ("/rosout", "/rosout_agg"):
            return
        size = self.queue_size
        queue = "no queue_size, and too many bytes wait" if size is None else f"queue_size={size}"
        self.node.logwarn(
            f"{sender.destination} takes messages on {self.topic} more slowly than {self.node.name} publishes them: "
            f"with {queue}, the oldest are dropped. `rostopic info -v {self.topic}` counts them."
        )

    def accept(self, header: Header, sender: Sender) -> Header:
        """Accept a subscriber's connection; return the header for it.

        Raises ``TransportInitError`` if the md5 sums differ: the type's name does not matter, as in ROS.
        """
        cls = self.message_class
        md5sum = header.get("md5sum")
        if md5sum is None:
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
        if md5sum not in ("*", cls._md5sum):
            theirs = {**header, "callerid": header.get("callerid", "unknown"), "type": header.get("type", "*")}
            problem = TypeMismatch(describe_mismatch(self.topic, mine, theirs))
            self.node.graph.report(problem, self.node, raise_strict=False)
            msg = (
                f"Client [{theirs['callerid']}] wants topic [{self.topic}] to have datatype/md5sum "
                f"[{theirs['type']}/{md5sum}], but our version has [{cls._type}/{cls._md5sum}] Dropping connection."
            )
            raise TransportInitError(msg, mine)
        self.add(sender)
        return mine

    def add(self, sender: Sender) -> None:
        """Add a connection and send it the latched message."""
        if type(self._latched) is MessageFactory:
            self._latched = self._made(self._latched, late=True)
            if self._scheduler.history is not None and self._latched_original is not None:
                self._scheduler.history.same(self._latched, self._latched_original)
            self._latched_original = None
        number = self.node.next_connection_id()
        self.senders[number] = sender
        sender.on_closed = lambda: self.remove(number)
        sender.on_dropped = lambda: self._warn_dropped(sender)
        self.connections_changed()
        if self._latched is not None:
            latched = self._latched
            if self._has_header:
                latched = self._freeze(latched)
                latched.header.seq = self._next_number()
                if self._scheduler.history is not None:
                    self._scheduler.history.same(latched, self._latched)
            self._give(sender, latched, None)
        self.node.connections_changed()
        for handle in self.handles:
            handle.connected(sender.destination)

    def remove(self, number: int) -> None:
        """Remove a connection that its subscriber has closed."""
        sender = self.senders.pop(number, None)
        if sender is not None:
            self.connections_changed()
            self.node.connections_changed()
            for handle in self.handles:
                handle.disconnected(sender.destination)

    def end(self) -> None:
        """Close because the node shuts down: the handles publish no more messages."""
        for handle in self.handles:
            handle.detach()
        self.close()

    def close(self) -> None:
        """Close all connections."""
        for sender in self.senders.values():
            sender.close()
        self.senders.clear()
        self.connections_changed()


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

        Later changes to the message do not change what was sent. A :class:`MessageFactory` makes its message only if
        it has a receiver. Raises ``ROSException`` after :meth:`unregister` or the node's shutdown, ``TypeError`` for a
        message of another type, and ``SerializationError`` for a field of the wrong type.
        """
        publication = self._publication
        if publication is None:
            raise ROSException(self._closed_message())
        if type(message) is self.message_class and not args and not fields:
            publication.send(message)
        else:
            publication.send(self._build(() if message is _NOTHING else (message, *args), fields))

    def expect_nobody(self) -> None:
        """Do not warn about messages that are published without connections."""
        if self._publication is not None:
            self._publication.warns_unheard = False

    def advise(self, how_to_wait: str) -> None:
        """Set the advice, in terms of another API, for the warning about a message without receivers."""
        if self._publication is not None:
            self._publication.how_to_wait = how_to_wait

    def publish_to(self, destination: str, message: Any) -> None:
        """Publish ``message`` only to the node ``destination``; no effect if that is not connected.

        Raises the same exceptions as :meth:`publish`.
        """
        publication = self._publication
        if publication is None:
            raise ROSException(self._closed_message())
        publication.send(message, destination)

    def _build(self, args: tuple[Any, ...], fields: dict[str, Any]) -> Any:
        cls = self.message_class
        if len(args) == 1 and not fields:
            given = args[0]
            if isinstance(given, (cls, MessageFactory)):
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
        """Maximum number of messages waiting for a slow connection before one is dropped; None or 0: no limit."""
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
        """Stop publishing after the node has shut down."""
        self._publication = None
