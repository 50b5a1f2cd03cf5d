"""A filter that sorts messages by their stamps."""

from __future__ import annotations

import heapq
from typing import TYPE_CHECKING, Any

from rosmini.core.time import Duration

from .errors import MessageFilterError, check_size
from .filters import SimpleFilter, StampingFilter

if TYPE_CHECKING:
    from rosmini.core.graph import Node


class TimeSequencer(StampingFilter):
    """Passes on the messages of ``f`` in the order of their stamps, each at least ``delay`` seconds after its stamp.

    It checks every ``update_rate`` seconds, as the C++ client's does
    (http://wiki.ros.org/message_filters#Time_Sequencer; rospy has none). A message older than one
    that was passed on already is dropped; so is the oldest if more than ``queue_size`` wait. Raises
    ``MessageFilterError`` for a queue size below 1, and for a delay or rate that is not positive.
    """

    def __init__(
        self, f: SimpleFilter, delay: float, update_rate: float, queue_size: int, *, node: Node | None = None
    ) -> None:
        super().__init__([f], allow_headerless=False, node=node)
        if not (delay > 0 and update_rate > 0):
            raise MessageFilterError(
                f"delay ({delay} s) and update_rate ({update_rate} s) have to be positive"
            )
        if self.node is None:
            raise MessageFilterError(
                "TimeSequencer needs a timer, and its input belongs to no node: give node="
            )
        self.queue_size = check_size("queue_size", queue_size)
        self._delay = Duration.from_sec(delay).to_nsec()
        self._waiting: list[tuple[int, int, Any]] = []
        self._count = 0
        self._given = -1
        self.timer = self.node.timer(update_rate, lambda _: self._look())
        self.connectInput(f)

    def connectInput(self, f: SimpleFilter) -> None:
        """Receive messages from ``f`` too."""
        self.incoming_connection = f.registerCallback(self.add)

    def add(self, msg: Any) -> None:
        """Store a message until it is due."""
        stamp = self._stamp(msg)
        if stamp is None or stamp.to_nsec() < self._given:
            return
        self._count += 1
        heapq.heappush(self._waiting, (stamp.to_nsec(), self._count, msg))
        if len(self._waiting) > self.queue_size:
            heapq.heappop(self._waiting)

    def _look(self) -> None:
        due = self._now().to_nsec() - self._delay
        while self._waiting and self._waiting[0][0] <= due:
            self._given, _, message = heapq.heappop(self._waiting)
            self.signalMessage(message)
