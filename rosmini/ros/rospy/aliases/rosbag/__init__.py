"""The modules that scripts import as ``rosbag`` and ``rosbag.bag`` (http://wiki.ros.org/rosbag/Code%20API).

Messages have rospy's types: tuples and bytes, not arrays.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any, BinaryIO

from rosmini.ros import bag as _bag
from rosmini.ros.bag import (
    BagMessage,
    BagMessageWithConnectionHeader,
    Compression,
    ROSBagEncryptException,
    ROSBagEncryptNotSupportedException,
    ROSBagException,
    ROSBagFormatException,
    ROSBagUnindexedException,
)
from rosmini.ros.bag.writer import CHUNK_THRESHOLD
from rosmini.ros.rospy.mains import run_tool

if TYPE_CHECKING:
    import os
    from collections.abc import Mapping, Sequence

__all__ = [
    "Bag",
    "BagMessage",
    "BagMessageWithConnectionHeader",
    "Compression",
    "ROSBagEncryptException",
    "ROSBagEncryptNotSupportedException",
    "ROSBagException",
    "ROSBagFormatException",
    "ROSBagUnindexedException",
    "rosbagmain",
]

bag = sys.modules[__name__]


class Bag(_bag.Bag):
    """`rosmini.ros.bag.Bag` with rosbag's own arguments."""

    def __init__(
        self,
        f: str | os.PathLike[str] | BinaryIO,
        mode: str = "r",
        compression: str = Compression.NONE,
        chunk_threshold: int = CHUNK_THRESHOLD,
        allow_unindexed: bool = False,
        options: Mapping[str, Any] | None = None,
        skip_index: bool = False,
    ) -> None:
        super().__init__(f, mode, compression, chunk_threshold, allow_unindexed, options, skip_index, numpy=False)


def rosbagmain(argv: Sequence[str] | None = None) -> None:
    """Run a rosbag command line, ``sys.argv`` if None; raise ``SystemExit`` if it fails."""
    run_tool("rosbag", argv)
