"""The part of a node that blocks, and that runs what may: sleeping, waiting, spinning, lanes, users' callbacks."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, NoReturn

from rosmini.core.errors import (
    MasterUnreachable,
    ROSException,
    ROSInterruptException,
    ROSTimeMovedBackwardsException,
    ServiceException,
)
from rosmini.core.time import Duration, Time

from .callbacks import describe_failure
from .clock import GraphClock, TopicClock
from .lanes import Lane, Waiter

if TYPE_CHECKING:
    from collections.abc import Callable

    from .graph_core import GraphCore
    from .lanes import LaneContext
    from .master_port import MasterProxy
    from .scheduler import Scheduler

TICKS_PER_REFUSAL = 100
"""What a blocking call of a node that was shut down weighs in a loop that never blocks: raising is dear."""

POLL_NS = 100_000_000
"""How often a Master in another process is asked for what may have changed there."""


class BlockingApi:
    """Time and waiting, as a :class:`~rosmini.core.graph.node.Node` offers them."""

    name: str
    graph: GraphCore
    scheduler: Scheduler
    master: MasterProxy
    context: LaneContext | None
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
            self._refuse_to_block()
        if span <= 0:
            return
        clock = self.clock
        if isinstance(clock, GraphClock):
            waiter = Waiter(self.scheduler, "time to pass")
            self._waiters[waiter] = None
            try:
                waiter.wait(span)
            finally:
                self._waiters.pop(waiter, None)
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

    def waiter(self, reason: str, *, remote: bool = False) -> Waiter:
        """Return something to wait for; ``reason`` completes "... was waiting for".

        ``remote``: what wakes it comes from another process.
        """
        return self.scheduler.waiter(reason, remote=remote)

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
            self._refuse_to_block()
        if timeout is not None and timeout_ns is None:
            timeout_ns = int(timeout * 1e9)
        self._waiters[waiter] = None
        try:
            return waiter.wait(timeout_ns)
        finally:
            self._waiters.pop(waiter, None)

    def _refuse_to_block(self) -> NoReturn:
        """Raise ``ROSInterruptException``; a loop that takes no notice of it lets the others have their turn."""
        self.scheduler.tick(TICKS_PER_REFUSAL)
        raise ROSInterruptException(self._shutdown_message())

    def wait_until(
        self, condition: Callable[[], bool], timeout: float | None, reason: str, failure: Callable[[], str]
    ) -> None:
        """Block until ``condition()`` holds: something of this node's own, such as its connections. It must not block.

        Raises ``ROSException`` with the text ``failure()`` after ``timeout`` seconds.
        """
        waiter = self.waiter(reason)

        def begin() -> None:
            self.graph.changes.watch(condition, waiter)

        self.scheduler.on_hub(begin)
        if not self.wait(waiter, timeout):
            waiter.wake()
            msg = f"timeout exceeded after {timeout:g} s while waiting for {reason}: {failure()}"
            raise ROSException(msg)

    def wait_for_master(
        self,
        is_so: Callable[[], bool],
        timeout: float | None,
        reason: str,
        failure: Callable[[], str],
        look_again: Callable[[], bool] = lambda: False,
    ) -> None:
        """Block until ``is_so()``, which asks the Master, returns True: it is called again and again.

        After each change at the Master, and now and then if the Master is in another process or while ``look_again()``.

        Raises ``ROSException`` with the text ``failure()`` after ``timeout`` seconds.
        """
        scheduler = self.scheduler
        end = None if timeout is None else scheduler.now_ns() + int(timeout * 1e9)
        while True:
            waiter = self.waiter(reason)
            scheduler.on_hub(
                partial(self.graph.changes.next, waiter)
            )  # before the question: no change is missed
            try:
                if self._is_answered(is_so):
                    return
                span = None if end is None else max(end - scheduler.now_ns(), 0)
                if not self.graph.master.is_local or look_again():
                    span = POLL_NS if span is None else min(span, POLL_NS)
                if not self.wait(waiter, timeout_ns=span) and end is not None and scheduler.now_ns() >= end:
                    msg = f"timeout exceeded after {timeout:g} s while waiting for {reason}: {failure()}"
                    raise ROSException(msg)
            finally:
                waiter.wake()

    def _is_answered(self, is_so: Callable[[], bool]) -> bool:
        try:
            return is_so()
        except MasterUnreachable:
            return False  # it may come back: rospy keeps trying, too

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

    # -- lanes and callbacks -------------------------------------------------------------------------------------

    def spawn(self, name: str, task: Callable[[], object] | None = None) -> Lane:
        """Return a lane of this node; ``task`` may block in it."""
        lane = Lane(self.scheduler, name, node=self, context=self.context, on_error=self._lane_error)
        if task is not None:
            lane.submit(task)
        return lane

    def run(self, task: Callable[[], object], name: str | None = None) -> Lane:
        """Run ``task`` as this node's main program: it may sleep, wait and call services while the graph goes on."""
        return self.spawn(name or f"{self.name} {getattr(task, '__name__', 'task')}", task)

    def guarded(self, callback: Callable[..., object], *arguments: Any, what: str) -> None:
        """Call a user's callback; an error is reported and goes no further."""
        try:
            callback(*arguments)
        except Exception as error:
            self.callback_failed(error, callback, what, None)

    def callback_failed(
        self,
        error: Exception,
        callback: Callable[..., object],
        where: str,
        message: Any,
        *,
        service: bool = False,
    ) -> None:
        """Report what a callback raised, with the user's own frame, where it came from, and the message."""
        if self._is_by_shutdown(error):
            return
        problem = describe_failure(error, callback, where, message, self.name)
        self.graph.report(problem, self, raise_strict=not service)

    def _lane_error(self, error: BaseException) -> None:
        if not self._is_by_shutdown(error):
            self.graph.report(error, self)

    def _is_by_shutdown(self, error: BaseException) -> bool:
        """Return whether an error only says that the node, or the whole graph with the servers in it, ends."""
        if isinstance(error, ServiceException):
            return self.graph.closing
        return self._stopped and isinstance(error, ROSInterruptException)

    # -- the end -------------------------------------------------------------------------------------------------

    def is_shutdown(self) -> bool:
        """Tell whether the node has been shut down."""
        return self._stopped

    def _why_over(self) -> str | None:
        return self._shutdown_message() if self._stopped else None

    def _shutdown_message(self) -> str:
        return f"node {self.name} was shut down" + (
            f": {self.shutdown_reason}" if self.shutdown_reason else ""
        )

    def _require_running(self, what: str) -> None:
        if self.shutdown_reason is not None:
            msg = f"{self._shutdown_message()}; it cannot {what} any more. Make a new node."
            raise ROSException(msg)
