"""Bags: recordings of topics in ROS's file format 2.0 (http://wiki.ros.org/Bags/Format/2.0).

:class:`Bag` reads and writes them; :class:`Recorder` and :class:`Player` are nodes of a graph; the other modules are
the tools of the command ``rosbag``.
"""

from __future__ import annotations

from .bag import Bag
from .errors import (
    BagFull,
    FilterError,
    ROSBagEncryptException,
    ROSBagEncryptNotSupportedException,
    ROSBagException,
    ROSBagFormatException,
    ROSBagUnindexedException,
)
from .player import Player
from .recorder import Recorder, RecordOptions
from .records import Compression
from .summary import BagMessage, BagMessageWithConnectionHeader
from .tools import changed_types, filter_bag, fix_bag, recompress, reindex

__all__ = [
    "Bag",
    "BagFull",
    "BagMessage",
    "BagMessageWithConnectionHeader",
    "Compression",
    "FilterError",
    "Player",
    "ROSBagEncryptException",
    "ROSBagEncryptNotSupportedException",
    "ROSBagException",
    "ROSBagFormatException",
    "ROSBagUnindexedException",
    "RecordOptions",
    "Recorder",
    "changed_types",
    "filter_bag",
    "fix_bag",
    "recompress",
    "reindex",
]
