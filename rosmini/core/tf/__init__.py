"""tf: poses of frames relative to each other, over time (http://wiki.ros.org/tf2).

`tree`, `history`, `rigid` and `transformations` work on numbers; `buffer` converts from and to messages,
and `listener` and `broadcaster` connect it to a graph.
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
