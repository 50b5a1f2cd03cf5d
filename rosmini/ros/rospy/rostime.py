"""rospy's time: http://wiki.ros.org/rospy/Overview/Time."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Self

from rosmini.core import time as base
from rosmini.core.errors import ROSInitException
from rosmini.core.graph.clock import TopicClock

from .session import any_node, current_node, current_session

TICKS_PER_POLL = 50
"""Ticks between checks, for a loop that polls the time: with rospy a turn takes about 50 microseconds."""


class Duration(base.Duration):
    """A difference of two times: ``rospy.Duration(1.5)``, ``rospy.Duration(secs, nsecs)``."""

    __slots__ = ()

    def __repr__(self) -> str:
        return f"rospy.Duration[{self.to_nsec()}]"


class Time(base.Time):
    """A point in time of the node's clock: ``rospy.Time.now()``, ``rospy.Time(secs, nsecs)``."""

    __slots__ = ()

    def __repr__(self) -> str:
        return f"rospy.Time[{self.to_nsec()}]"

    @staticmethod
    def now() -> Time:
        """Return the node's time. Raises ``ROSInitException`` before ``init_node``."""
        return get_rostime()

    @classmethod
    def from_seconds(cls, float_secs: float) -> Self:
        """Return ``from_sec(float_secs)``; an old name of that method."""
        return cls.from_sec(float_secs)


def get_rostime() -> Time:
    """Return the node's time: from ``/clock`` with ``/use_sim_time``, otherwise the graph's.

    Raises ``ROSInitException`` before ``init_node``.
    """
    return Time.from_nsec(_now_ns())


def get_time() -> float:
    """Return the node's time as seconds. Raises ``ROSInitException`` before ``init_node``."""
    return _now_ns() / 1e9


def _now_ns() -> int:
    if not is_rostime_initialized():
        raise ROSInitException(
            "time is not initialized: a node's clock starts with the node. Call rospy.init_node('name') before asking "
            "for the time."
        )
    node = any_node()
    node.scheduler.tick(TICKS_PER_POLL)
    given = current_session().set_time_ns
    return node.clock.now_ns() if given is None else given


def set_rostime_initialized(val: bool) -> None:
    """Allow a script without a node to read the time, or forbid it; used by offline tests."""
    current_session().has_time = bool(val)


def is_rostime_initialized() -> bool:
    """Return True if the time can be read: there is a node, or ``set_rostime_initialized`` has allowed it."""
    said = current_session().has_time
    return current_node() is not None if said is None else said


def _set_rostime(t: base.Time) -> None:
    """Set the time manually, like a message on ``/clock``. Raises ``ValueError`` if ``t`` is not a time."""
    if not isinstance(t, base.Time):
        raise ValueError(f"must be Time instance: {type(t)}")  # noqa: TRY004 - as in rospy
    node = current_node()
    if node is not None and isinstance(node.clock, TopicClock):
        node.clock.update(SimpleNamespace(clock=t))
    else:
        current_session().set_time_ns = t.to_nsec()


def is_wallclock() -> bool:
    """Return True if the time comes neither from the topic ``/clock`` nor from ``_set_rostime``."""
    return current_session().set_time_ns is None and not isinstance(any_node().clock, TopicClock)


def switch_to_wallclock() -> None:
    """Discard the time set by ``_set_rostime``; a node chooses its clock by ``/use_sim_time`` when it starts."""
    current_session().set_time_ns = None


def wallsleep(duration: float | base.Duration) -> None:
    """Sleep in the graph's time, ignoring ``/clock``."""
    seconds = duration.to_sec() if isinstance(duration, base.Duration) else duration
    scheduler = any_node().scheduler
    if seconds > 0:
        scheduler.sleep_until(scheduler.now_ns() + int(seconds * 1e9))
