"""Message filters: combine messages of several topics by their time (http://wiki.ros.org/message_filters).

Filters take a :class:`rosmini.core.graph.Node`. Scripts import the same classes in rospy's style as
``message_filters``: :mod:`rosmini.ros.rospy.aliases.message_filters`. The module ``policies``, which decides which
messages belong together, does not depend on nodes.
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
