"""Synchronisers: filters with several inputs that give out what belongs together."""

from __future__ import annotations

from collections import deque
from collections.abc import MutableMapping
from typing import TYPE_CHECKING, Any

from rosmini.core.time import Duration, Time

from .errors import MessageFilterError
from .filters import SimpleFilter, StampingFilter
from .policies import ApproximateTime, ExactTime, Policy, Queue

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from rosmini.core.graph import Node


UNSTAMPED = 10
"""How many messages of an input may have the stamp 0, if none has another, before that is reported."""


class StampedQueue(MutableMapping[Time, Any]):
    """The messages of one input that wait for partners, by stamp: the policy's queue under the keys of ROS's client."""

    def __init__(self, kept: Queue) -> None:
        self.kept = kept

    def __getitem__(self, stamp: Time) -> Any:
        return self.kept[stamp.to_nsec()]

    def __setitem__(self, stamp: Time, message: Any) -> None:
        self.kept[stamp.to_nsec()] = message

    def __delitem__(self, stamp: Time) -> None:
        del self.kept[stamp.to_nsec()]

    def __iter__(self) -> Iterator[Time]:
        return map(Time.from_nsec, list(self.kept))

    def __len__(self) -> int:
        return len(self.kept)

    def __repr__(self) -> str:
        return repr(dict(self))


class TimeSynchronizer(StampingFilter):
    """Calls its callbacks with one message of each of the filters ``fs`` that all have the same stamp.

    ``queue_size`` messages of each filter wait for their partners. ``reset`` empties the queues when the clock goes
    back. The node, whose clock that is, is that of the first input that has one, unless ``node`` is given. Callbacks
    are called one after another, also when one of them blocks and messages go on to come. Messages without a header
    are dropped with a warning. Raises ``MessageFilterError`` for no filters and for a queue size below 1.
    """

    def __init__(
        self, fs: Iterable[SimpleFilter], queue_size: int, reset: bool = False, *, node: Node | None = None
    ) -> None:
        filters = list(fs)
        self._begin(filters, ExactTime(len(filters), queue_size, reset=reset), node=node)

    def _begin(
        self,
        filters: list[SimpleFilter],
        policy: Policy,
        *,
        allow_headerless: bool = False,
        node: Node | None = None,
    ) -> None:
        StampingFilter.__init__(self, filters, allow_headerless=allow_headerless, node=node)
        self.policy = policy
        self.queue_size = policy.queue_size
        self.queues = [StampedQueue(queue) for queue in policy.queues]
        """What waits, an item for each input: messages by stamp."""
        self._ready: deque[tuple[Any, ...]] = deque()
        self._giving = False
        self._unstamped: list[int | None] = [0] * len(filters)
        """How many messages of each input had the stamp 0; None once one had another, or this was reported."""
        self.connectInput(filters)

    def connectInput(self, fs: Iterable[SimpleFilter]) -> None:
        """Connect to these filters, as many as before. Raises ``MessageFilterError`` for another number."""
        filters = list(fs)
        if len(filters) != len(self.policy.queues):
            raise MessageFilterError(
                f"{type(self).__name__} was made for {len(self.policy.queues)} filters; these are {len(filters)}"
            )
        self.input_connections = [
            one.registerCallback(self.add, queue, index)
            for index, (one, queue) in enumerate(zip(filters, self.queues, strict=True))
        ]

    def add(self, msg: Any, my_queue: StampedQueue, my_queue_index: int | None = None) -> None:
        """Take a message for one of the queues, which may be named by its index, too; give out what it completes."""
        index = my_queue_index
        if index is None:
            index = next(number for number, queue in enumerate(self.queues) if queue is my_queue)
        stamp = self._stamp(msg)
        if stamp is None:
            return
        self._look_at_stamp(index, stamp)
        now = self._now().to_nsec() if self._knows_time() or self.policy.reset else 0
        self._ready.extend(self.policy.add(index, stamp.to_nsec(), msg, now))
        self._give_out()

    def _look_at_stamp(self, index: int, stamp: Time) -> None:
        """Warn once if no message of an input has a stamp: they find no partners."""
        count = self._unstamped[index]
        if count is None or not self._knows_time():
            return
        self._unstamped[index] = None if stamp else count + 1
        if self._unstamped[index] == UNSTAMPED:
            self._unstamped[index] = None
            self._warn(
                f"{type(self).__name__}: all {UNSTAMPED} messages of input {index} have the stamp 0, which other "
                "messages do not match. Their publisher has to set header.stamp, for example to rospy.Time.now()."
            )

    def _give_out(self) -> None:
        """Call the callbacks, unless that is being done: a callback that blocks lets others come in here."""
        if self._giving:
            return
        self._giving = True
        try:
            while self._ready:
                self._signal(self._ready.popleft())
        finally:
            self._giving = False

    def _signal(self, messages: tuple[Any, ...]) -> None:
        """Call the callbacks; an error of one does not keep the sets back that wait behind it."""
        try:
            self.signalMessage(*messages)
        except Exception:
            self._giving = False
            self._give_out()
            raise


class ApproximateTimeSynchronizer(TimeSynchronizer):
    """Calls its callbacks with one message of each of the filters ``fs``, all less than ``slop`` seconds apart.

    As `TimeSynchronizer`; which messages are chosen is said at `ApproximateTime`. With ``allow_headerless`` messages
    without a header are taken as stamped at their arrival, else they are dropped with a warning. Raises
    ``MessageFilterError`` also for a slop that is not positive.
    """

    def __init__(
        self,
        fs: Iterable[SimpleFilter],
        queue_size: int,
        slop: float,
        allow_headerless: bool = False,
        reset: bool = False,
        *,
        node: Node | None = None,
    ) -> None:
        filters = list(fs)
        self.slop = Duration.from_sec(slop)
        policy = ApproximateTime(len(filters), queue_size, self.slop.to_nsec(), reset=reset)
        self._begin(filters, policy, allow_headerless=allow_headerless, node=node)
