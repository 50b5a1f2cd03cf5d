"""Filters of messages: bring together what several topics say of one moment (http://wiki.ros.org/message_filters).

The object API, on a :class:`rosmini.core.graph.Node`. What scripts import as ``message_filters`` is the same in rospy's
style, :mod:`rosmini.ros.rospy.aliases.message_filters`. ``policies`` decides, apart from
nodes, which messages belong together.
"""

from __future__ import annotations

from .cache import Cache
from .errors import MessageFilterError
from .filters import SimpleFilter, Subscriber
from .policies import ApproximateTime, ExactTime
from .sequencer import TimeSequencer
from .synchronizers import ApproximateTimeSynchronizer, TimeSynchronizer

__all__ = [
    "ApproximateTime",
    "ApproximateTimeSynchronizer",
    "Cache",
    "ExactTime",
    "MessageFilterError",
    "SimpleFilter",
    "Subscriber",
    "TimeSequencer",
    "TimeSynchronizer",
]
