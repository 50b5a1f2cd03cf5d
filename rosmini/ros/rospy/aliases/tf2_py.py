"""The module that scripts import as ``tf2_py``: the buffer without a node, and the errors."""

from __future__ import annotations

from rosmini.core import tf
from rosmini.core.tf.errors import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)
from rosmini.core.time import Duration, Time

__all__ = [
    "BufferCore",
    "ConnectivityException",
    "ExtrapolationException",
    "InvalidArgumentException",
    "LookupException",
    "TimeoutException",
    "TransformException",
]


class BufferCore(tf.BufferCore):
    """A buffer of transforms as messages, with the underscore methods of `tf2_py` that scripts use."""

    def __init__(self, cache_time: Duration | None = None) -> None:
        super().__init__(cache_time)

    def _allFramesAsDot(self, current_time: Time | None = None) -> str:
        del current_time
        return self.all_frames_as_dot()

    def _frameExists(self, frame_id: str) -> bool:
        return frame_id in self.tree

    def _getFrameStrings(self) -> list[str]:
        return list(self.tree)

    def _chain(
        self, target_frame: str, target_time: Time, source_frame: str, source_time: Time, fixed_frame: str
    ) -> list[str]:
        return self.tree.chain_full(
            target_frame, target_time.to_nsec(), source_frame, source_time.to_nsec(), fixed_frame
        )
