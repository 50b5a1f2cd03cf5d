"""Cache of the latest messages of a filter, for look-up by time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.core.time import Time

from .errors import MessageFilterError, check_size
from .filters import SimpleFilter, StampingFilter

if TYPE_CHECKING:
    from rosmini.core.graph import Node


class Cache(StampingFilter):
    """Keeps the last ``cache_size`` messages of the filter ``f``, in the order of their arrival, and passes all on.

    With ``allow_headerless`` messages without a header get the time of their arrival, otherwise they are dropped with
    a warning. Raises ``MessageFilterError`` for a cache size below 1.
    """

    def __init__(
        self,
        f: SimpleFilter,
        cache_size: int = 1,
        allow_headerless: bool = False,
        *,
        node: Node | None = None,
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
        """Store a message and pass it on."""
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
