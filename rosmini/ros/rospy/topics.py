"""Publishers and subscribers: http://wiki.ros.org/rospy/Overview/Publishers%20and%20Subscribers."""

from __future__ import annotations

import inspect
import warnings
from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import IllegalName, ROSException, ROSSerializationException, SerializationError
from rosmini.core.graph.scheduler import CALL_TICKS
from rosmini.core.graph.transport import extra_fields
from rosmini.core.names import is_legal_name
from rosmini.msgs.importer import how_to_import
from rosmini.msgs.message import Message

from .msg import AnyMsg, args_kwds_to_message
from .session import current_node, current_session

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph import Node

__all__ = ["Message", "Publisher", "SubscribeListener", "Subscriber", "Topic"]

DEFAULT_BUFF_SIZE = 65536


def check_message_class(data_class: Any) -> None:
    """Raise ``ValueError`` unless ``data_class`` is a message class."""
    if data_class is None:
        raise ValueError(
            "topic parameter 'data_class' is not initialized: give a message class, such as std_msgs.msg.String"
        )
    if not inspect.isclass(data_class):
        hint = how_to_import(data_class) or "give the message class itself, such as std_msgs.msg.String"
        raise ValueError(f"data_class [{data_class!r}] is not a class: {hint}")
    if not issubclass(data_class, Message):
        hint = (
            " (it is a class of another ROS installation; import messages after rosmini)"
            if hasattr(data_class, "_md5sum")
            else ""
        )
        raise ValueError(  # noqa: TRY004 - what rospy raises
            f"data_class [{data_class.__name__}] is not a message data class{hint}"
        )


def registered_class(data_class: Any) -> Any:
    """Return the class of the topic: ``T`` for ``numpy_msg(T)``."""
    return getattr(data_class, "_plain_type", data_class)


def receipt_of(data_class: Any) -> Callable[[Any], Callable[[Any], Any] | None] | None:
    """Return the conversion of received messages for ``data_class``: see ``Subscriber.thaw_for`` of the graph."""
    if issubclass(data_class, AnyMsg):
        return lambda _: AnyMsg.received
    receive = getattr(data_class, "_receive", None)
    return None if receive is None else lambda _: receive


def resolve_early(name: Any, what: str) -> str:
    """Return the global name of a topic or service; also works before ``init_node``.

    Raises ``ValueError`` for an invalid name, and for a private one before ``init_node``.
    """
    if not isinstance(name, str) or not name:
        raise ValueError(f"{what} name is not a non-empty string: {name!r}")
    node = current_node()
    if node is not None:
        return node.resolve(name)
    if name.startswith("~"):
        raise IllegalName(
            f"{name}: private names cannot be used before init_node() has been called, because the node has no name yet"
        )
    return current_session().unnamed().resolve(name)


class Topic(ABC):
    """Base class of publishers and subscribers."""

    def __init__(self, name: str, data_class: Any) -> None:
        check_message_class(data_class)
        self.resolved_name = self.name = resolve_early(name, "topic")
        if not is_legal_name(name):
            warnings.warn(
                f"'{name}' is not a legal ROS graph resource name. This may cause problems with other ROS tools: "
                f"write {self.resolved_name}",
                stacklevel=3,
            )
        self.data_class = data_class
        self.type = data_class._type
        self.md5sum = data_class._md5sum
        self._given_name = name
        self._handle: Any = None
        self._unregistered = False

    def _begin(self) -> None:
        """Register with the node now, or as soon as there is one."""
        node = current_node()
        if node is not None:
            self._register(node)
        else:
            current_session().pending.append(self._register_later)

    def _register_later(self, node: Node) -> None:
        if not self._unregistered:
            self._register(node)

    @abstractmethod
    def _register(self, node: Node) -> None:
        """Create the node's own publisher or subscriber."""

    def get_num_connections(self) -> int:
        """Return the number of nodes to which this topic is connected."""
        handle = self._handle
        if handle is None:
            return 0
        handle.node.scheduler.charge(CALL_TICKS)
        return int(handle.num_connections())

    def unregister(self) -> None:
        """Leave the topic; may be called repeatedly."""
        self._unregistered = True
        handle, self._handle = self._handle, None
        if handle is not None:
            handle.unregister()


class SubscribeListener:
    """Receives notice of a publisher's subscribers; pass one as ``subscriber_listener``."""

    def peer_subscribe(
        self, topic_name: str, topic_publish: Callable[..., object], peer_publish: Callable[..., object]
    ) -> None:
        """Handle a new subscriber; ``topic_publish`` publishes to all, ``peer_publish`` to the new one only."""

    def peer_unsubscribe(self, topic_name: str, num_peers: int) -> None:
        """Handle the departure of a subscriber; ``num_peers`` remain."""


class Publisher(Topic):
    """Publishes messages of one type on one topic.

    Args:
        name: the topic.
        data_class: the type of its messages.
        subscriber_listener: notified of subscribers.
        tcp_nodelay: accepted for compatibility: messages are always sent at once.
        latch: send late subscribers the last message.
        headers: additional fields of the connection header, which subscribers find in ``message._connection_header``.
        queue_size: maximum number of messages queued for a subscriber before the oldest is dropped; 0: no limit.

    Raises ``ValueError`` for an illegal name, an invalid message class and for headers that are not texts.

    """

    def __init__(
        self,
        name: str,
        data_class: Any,
        subscriber_listener: SubscribeListener | None = None,
        tcp_nodelay: bool = False,  # noqa: ARG002 - rospy's signature
        latch: bool = False,
        headers: dict[str, str] | None = None,
        queue_size: int | None = None,
    ) -> None:
        super().__init__(name, data_class)
        if queue_size is None:
            warnings.warn(
                f"give the publisher of {self.resolved_name} a queue_size, such as queue_size=10: without one rospy "
                "publishes synchronously, so a slow subscriber holds it up "
                "(http://wiki.ros.org/rospy/Overview/Publishers%20and%20Subscribers)",
                SyntaxWarning,
                stacklevel=2,
            )
        if data_class is AnyMsg:
            raise ValueError(
                f"{self.resolved_name}: a publisher needs the type of its topic, and AnyMsg stands for any"
            )
        self._headers = extra_fields(headers)
        self._listener = subscriber_listener
        self._latch = latch
        self._queue_size = queue_size
        self._warned = False
        self._begin()

    def _register(self, node: Node) -> None:
        listener = self._listener
        self._handle = node.publisher(
            self._given_name,
            registered_class(self.data_class),
            queue_size=self._queue_size,
            latch=self._latch,
            headers=self._headers,
            on_connect=None if listener is None else self._peer_came,
            on_disconnect=None if listener is None else self._peer_went,
        )
        self._handle.advise("wait while get_num_connections() is 0")

    def publish(self, *args: Any, **kwds: Any) -> None:
        """Publish a message, or one made from its fields: all in order, or some by name.

        Raises ``ROSException`` before ``init_node`` and after :meth:`unregister`, ``ROSSerializationException`` for a
        field of the wrong type and ``TypeError`` for a message of another type. After a shutdown the message is lost,
        as in rospy.
        """
        handle = self._handle
        if handle is None:
            raise ROSException(self._why_not())
        if len(args) != 1 or kwds or type(args[0]) is not self.data_class:
            message = args_kwds_to_message(registered_class(self.data_class), args, kwds)
        else:
            message = args[0]
        handle.node.scheduler.charge(CALL_TICKS)
        try:
            handle.publish(message)
        except SerializationError as error:
            raise ROSSerializationException(str(error)) from error
        except ROSException as error:
            self._refused(error)

    def _why_not(self) -> str:
        if self._unregistered:
            return f"publish() to an unregistered() handle: {self.resolved_name} was given up; make a new Publisher"
        return (
            f"publish() on {self.resolved_name}: ROS node has not been initialized yet. "
            "Please call rospy.init_node('name') first"
        )

    def _refused(self, error: ROSException) -> None:
        """Log once that a message after the shutdown is lost; rospy neither logs it nor raises."""
        node: Node = self._handle.node
        if not node.is_shutdown():
            raise error
        if not self._warned:
            self._warned = True
            node.logwarn(error)

    def _peer_came(self, peer: str) -> None:
        listener, handle = self._listener, self._handle
        if listener is None or handle is None:
            return

        def peer_publish(*args: Any, **kwds: Any) -> None:
            handle.publish_to(peer, args_kwds_to_message(registered_class(self.data_class), args, kwds))

        listener.peer_subscribe(self.resolved_name, self.publish, peer_publish)

    def _peer_went(self, _peer: str) -> None:
        if self._listener is not None:
            self._listener.peer_unsubscribe(self.resolved_name, self.get_num_connections())


class Subscriber(Topic):
    """Calls ``callback(message)``, or ``callback(message, callback_args)``, for each message on a topic.

    Args:
        name: the topic.
        data_class: the type of its messages; ``rospy.AnyMsg`` accepts any, ``numpy_msg(T)`` gives numpy arrays.
        callback: called for each message; numeric arrays are tuples, and ``uint8[]`` is bytes.
        callback_args: a second argument for the callback, unless it is None.
        queue_size: maximum number of messages queued during a callback before the oldest is dropped; None: no limit.
            When the callback returns, it gets all of these before newer ones.
        buff_size: accepted for compatibility; available data is always read at once.
        tcp_nodelay: ask publishers in other processes to send each message at once; rosmini's always do.

    Raises ``ValueError`` for an illegal name or an invalid message class, ``ROSException`` for an invalid queue
    size.

    """

    def __init__(
        self,
        name: str,
        data_class: Any,
        callback: Callable[..., object] | None = None,
        callback_args: Any = None,
        queue_size: int | None = None,
        buff_size: int = DEFAULT_BUFF_SIZE,
        tcp_nodelay: bool = False,
    ) -> None:
        super().__init__(name, data_class)
        _check_sizes(queue_size, buff_size)
        self._tcp_nodelay = tcp_nodelay
        self.callback = callback
        self.callback_args = callback_args
        self._queue_size = queue_size
        self._begin()

    def _register(self, node: Node) -> None:
        self._handle = node.subscriber(
            self._given_name,
            registered_class(self.data_class),
            self.callback,
            arguments=() if self.callback_args is None else (self.callback_args,),
            queue_size=self._queue_size if self._queue_size is None or self._queue_size > 0 else None,
            numpy=False,
            receipt=receipt_of(self.data_class),
            tcp_nodelay=self._tcp_nodelay,
            takes_batches=True,
        )


def _check_sizes(queue_size: Any, buff_size: Any) -> None:
    if queue_size == 0:
        raise ROSException("queue size may not be set to zero: leave it out for a queue without a bound")
    if queue_size is not None and not isinstance(queue_size, int):
        raise ROSException(f"queue size must be an integer, not {queue_size!r}")
    if not isinstance(buff_size, int):
        raise ROSException(f"buffer size must be an integer, not {buff_size!r}")
    if buff_size <= 0:
        raise ROSException(f"buffer size must be a positive integer, not {buff_size}")
