"""The module that scripts import as ``message_filters``: http://wiki.ros.org/message_filters.

Names and signatures are those of message_filters 1.15; clock and log are those of the script's node. The
implementation is :mod:`rosmini.core.message_filters`.
"""

from __future__ import annotations

from typing import Any

from rosmini.core import message_filters as core
from rosmini.core.message_filters.filters import SimpleFilter, StampingFilter
from rosmini.ros import rospy

__all__ = ["ApproximateTimeSynchronizer", "Cache", "SimpleFilter", "Subscriber", "TimeSynchronizer"]


class Subscriber(SimpleFilter):
    """The messages of a topic; takes the arguments of ``rospy.Subscriber`` and has its attributes."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__()
        self.topic = args[0] if args else kwargs.get("name")
        kwargs["callback"] = self.callback
        self.sub = rospy.Subscriber(*args, **kwargs)

    def callback(self, msg: Any) -> None:
        """Receive a message from the topic and pass it on."""
        self.signalMessage(msg)

    def getTopic(self) -> Any:
        """Return the name of the topic as given."""
        return self.topic

    def __getattr__(self, key: str) -> Any:
        if key == "sub":  # it could not be made: there is nothing to ask
            raise AttributeError(key)
        return getattr(self.sub, key)


class _OfScript(StampingFilter):
    """A filter that uses the node of the running script."""

    def _knows_time(self) -> bool:
        return True

    def _now(self) -> rospy.Time:
        return rospy.get_rostime()

    def _warn(self, text: str) -> None:
        rospy.logwarn(text)


class Cache(_OfScript, core.Cache):
    """Keeps the last messages of a filter: see :class:`rosmini.core.message_filters.Cache`."""


class TimeSynchronizer(_OfScript, core.TimeSynchronizer):
    """Passes on messages with equal stamps: see :class:`rosmini.core.message_filters.TimeSynchronizer`."""


class ApproximateTimeSynchronizer(_OfScript, core.ApproximateTimeSynchronizer):
    """Passes on messages with similar stamps: see :class:`rosmini.core.message_filters.ApproximateTimeSynchronizer`."""
