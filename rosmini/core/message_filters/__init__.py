"""Message filters: combine messages of several topics by their time (http://wiki.ros.org/message_filters).

This is the object API, on a :class:`rosmini.core.graph.Node`. Scripts import the same in rospy's style as
``message_filters``: :mod:`rosmini.ros.rospy.aliases.message_filters`. ``policies`` decides, without
nodes, which messages belong together.
"""

from __future__ import annotations

from .filters import Cache, MessageFilterError, SimpleFilter, Subscriber
from .policies import ApproximateTime, ExactTime
from .synchronizers import ApproximateTimeSynchronizer, TimeSynchronizer

__all__ = [
    "ApproximateTime",
    "ApproximateTimeSynchronizer",
    "Cache",
    "ExactTime",
    "MessageFilterError",
    "SimpleFilter",
    "Subscriber",
    "TimeSynchronizer",
]
