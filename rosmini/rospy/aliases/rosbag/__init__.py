"""What scripts import from ``rosbag`` (http://wiki.ros.org/rosbag/Code%20API)."""

from __future__ import annotations

from . import bag
from .bag import (
    Bag,
    Compression,
    ROSBagEncryptException,
    ROSBagEncryptNotSupportedException,
    ROSBagException,
    ROSBagFormatException,
    ROSBagUnindexedException,
)

__all__ = [
    "Bag",
    "Compression",
    "ROSBagEncryptException",
    "ROSBagEncryptNotSupportedException",
    "ROSBagException",
    "ROSBagFormatException",
    "ROSBagUnindexedException",
    "bag",
]
