"""Sleeping and timers: http://wiki.ros.org/rospy/Overview/Time."""

from __future__ import annotations

from collections.abc import Callable

from rosmini.core import time as base
from rosmini.core.graph import clock
from rosmini.core.graph.clock import TimerEvent

from .rostime import Duration, Time
from .session import answer_interrupt, any_node, require_node


def sleep(duration: float | base.Duration) -> None:
    """Sleep for some seconds of the node's time; returns at once for zero or less.

    Raises ``ROSInterruptException`` if the node shuts down meanwhile, ``ROSTimeMovedBackwardsException`` if
    ``/clock`` jumps back.
    """
    node = any_node()
    try:
        node.sleep(duration)
    except KeyboardInterrupt as error:
        raise answer_interrupt(node, error) from None


class Rate(clock.Rate):
    """Runs a loop at ``hz`` turns per second: call :meth:`sleep` at the end of each turn.

    Raises ``ROSInitException`` before ``init_node``.
    """

    def __init__(self, hz: float, reset: bool = False) -> None:
        super().__init__(require_node("rospy.Rate"), hz, reset=reset)

    @property
    def sleep_dur(self) -> Duration:
        """Duration of a turn."""
        return Duration.from_nsec(self._period)

    @sleep_dur.setter
    def sleep_dur(self, duration: base.Duration) -> None:
        self._period = duration.to_nsec()

    def remaining(self) -> Duration:
        """Return how long :meth:`sleep` would sleep."""
        return Duration.from_nsec(super().remaining().to_nsec())

    def sleep(self) -> None:
        """Sleep to the end of this turn; after a turn that took too long, the cycle starts again.

        Raises ``ROSInterruptException`` if the node shuts down, ``ROSTimeMovedBackwardsException`` if ``/clock``
        jumps back.
        """
        try:
            super().sleep()
        except KeyboardInterrupt as error:
            raise answer_interrupt(self._node, error) from None

    @property
    def last_time(self) -> Time:
        """Start time of this turn."""
        return Time.from_nsec(self._last)


class Timer:
    """Calls ``callback(event)`` every ``period``, or once with ``oneshot``; the times of an event are ``rospy.Time``.

    With ``reset``, a clock that jumps back restarts the cycle. Raises ``ROSInitException`` before ``init_node``.
    """

    def __init__(
        self,
        period: base.Duration | float,
        callback: Callable[[TimerEvent], object],
        oneshot: bool = False,
        reset: bool = False,
    ) -> None:
        def call(event: TimerEvent) -> None:
            callback(
                TimerEvent(
                    _own(event.last_expected),
                    _own(event.last_real),
                    Time(event.current_expected.secs, event.current_expected.nsecs),
                    Time(event.current_real.secs, event.current_real.nsecs),
                    event.last_duration,
                )
            )

        call.__name__ = getattr(callback, "__name__", "callback")
        call.__qualname__ = getattr(callback, "__qualname__", call.__name__)
        self.daemon = True
        self._node = require_node("rospy.Timer")
        self._timer = self._node.timer(period, call, oneshot=oneshot, reset=reset)

    def shutdown(self) -> None:
        """Stop the timer: no callback starts after this."""
        self._timer.shutdown()

    def is_alive(self) -> bool:
        """Return True if callbacks may still come."""
        return self._timer.is_alive()

    def join(self, timeout: float | None = None) -> None:
        """Block until the timer has ended, or for ``timeout`` seconds."""
        scheduler = self._node.scheduler
        end = None if timeout is None else scheduler.now_ns() + int(timeout * 1e9)
        while self.is_alive() and (end is None or scheduler.now_ns() < end):
            scheduler.sleep_until(scheduler.now_ns() + 1_000_000, "a timer to end")


def _own(when: base.Time | None) -> Time | None:
    return None if when is None else Time(when.secs, when.nsecs)
