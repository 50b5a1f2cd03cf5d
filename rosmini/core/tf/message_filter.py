"""Messages that wait for their transform (http://wiki.ros.org/tf2/Tutorials/Using%20stamped%20datatypes%20with%20tf2::MessageFilter)."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable
from typing import Any

from .buffer import Buffer
from .errors import TransformException

NO_FRAME = "it has no frame_id"
TOO_OLD = "its stamp is earlier than all the data in the transform cache"
QUEUE_FULL = "the queue of messages that wait for their transform was full"


class MessageFilter:
    """Passes each stamped message to `callback` once it can be transformed to all `target_frames`, at its stamp.

    With a `tolerance` [s], the transforms must also be known that much later than the stamp, as with `setTolerance` of
    `tf2_ros::MessageFilter`. At most `queue_size` messages wait (0: any number); the oldest is dropped first.
    `failed(message, reason)` is called for each message that is dropped.
    """

    def __init__(
        self,
        buffer: Buffer,
        target_frames: Iterable[str],
        callback: Callable[[Any], object],
        *,
        queue_size: int = 0,
        tolerance: float = 0.0,
        failed: Callable[[Any, str], object] | None = None,
    ) -> None:
        self.buffer = buffer
        self.target_frames = tuple(frame.lstrip("/") for frame in target_frames)
        self._callback = callback
        self._failed = failed
        self._queue_size = queue_size
        self._tolerance_ns = round(tolerance * 1e9)
        self._waiting: deque[Any] = deque()
        self._end = buffer.watch(self._check_waiting)

    def __len__(self) -> int:
        """Return the number of waiting messages."""
        return len(self._waiting)

    def add(self, message: Any) -> None:
        """Add a message with a header: pass it on, drop it, or let it wait."""
        if not message.header.frame_id.lstrip("/"):
            self._drop(message, NO_FRAME)
        elif not self._pass_or_drop(message):
            self._waiting.append(message)
            if 0 < self._queue_size < len(self._waiting):
                self._drop(self._waiting.popleft(), QUEUE_FULL)

    def clear(self) -> None:
        """Remove all waiting messages."""
        self._waiting.clear()

    def close(self) -> None:
        """Remove all waiting messages, and stop watching the buffer."""
        self.clear()
        self._end()

    def _check_waiting(self) -> None:
        """Check all waiting messages after new transforms have arrived."""
        for _ in range(len(self._waiting)):
            message = self._waiting.popleft()
            if not self._pass_or_drop(message):
                self._waiting.append(message)

    def _pass_or_drop(self, message: Any) -> bool:
        """Pass a message on or drop it, if this can be decided; return True if so."""
        source = message.header.frame_id.lstrip("/")
        stamp = message.header.stamp.to_nsec()
        stamps = (stamp, stamp + self._tolerance_ns) if self._tolerance_ns else (stamp,)
        for target in self.target_frames:
            newest = self._newest(target, source)
            if 0 < newest < stamps[-1]:  # a cheap test of the usual case
                return False
            for each in stamps:
                if self.buffer.tree.knows(target, source, each):
                    continue
                if newest > stamps[-1]:  # transforms that may still arrive cannot help
                    self._drop(message, TOO_OLD)
                    return True
                return False
        self._callback(message)
        return True

    def _newest(self, target: str, source: str) -> int:
        """Return the latest time [ns] for which all transforms between two frames are known.

        It is 0 if there is none, or if all transforms are static.
        """
        try:
            return self.buffer.tree.latest_common_time(target, source)
        except TransformException:
            return 0

    def _drop(self, message: Any, reason: str) -> None:
        if self._failed is not None:
            self._failed(message, reason)
