"""rospy's time: http://wiki.ros.org/rospy/Overview/Time."""

from __future__ import annotations

from typing import Self

from rosmini import time as base
from rosmini.errors import ROSInitException
from rosmini.graph.clock import TopicClock

from .session import any_node, current_node

TICKS_PER_LOOK = 50
"""A loop that polls the time takes about 50 microseconds a turn with rospy."""


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
        """Do what ``from_sec`` does, under its old name."""
        return cls.from_sec(float_secs)


def get_rostime() -> Time:
    """Return the node's time: that of ``/clock`` with ``/use_sim_time``, else the graph's.

    Raises ``ROSInitException`` before ``init_node``.
    """
    return Time.from_nsec(_now_ns())


def get_time() -> float:
    """Return the node's time as seconds. Raises ``ROSInitException`` before ``init_node``."""
    return _now_ns() / 1e9


def _now_ns() -> int:
    node = current_node()
    if node is None:
        raise ROSInitException(
            "time is not initialized: a node's clock starts with the node. Call rospy.init_node('name') before asking "
            "for the time."
        )
    node.scheduler.tick(TICKS_PER_LOOK)
    return node.clock.now_ns()


def is_rostime_initialized() -> bool:
    """Return whether there is a node, and so a time."""
    return current_node() is not None


def is_wallclock() -> bool:
    """Return whether the node does without the topic ``/clock``."""
    return not isinstance(any_node().clock, TopicClock)


def switch_to_wallclock() -> None:
    """Do nothing: ``/use_sim_time`` chooses a node's clock when it starts; before, there is the wall clock only."""


def wallsleep(duration: float | base.Duration) -> None:
    """Sleep in the graph's time, whatever ``/clock`` says."""
    seconds = duration.to_sec() if isinstance(duration, base.Duration) else duration
    scheduler = any_node().scheduler
    if seconds > 0:
        scheduler.sleep_until(scheduler.now_ns() + int(seconds * 1e9))
