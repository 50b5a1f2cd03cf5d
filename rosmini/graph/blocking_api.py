"""The part of a node that blocks: sleeping, waiting, spinning."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.errors import ROSException, ROSInterruptException, ROSTimeMovedBackwardsException
from rosmini.time import Duration, Time

from .clock import GraphClock, TopicClock

if TYPE_CHECKING:
    from collections.abc import Callable

    from .graph import Graph
    from .lanes import Waiter
    from .scheduler import Scheduler


class BlockingApi:
    """Time and waiting, as a :class:`~rosmini.graph.node.Node` offers them."""

    name: str
    graph: Graph
    scheduler: Scheduler
    clock: GraphClock | TopicClock
    shutdown_reason: str | None
    _stopped: bool
    _waiters: dict[Waiter, None]

    # -- time ----------------------------------------------------------------------------------------------------

    def now(self) -> Time:
        """Return the node's time."""
        return Time.from_nsec(self.clock.now_ns())

    def sleep(self, duration: float | Duration) -> None:
        """Block for seconds of the node's time; for zero or less, only let the others have their turn.

        Raises ``ROSInterruptException`` when the node shuts down meanwhile, ``ROSTimeMovedBackwardsException`` when its
        clock jumps back.
        """
        self.sleep_ns(duration.to_nsec() if isinstance(duration, Duration) else int(duration * 1e9))

    def sleep_ns(self, span: int) -> None:
        """Block for nanoseconds of the node's time; see :meth:`sleep`."""
        if span <= 0 and not self._stopped:
            self.scheduler.give_way()  # a loop that cannot keep its rate must not keep the others waiting
        if self._stopped:
            raise ROSInterruptException(self._shutdown_message())
        if span <= 0:
            return
        clock = self.clock
        if isinstance(clock, GraphClock):
            self.wait(self.scheduler.waiter("time to pass"), timeout_ns=span)
            return
        if clock.now_ns() == 0:
            self._wait_on_topic(clock, 1, "the first message on /clock")
        start = clock.now_ns()
        self._wait_on_topic(clock, start + span, "time to pass")
        now = clock.now_ns()
        if now < start:
            raise ROSTimeMovedBackwardsException((now - start) / 1e9)

    def _wait_on_topic(self, clock: TopicClock, when_ns: int, reason: str) -> None:
        waiter = self.waiter(reason)
        cancel = self.scheduler.on_hub(lambda: clock.call_at(when_ns, waiter.wake))
        try:
            self.wait(waiter)
        finally:
            cancel()

    # -- blocking ------------------------------------------------------------------------------------------------

    def waiter(self, reason: str) -> Waiter:
        """Return something to wait for; ``reason`` completes "... was waiting for"."""
        return self.scheduler.waiter(reason)

    def wait(
        self,
        waiter: Waiter,
        timeout: float | None = None,
        *,
        timeout_ns: int | None = None,
    ) -> bool:
        """Block until ``waiter`` is woken (True) or ``timeout`` seconds have passed (False).

        Raises ``ROSInterruptException`` when the node shuts down meanwhile.
        """
        if self._stopped:
            raise ROSInterruptException(self._shutdown_message())
        if timeout is not None and timeout_ns is None:
            timeout_ns = int(timeout * 1e9)
        self._waiters[waiter] = None
        try:
            return waiter.wait(timeout_ns)
        finally:
            self._waiters.pop(waiter, None)

    def wait_until(
        self, condition: Callable[[], bool], timeout: float | None, reason: str, failure: Callable[[], str]
    ) -> None:
        """Block until ``condition()`` holds, which is looked at whenever the graph changes.

        Raises ``ROSException`` with the text ``failure()`` after ``timeout`` seconds.
        """
        waiter = self.waiter(reason)

        def begin() -> None:
            self.graph.watch(condition, waiter)

        self.scheduler.on_hub(begin)
        if not self.wait(waiter, timeout):
            waiter.wake()
            msg = f"timeout exceeded after {timeout:g} s while waiting for {reason}: {failure()}"
            raise ROSException(msg)

    def spin(self) -> None:
        """Block until the node is shut down; callbacks go on meanwhile."""
        if not self._stopped:
            waiter = self.waiter("spin")
            self._waiters[waiter] = None
            try:
                waiter.wait()
            except ROSInterruptException:
                return
            finally:
                self._waiters.pop(waiter, None)

    # -- the end -------------------------------------------------------------------------------------------------

    def is_shutdown(self) -> bool:
        """Tell whether the node has been shut down."""
        return self._stopped

    def _shutdown_message(self) -> str:
        return f"node {self.name} was shut down" + (
            f": {self.shutdown_reason}" if self.shutdown_reason else ""
        )
