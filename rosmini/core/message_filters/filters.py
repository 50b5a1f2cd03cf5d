"""The base classes of all filters, and the filter at the start of each chain: a subscriber."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .errors import MessageFilterError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from rosmini.core.graph import Node
    from rosmini.core.time import Time


class SimpleFilter:
    """A source of messages, for which callbacks are registered. Subclasses call ``signalMessage``."""

    node: Node | None = None
    """Node whose clock and log are used by the filters that follow, unless they are given one."""

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
    """The messages of a topic; ``options`` are those of ``Node.subscriber``."""

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
    """A filter that uses the time of its messages."""

    def __init__(self, inputs: Iterable[SimpleFilter], *, allow_headerless: bool, node: Node | None) -> None:
        super().__init__()
        self.allow_headerless = allow_headerless
        if node is None:
            node = next((one.node for one in inputs if one.node is not None), None)
        self.node = node
        self._complained: set[type] = set()

    def _stamp(self, message: Any) -> Time | None:
        """Return a message's stamp; without a header, return the current time if allowed, else warn and return None."""
        stamp: Time | None = getattr(getattr(message, "header", None), "stamp", None)
        if stamp is not None:
            return stamp
        if self.allow_headerless:
            return self._now()
        if type(message) not in self._complained:
            self._complained.add(type(message))
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
                f"{type(self).__name__} has to know the time, and none of its inputs belongs to a node: give node="
            )
        return self.node.now()

    def _warn(self, text: str) -> None:
        if self.node is None:
            raise MessageFilterError(text)
        self.node.logwarn(text)
