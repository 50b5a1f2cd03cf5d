"""The clocks of a node, and Rate and Timer, which wait for them.

A node normally uses the graph's time. With the parameter ``/use_sim_time`` set, it uses the time published on the topic
``/clock`` instead, as in ROS (http://wiki.ros.org/Clock): time does not advance until a message arrives.
"""

from __future__ import annotations

import heapq
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

from rosmini.core.errors import InvalidRate, RosminiError, ROSTimeMovedBackwardsException
from rosmini.core.time import Duration, Time

if TYPE_CHECKING:
    from collections.abc import Callable

    from .node import Node
    from .scheduler import Scheduler

CLOCK_PATIENCE_NS = 2 * 10**9
"""Time without a message on ``/clock`` after which a node logs why its sleeps hang [ns]."""


class GraphClock:
    """A node's clock that shows the graph's time."""

    def __init__(self, scheduler: Scheduler) -> None:
        self._scheduler = scheduler
        self.now_ns: Callable[[], int] = scheduler.now_ns
        """Function that returns the time in nanoseconds."""

    def call_at(self, when_ns: int, callback: Callable[[], object]) -> Callable[[], None]:
        """Call ``callback`` at ``when_ns``; return a function that cancels the call."""
        return self._scheduler.call_at(when_ns, callback).cancel


class WrongClock(GraphClock):
    """A node's clock that is wrong: ``offset_ns`` ahead of the graph's time."""

    def __init__(self, scheduler: Scheduler, offset_ns: int) -> None:
        super().__init__(scheduler)
        self._offset = offset_ns
        self.now_ns = lambda: scheduler.now_ns() + offset_ns

    def call_at(self, when_ns: int, callback: Callable[[], object]) -> Callable[[], None]:
        """Call ``callback`` at ``when_ns`` of this clock; return a function that cancels the call."""
        return super().call_at(when_ns - self._offset, callback)


class TopicClock:
    """A node's clock that shows the time published on the topic ``/clock``, and zero before the first message.

    ``complain(text)`` is called if no message arrives for ``CLOCK_PATIENCE_NS``.
    """

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
        """Call ``callback`` when the clock shows ``when_ns`` or goes back; return a function that cancels the call."""
        self._sequence += 1
        entry: list[Callable[[], object] | None] = [callback]
        heapq.heappush(self._calls, (when_ns, self._sequence, entry))

        def cancel() -> None:
            entry[0] = None

        return cancel

    def update(self, message: Any) -> None:
        """Set the time from a ``rosgraph_msgs/Clock`` message, and make the calls that are due; all if it goes back."""
        self._watch.cancel()
        before, self._now = self._now, message.clock.to_nsec()
        backwards = self._now < before
        while self._calls and (backwards or self._calls[0][0] <= self._now):
            callback = heapq.heappop(self._calls)[2][0]
            if callback is not None:
                self._scheduler.ready.append(callback)

    def close(self) -> None:
        """Stop watching for a missing ``/clock``."""
        self._watch.cancel()

    def _nobody(self) -> None:
        self._complain(
            "/use_sim_time is true, but nothing arrives on /clock: time stands still at 0 and every sleep hangs. "
            "Start what publishes /clock (a simulator, or a bag played with --clock), or delete the parameter "
            "/use_sim_time."
        )


class Rate:
    """Keeps a loop at ``hz`` cycles per second of the node's time (http://wiki.ros.org/rospy/Overview/Time).

    With ``reset``, a jump of the clock back to an earlier time restarts the cycle instead of raising an exception.
    Raises ``InvalidRate`` if ``hz`` is not positive.
    """

    def __init__(self, node: Node, hz: float, *, reset: bool = False) -> None:
        if not hz > 0:
            msg = f"a rate must be a positive number of turns a second, not {hz!r}"
            raise InvalidRate(msg)
        self._node = node
        self._reset = reset
        self._last = node.clock.now_ns()
        self._period = int(1e9 / hz)

    @property
    def sleep_dur(self) -> Duration:
        """The length of a cycle."""
        return Duration.from_nsec(self._period)

    @sleep_dur.setter
    def sleep_dur(self, duration: Duration) -> None:
        self._period = duration.to_nsec()

    def remaining(self) -> Duration:
        """Return the time left in this cycle; negative if the cycle took too long."""
        return Duration.from_nsec(self.left_ns(self._node.clock.now_ns()))

    def left_ns(self, now: int) -> int:
        """Return the time left in this cycle at the node's time ``now`` [ns]; negative if the cycle took too long."""
        self._last = min(self._last, now)
        return self._last + self._period - now

    def sleep(self) -> None:
        """Sleep until the end of this cycle; if it ended more than two periods ago, start the next cycle now.

        Raises ``ROSInterruptException`` if the node shuts down, and ``ROSTimeMovedBackwardsException`` if its clock
        jumps back, unless the rate was made with ``reset``.
        """
        node = self._node
        clock = node.clock
        try:
            node.sleep_ns(self.left_ns(clock.now_ns()))
        except ROSTimeMovedBackwardsException:
            if not self._reset:
                raise
            self.restart(clock.now_ns())
            return
        self.end_turn(clock.now_ns())

    def restart(self, now: int) -> None:
        """Start a new cycle at the node's time ``now`` [ns]."""
        self._last = now

    def end_turn(self, now: int) -> None:
        """End the cycle at the node's time ``now`` [ns].

        The next cycle starts at the time when this one should have ended, or at ``now`` if that is more than two
        periods ago.
        """
        self._last += self._period
        if now - self._last > 2 * self._period:
            self._last = now


class TimerEvent(NamedTuple):
    """The argument of a timer callback, as in rospy.

    It contains the times at which the previous call and this one should have run (`*_expected`) and ran (`*_real`), and
    the duration of the previous call [s]. On the first call, the fields of the previous one are None.
    """

    last_expected: Time | None
    last_real: Time | None
    current_expected: Time
    current_real: Time
    last_duration: float | None


class Timer:
    """Calls ``callback(event)`` every ``period`` seconds of the node's time, in a separate lane.

    With ``oneshot`` it calls the callback only once. A callback that takes longer than the period delays the following
    calls, which then run immediately; a call more than two periods late restarts the schedule, and the missed calls
    are dropped. A callback that raises an exception ends the timer, as it ends the thread of a ``rospy.Timer``: the
    error is reported, and the node continues. A jump of ``/clock`` back to an earlier time ends the timer with a
    warning; with ``reset`` it restarts the schedule instead. Between callbacks the lane is idle, not parked.

    Raises ``RosminiError`` if the period is not positive.
    """

    def __init__(
        self,
        node: Node,
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
        self._cycle = Rate(node, 1e9 / period.to_nsec())
        self._cycle.sleep_dur = period
        self._period = period.to_nsec()
        self._callback = callback
        self._reset = reset
        self._oneshot = oneshot
        self._running = True
        self._slept_from = 0
        self._expected = Time()
        self._before: tuple[Time | None, Time | None, float | None] = None, None, None
        self._cancel: Callable[[], None] | None = None
        node.timers[self] = None
        name = getattr(callback, "__name__", "callback")
        self._lane = node.spawn(f"{node.name} timer {name}", self._begin)

    def shutdown(self) -> None:
        """Stop the timer: no callback starts after this call."""
        self._running = False
        self._node.timers.pop(self, None)
        if self._cancel is not None:
            self._cancel()

    def is_alive(self) -> bool:
        """Return True if the timer may still call its callback."""
        return self._running

    def _begin(self) -> None:
        now = self._node.clock.now_ns()
        self._cycle.restart(now)
        self._expected = Time.from_nsec(now + self._period)
        self._wait()

    def _wait(self) -> None:
        """Schedule the next callback for the time at which :meth:`Rate.sleep` would return."""
        node = self._node
        if node.is_shutdown():
            self.shutdown()
        if not self._running:
            return
        clock = node.clock
        now = self._slept_from = clock.now_ns()
        span = self._cycle.left_ns(now)
        if span <= 0:  # run everything else that is due first
            node.scheduler.call_soon_threadsafe(self._due)
        elif now == 0:
            self._cancel = clock.call_at(1, partial(self._wait_from_first_message, span))
        else:
            self._cancel = clock.call_at(now + span, self._due)

    def _wait_from_first_message(self, span: int) -> None:
        clock = self._node.clock
        self._slept_from = clock.now_ns()
        self._cancel = clock.call_at(self._slept_from + span, self._due)

    def _due(self) -> None:
        self._lane.post(self._turn)

    def _turn(self) -> None:
        """Call the callback. Runs in the timer's lane."""
        if not self._running:
            return
        node = self._node
        now = node.clock.now_ns()
        if now >= self._slept_from:
            self._cycle.end_turn(now)
        elif self._reset or isinstance(node.clock, GraphClock):  # rospy checks only /clock for jumps
            self._cycle.restart(now)
        else:  # the clock has moved backwards
            self.shutdown()
            name = getattr(self._callback, "__name__", "callback")
            node.logwarn(
                f"/clock went back from {self._slept_from / 1e9:.3f} s to {now / 1e9:.3f} s: the timer of {name} "
                "has ended, as in rospy. rospy.Timer(..., reset=True) makes a timer that goes on."
            )
            return
        real, expected = Time.from_nsec(now), self._expected
        last_expected, last_real, last_duration = self._before
        try:
            self._callback(TimerEvent(last_expected, last_real, expected, real, last_duration))
        except Exception as error:
            self.shutdown()  # first, because the report may raise an exception
            node.callback_failed(error, self._callback, "a timer, which ends with it", None)
            return
        if self._oneshot:
            self.shutdown()
        self._before = expected, real, (node.clock.now_ns() - now) / 1e9
        self._expected = Time.from_nsec(expected.to_nsec() + self._period)
        self._wait()
