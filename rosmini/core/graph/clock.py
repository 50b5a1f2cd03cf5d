"""Clocks of a node, and the things that wait for them: Rate and Timer.

A node normally lives on the graph's time. With the parameter ``/use_sim_time`` set it lives on what arrives on the
topic ``/clock`` instead, as in ROS (http://wiki.ros.org/Clock): time stands still until somebody publishes it.
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
"""After how long without ``/clock`` a node says why its sleeps hang."""


class GraphClock:
    """The graph's own time."""

    def __init__(self, scheduler: Scheduler) -> None:
        self._scheduler = scheduler
        self.now_ns: Callable[[], int] = scheduler.now_ns
        """Returns the time in nanoseconds."""

    def call_at(self, when_ns: int, callback: Callable[[], object]) -> Callable[[], None]:
        """Call ``callback`` at ``when_ns``; return a function that takes it back."""
        return self._scheduler.call_at(when_ns, callback).cancel


class WrongClock(GraphClock):
    """A clock that is ``offset_ns`` ahead of the graph's time."""

    def __init__(self, scheduler: Scheduler, offset_ns: int) -> None:
        super().__init__(scheduler)
        self._offset = offset_ns
        self.now_ns = lambda: scheduler.now_ns() + offset_ns

    def call_at(self, when_ns: int, callback: Callable[[], object]) -> Callable[[], None]:
        """Call ``callback`` at ``when_ns`` of this clock; return a function that takes it back."""
        return super().call_at(when_ns - self._offset, callback)


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
        """Stop watching for a missing ``/clock``."""
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
        """How long a turn is."""
        return Duration.from_nsec(self._period)

    @sleep_dur.setter
    def sleep_dur(self, duration: Duration) -> None:
        self._period = duration.to_nsec()

    def remaining(self) -> Duration:
        """Return how long :meth:`sleep` would sleep."""
        return Duration.from_nsec(self.left_ns(self._node.clock.now_ns()))

    def left_ns(self, now: int) -> int:
        """Return how much is left of this turn at a time of the node's clock; negative when it took too long."""
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
            node.sleep_ns(self.left_ns(clock.now_ns()))
        except ROSTimeMovedBackwardsException:
            if not self._reset:
                raise
            self.restart(clock.now_ns())
            return
        self.end_turn(clock.now_ns())

    def restart(self, now: int) -> None:
        """Let a turn begin now."""
        self._last = now

    def end_turn(self, now: int) -> None:
        """Note that a turn was slept to its end; the next one began when it was due, unless it is very late."""
        self._last += self._period
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
    ends the timer, as it ends the thread of a ``rospy.Timer``: that is reported, and the node goes on. Between two
    callbacks nothing is parked.
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
        """Stop the timer: no callback starts after this."""
        self._running = False
        self._node.timers.pop(self, None)
        if self._cancel is not None:
            self._cancel()

    def is_alive(self) -> bool:
        """Tell whether callbacks may still come."""
        return self._running

    def _begin(self) -> None:
        now = self._node.clock.now_ns()
        self._cycle.restart(now)
        self._expected = Time.from_nsec(now + self._period)
        self._wait()

    def _wait(self) -> None:
        """Ask for the next turn, as :meth:`Rate.sleep` sleeps until then."""
        node = self._node
        if node.is_shutdown():
            self.shutdown()
        if not self._running:
            return
        clock = node.clock
        now = self._slept_from = clock.now_ns()
        span = self._cycle.left_ns(now)
        if span <= 0:  # everything else that is due comes first
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
        """Call the callback. In the timer's lane."""
        if not self._running:
            return
        node = self._node
        now = node.clock.now_ns()
        if now >= self._slept_from:
            self._cycle.end_turn(now)
        elif self._reset or isinstance(node.clock, GraphClock):  # rospy looks at jumps of /clock only
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
            self.shutdown()  # before the report, which may raise where the graph is driven
            node.callback_failed(error, self._callback, "a timer, which ends with it", None)
            return
        if self._oneshot:
            self.shutdown()
        self._before = expected, real, (node.clock.now_ns() - now) / 1e9
        self._expected = Time.from_nsec(expected.to_nsec() + self._period)
        self._wait()
