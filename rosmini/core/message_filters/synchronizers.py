"""Synchronisers: filters that combine messages of several inputs."""

from __future__ import annotations

from collections import deque
from collections.abc import MutableMapping
from typing import TYPE_CHECKING, Any

from rosmini.core.time import Duration, Time

from .filters import MessageFilterError, SimpleFilter, StampingFilter
from .policies import ApproximateTime, ExactTime, Policy, Queue

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from rosmini.core.graph import Node


MAX_UNSTAMPED = 10
"""Number of messages of one input, all with the stamp 0, after which a warning is logged."""


class StampedQueue(MutableMapping[Time, Any]):
    """A view of the waiting messages of one input, with ``Time`` keys; the keys of the policy's queue are in ns."""

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


class TimeSynchronizer(StampingFilter):
    """Calls its callbacks with one message of each of the filters ``fs``, all with the same stamp.

    Up to ``queue_size`` messages of each filter wait for partners. ``reset`` empties the queues when the clock goes
    back. The clock is that of ``node``, by default the node of the first input that has one. Callbacks
    run one after another, even if one blocks while more messages arrive. Messages without a header
    are dropped with a warning. Raises ``MessageFilterError`` for no filters and for a queue size below 1.
    """

    def __init__(
        self, fs: Iterable[SimpleFilter], queue_size: int, reset: bool = False, *, node: Node | None = None
    ) -> None:
        filters = list(fs)
        self._begin(filters, ExactTime(len(filters), queue_size, reset=reset), node=node)

    def _begin(
        self, filters: list[SimpleFilter], policy: Policy, *, allow_headerless: bool = False, node: Node | None = None
    ) -> None:
        StampingFilter.__init__(self, filters, allow_headerless=allow_headerless, node=node)
        self.policy = policy
        self.queue_size = policy.queue_size
        self.queues = [StampedQueue(queue) for queue in policy.queues]
        """The waiting messages of each input, by stamp."""
        self._ready: deque[tuple[Any, ...]] = deque()
        self._is_outputting = False
        self._unstamped: list[int | None] = [0] * len(filters)
        """Number of messages of each input, all with the stamp 0; None after another stamp, or after the warning."""
        self.connectInput(filters)

    def connectInput(self, fs: Iterable[SimpleFilter]) -> None:
        """Connect to these filters. Raises ``MessageFilterError`` if their number differs from before."""
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
        """Add a message to one of the queues, given directly or by its index; output the sets that it completes."""
        index = my_queue_index
        if index is None:
            index = next(number for number, queue in enumerate(self.queues) if queue is my_queue)
        stamp = self._stamp(msg)
        if stamp is None:
            return
        self._check_stamp(index, stamp)
        now = self._now().to_nsec() if self._knows_time() or self.policy.reset else 0
        self._ready.extend(self.policy.add(index, stamp.to_nsec(), msg, now))
        self._output_ready()

    def _check_stamp(self, index: int, stamp: Time) -> None:
        """Warn once if all messages of an input have the stamp 0, as they do not match others."""
        count = self._unstamped[index]
        if count is None or not self._knows_time():
            return
        self._unstamped[index] = None if stamp else count + 1
        if self._unstamped[index] == MAX_UNSTAMPED:
            self._unstamped[index] = None
            self._warn(
                f"{type(self).__name__}: all {MAX_UNSTAMPED} messages of input {index} have the stamp 0, which other "
                "messages do not match. Their publisher has to set header.stamp, for example to rospy.Time.now()."
            )

    def _output_ready(self) -> None:
        """Call the callbacks for all complete sets; do nothing if called again while a callback blocks."""
        if self._is_outputting:
            return
        self._is_outputting = True
        try:
            while self._ready:
                self._signal(self._ready.popleft())
        finally:
            self._is_outputting = False

    def _signal(self, messages: tuple[Any, ...]) -> None:
        """Call the callbacks for one set; if one raises, still output the sets after it."""
        try:
            self.signalMessage(*messages)
        except Exception:
            self._is_outputting = False
            self._output_ready()
            raise


class ApproximateTimeSynchronizer(TimeSynchronizer):
    """Calls its callbacks with one message of each of the filters ``fs``, all less than ``slop`` seconds apart.

    Works as `TimeSynchronizer`; `ApproximateTime` describes the choice of messages. With ``allow_headerless``, messages
    without a header get the time of their arrival, otherwise they are dropped with a warning. Raises
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
