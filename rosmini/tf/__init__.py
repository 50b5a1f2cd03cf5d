"""tf: where frames are in one another, over time (http://wiki.ros.org/tf2).

The tree of frames and its arithmetic are plain (`tree`, `history`, `rigid`, `transformations`); `buffer` speaks of them in messages, and
`listener` and `broadcaster` join them to a graph.
"""

from __future__ import annotations

from .errors import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)
from .tree import FrameTree

__all__ = [
    "ConnectivityException",
    "ExtrapolationException",
    "FrameTree",
    "InvalidArgumentException",
    "LookupException",
    "TimeoutException",
    "TransformException",
]
