"""The base classes of all filters, and two filters: `Subscriber`, which starts a chain of filters, and `Cache`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.core.errors import RosminiError
from rosmini.core.time import Time

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from rosmini.core.graph import Node
    from rosmini.core.time import Time


class MessageFilterError(RosminiError, ValueError):
    """A filter was given an invalid size, time interval or message."""


def check_size(name: str, size: Any) -> int:
    """Return ``size``. Raises ``MessageFilterError`` unless it is an integer of at least 1."""
    if isinstance(size, bool) or not isinstance(size, int) or size < 1:
        raise MessageFilterError(
            f"{name} is {size!r}; give an integer of at least 1: without messages a filter has no output"
        )
    return size


class SimpleFilter:
    """Base class of filters: passes messages to registered callbacks. Subclasses call ``signalMessage``."""

    node: Node | None = None
    """The node whose clock and log the next filters in the chain use, unless they are given another."""

    def __init__(self) -> None:
        self.callbacks: dict[int, tuple[Callable[..., object], tuple[Any, ...]]] = {}

    def registerCallback(self, cb: Callable[..., object], *args: Any) -> int:
        """Call ``cb(*output, *args)`` for each output; return the number of this registration."""
        number = len(self.callbacks)
        self.callbacks[number] = (cb, args)
        return number

    def signalMessage(self, *msg: Any) -> None:
        """Output ``msg``: call all callbacks, in the order of their registration."""
        for callback, arguments in list(self.callbacks.values()):
            callback(*msg, *arguments)


class Subscriber(SimpleFilter):
    """A filter that outputs the messages of a topic; ``options`` are those of ``Node.subscriber``."""

    def __init__(self, node: Node, topic: str, message_class: Any, **options: Any) -> None:
        super().__init__()
        self.node = node
        self.topic = topic
        self.sub = node.subscriber(topic, message_class, self.signalMessage, **options)

    def getTopic(self) -> str:
        """Return the topic's name, as given."""
        return self.topic

    def unregister(self) -> None:
        """Stop receiving. Safe to call again."""
        self.sub.unregister()


class StampingFilter(SimpleFilter):
    """Base class of filters that use the stamps of messages, and the clock and log of ``node``.

    By default, this is the node of the first input that has one.
    """

    def __init__(self, inputs: Iterable[SimpleFilter], *, allow_headerless: bool, node: Node | None) -> None:
        super().__init__()
        self.allow_headerless = allow_headerless
        if node is None:
            node = next((one.node for one in inputs if one.node is not None), None)
        self.node = node
        self._warned_types: set[type] = set()

    def _stamp(self, message: Any) -> Time | None:
        """Return a message's stamp; without a header, return the current time if allowed, else warn and return None."""
        stamp: Time | None = getattr(getattr(message, "header", None), "stamp", None)
        if stamp is not None:
            return stamp
        if self.allow_headerless:
            return self._now()
        if type(message) not in self._warned_types:
            self._warned_types.add(type(message))
            self._warn(
                f"messages of type {getattr(message, '_type', type(message).__name__)} have no header, and "
                f"{type(self).__name__} drops them. ApproximateTimeSynchronizer and Cache take the time of arrival "
                "if they are made with allow_headerless=True."
            )
        return None

    def _knows_time(self) -> bool:
        return self.node is not None

    def _now(self) -> Time:
        if self.node is None:
            raise MessageFilterError(
                f"{type(self).__name__} needs the time, but none of its inputs belongs to a node: pass node="
            )
        return self.node.now()

    def _warn(self, text: str) -> None:
        if self.node is None:
            raise MessageFilterError(text)
        self.node.logwarn(text)


class Cache(StampingFilter):
    """Keeps the last ``cache_size`` messages of the filter ``f``, in the order of their arrival, and passes all on.

    With ``allow_headerless`` messages without a header get the time of their arrival, otherwise they are dropped with
    a warning. Raises ``MessageFilterError`` for a cache size below 1.
    """

    def __init__(
        self, f: SimpleFilter, cache_size: int = 1, allow_headerless: bool = False, *, node: Node | None = None
    ) -> None:
        super().__init__([f], allow_headerless=allow_headerless, node=node)
        self.cache_size = check_size("cache_size", cache_size)
        self.cache_msgs: list[Any] = []
        """The cached messages, oldest first."""
        self.cache_times: list[Time] = []
        """Their stamps."""
        self.connectInput(f)

    def connectInput(self, f: SimpleFilter) -> None:
        """Receive messages from ``f`` too."""
        self.incoming_connection = f.registerCallback(self.add)

    def add(self, msg: Any) -> None:
        """Store a message, drop the oldest one if the cache is full, and pass the message on.

        A message without a header is dropped, unless `allow_headerless` was given.
        """
        stamp = self._stamp(msg)
        if stamp is not None:
            self.cache_times.append(type(stamp)(stamp.secs, stamp.nsecs))
            self.cache_msgs.append(msg)
            if len(self.cache_msgs) > self.cache_size:
                del self.cache_msgs[0], self.cache_times[0]
            self.signalMessage(msg)

    def _pairs(self) -> list[tuple[Time, Any]]:
        return list(zip(self.cache_times, self.cache_msgs, strict=True))

    def getInterval(self, from_stamp: Time, to_stamp: Time) -> list[Any]:
        """Return the messages from one time to another, inclusive. Raises ``MessageFilterError`` if reversed."""
        if from_stamp > to_stamp:
            raise MessageFilterError(
                f"the interval is from {from_stamp.to_sec()} s to {to_stamp.to_sec()} s: give the earlier time first"
            )
        return [message for stamp, message in self._pairs() if from_stamp <= stamp <= to_stamp]

    def getElemAfterTime(self, stamp: Time) -> Any:
        """Return the first message at or after this time, or None."""
        return next((message for when, message in self._pairs() if when >= stamp), None)

    def getElemBeforeTime(self, stamp: Time) -> Any:
        """Return the last message at or before this time, or None."""
        return next((message for when, message in reversed(self._pairs()) if when <= stamp), None)

    def getLatestTime(self) -> Time | None:
        """Return the stamp of the message that arrived last, or None."""
        return self.cache_times[-1] if self.cache_times else None

    def getLastestTime(self) -> Time | None:
        """Return the same as :meth:`getLatestTime`, under ROS's old, misspelt name."""
        return self.getLatestTime()

    def getOldestTime(self) -> Time | None:
        """Return the stamp of the cached message that arrived first, or None."""
        return self.cache_times[0] if self.cache_times else None

    def getLast(self) -> Any:
        """Return the first message whose stamp is not older than that of the message that arrived last, or None."""
        return self.getElemAfterTime(self.cache_times[-1]) if self.cache_times else None
