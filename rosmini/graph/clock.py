"""Clocks of a node, and the things that wait for them: Rate and Timer.

A node normally lives on the graph's time. With the parameter ``/use_sim_time`` set it lives on what arrives on the
topic ``/clock`` instead, as in ROS (http://wiki.ros.org/Clock): time stands still until somebody publishes it.
"""

from __future__ import annotations

import heapq
from typing import TYPE_CHECKING, Any, NamedTuple

from rosmini.errors import ROSInterruptException, RosminiError, ROSTimeMovedBackwardsException
from rosmini.time import Duration, Time

if TYPE_CHECKING:
    from collections.abc import Callable

    from .node_port import NodePort
    from .scheduler import Scheduler

CLOCK_PATIENCE_NS = 2 * 10**9
"""After how long without ``/clock`` a node says why its sleeps hang."""


class GraphClock:
    """The graph's own time."""

    def __init__(self, scheduler: Scheduler) -> None:
        self._scheduler = scheduler

    def now_ns(self) -> int:
        """Return the time in nanoseconds."""
        return self._scheduler.now_ns()

    def call_at(self, when_ns: int, callback: Callable[[], object]) -> Callable[[], None]:
        """Call ``callback`` at ``when_ns``; return a function that takes it back."""
        return self._scheduler.call_at(when_ns, callback).cancel


class TopicClock:
    """Time as the topic ``/clock`` tells it; zero before the first message."""

    def __init__(self, scheduler: Scheduler, complain: Callable[[str], None]) -> None:
        self._scheduler = scheduler
        self._complain = complain
        self._now = 0
        self._sequence = 0
        self._calls: list[tuple[int, int, list[Callable[[], object] | None]]] = []
        self._watch = scheduler.call_at(scheduler.now_ns() + CLOCK_PATIENCE_NS, self._nobody)

    def now_ns(self) -> int:
        """Return the time in nanoseconds."""
        return self._now

    def call_at(self, when_ns: int, callback: Callable[[], object]) -> Callable[[], None]:
        """Call ``callback`` when the clock shows ``when_ns`` or has gone back; return a function that takes it back."""
        self._sequence += 1
        entry: list[Callable[[], object] | None] = [callback]
        heapq.heappush(self._calls, (when_ns, self._sequence, entry))

        def cancel() -> None:
            entry[0] = None

        return cancel

    def update(self, message: Any) -> None:
        """Take a ``rosgraph_msgs/Clock``."""
        self._watch.cancel()
        before, self._now = self._now, message.clock.to_nsec()
        backwards = self._now < before
        while self._calls and (backwards or self._calls[0][0] <= self._now):
            callback = heapq.heappop(self._calls)[2][0]
            if callback is not None:
                self._scheduler.ready.append(callback)

    def close(self) -> None:
        """Stop to look out for a missing ``/clock``."""
        self._watch.cancel()

    def _nobody(self) -> None:
        self._complain(
            "/use_sim_time is true, but nothing arrives on /clock: time stands still at 0 and every sleep hangs. "
            "Start what publishes /clock (a simulator, or a bag played with --clock), or delete the parameter "
            "/use_sim_time."
        )


class Rate:
    """Keeps a loop at ``hz`` turns a second of the node's time (http://wiki.ros.org/rospy/Overview/Time).

    With ``reset`` a jump of the clock back to an earlier time restarts the cycle instead of raising.
    """

    def __init__(self, node: NodePort, hz: float, *, reset: bool = False) -> None:
        if not hz > 0:
            msg = f"a rate must be a positive number of turns a second, not {hz!r}"
            raise RosminiError(msg)
        self._node = node
        self._reset = reset
        self._last = node.clock.now_ns()
        self._period = int(1e9 / hz)

    @property
    def sleep_dur(self) -> Duration:
        """How long a turn is."""
        return Duration.from_nsec(self._period)

    @sleep_dur.setter
    def sleep_dur(self, duration: Duration) -> None:
        self._period = duration.to_nsec()

    def remaining(self) -> Duration:
        """Return how long :meth:`sleep` would sleep."""
        return Duration.from_nsec(self._left(self._node.clock.now_ns()))

    def _left(self, now: int) -> int:
        self._last = min(self._last, now)
        return self._last + self._period - now

    def sleep(self) -> None:
        """Sleep to the end of this turn; after a turn that took too long, start afresh.

        Raises ``ROSInterruptException`` when the node shuts down, ``ROSTimeMovedBackwardsException`` when its clock
        jumps back.
        """
        node = self._node
        clock = node.clock
        try:
            node.sleep_ns(self._left(clock.now_ns()))
        except ROSTimeMovedBackwardsException:
            if not self._reset:
                raise
            self._last = clock.now_ns()
            return
        self._last += self._period
        now = clock.now_ns()
        if now - self._last > 2 * self._period:
            self._last = now


class TimerEvent(NamedTuple):
    """What a timer's callback is given: when it was due and when it ran, for this call and the one before."""

    last_expected: Time | None
    last_real: Time | None
    current_expected: Time
    current_real: Time
    last_duration: float | None


class Timer:
    """Calls ``callback(event)`` every ``period`` seconds of the node's time, in a lane of its own.

    A callback that takes longer than the period delays the next one; missed ones are not made up for. One that raises
    ends the timer, as it ends the thread of a ``rospy.Timer``: that is reported, and the node goes on.
    """

    def __init__(
        self,
        node: NodePort,
        period: Duration,
        callback: Callable[[TimerEvent], object],
        *,
        oneshot: bool = False,
        reset: bool = False,
    ) -> None:
        if period.to_nsec() <= 0:
            msg = f"a timer's period must be positive, not {period.to_sec()} s"
            raise RosminiError(msg)
        self._node = node
        self._period = period
        self._callback = callback
        self._oneshot = oneshot
        self._reset = reset
        self._running = True
        name = getattr(callback, "__name__", "callback")
        self._lane = node.spawn(f"{node.name} timer {name}", self._run)

    def shutdown(self) -> None:
        """Stop the timer: no callback starts after this."""
        self._running = False

    def is_alive(self) -> bool:
        """Tell whether callbacks may still come."""
        return self._running

    def _run(self) -> None:
        rate = Rate(self._node, 1e9 / self._period.to_nsec(), reset=self._reset)
        rate.sleep_dur = self._period
        expected = self._node.now() + self._period
        last_expected: Time | None = None
        last_real: Time | None = None
        last_duration: float | None = None
        while self._running and not self._node.is_shutdown():
            try:
                rate.sleep()
            except ROSInterruptException:
                break
            if not self._running:
                break
            real = self._node.now()
            try:
                self._callback(TimerEvent(last_expected, last_real, expected, real, last_duration))
            except Exception as error:
                self._running = False  # before the report, which may raise where the graph is driven
                self._node.callback_failed(error, self._callback, "a timer, which ends with it", None)
                break
            last_duration = (self._node.now() - real).to_sec()
            last_expected, last_real = expected, real
            if self._oneshot:
                break
            expected = expected + self._period
        self._running = False
