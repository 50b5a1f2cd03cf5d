"""tf: where frames are in one another, over time (http://wiki.ros.org/tf2).

The tree of frames and its arithmetic are plain (`tree`, `history`, `rigid`, `transformations`); `buffer` speaks of them
in messages, and `listener` and `broadcaster` join them to a graph.
"""

from __future__ import annotations

from .broadcaster import StaticTransformBroadcaster, TransformBroadcaster
from .buffer import Buffer, BufferCore
from .errors import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)
from .listener import TransformListener
from .tree import FrameTree

__all__ = [
    "Buffer",
    "BufferCore",
    "ConnectivityException",
    "ExtrapolationException",
    "FrameTree",
    "InvalidArgumentException",
    "LookupException",
    "StaticTransformBroadcaster",
    "TimeoutException",
    "TransformBroadcaster",
    "TransformException",
    "TransformListener",
]
