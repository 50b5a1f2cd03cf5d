"""Errors about bags.

Names and base classes are those of ROS's ``rosbag``, so an ``except`` clause of a script catches ours.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from io import UnsupportedOperation

from rosmini.core.errors import RosminiError


class ROSBagException(RosminiError):
    """The base of all errors about bags."""

    def __init__(self, value: object = None) -> None:
        super().__init__(value)
        self.value = value

    def __str__(self) -> str:
        return str(self.value)


class ROSBagFormatException(ROSBagException):
    """A file is not a bag, or its bytes break the format."""


class ROSBagUnindexedException(ROSBagException):
    """A bag has no index because its recording was not finished; ``rosbag reindex`` makes one."""

    def __init__(self, value: object = "Unindexed bag") -> None:
        super().__init__(value)


class DamagedIndex(ROSBagUnindexedException, ROSBagFormatException):
    """The index of a bag is damaged. ROS's rosbag does not distinguish this from a bag without one."""


class ROSBagEncryptNotSupportedException(ROSBagException):
    """A bag is encrypted in a way that is not supported."""


class ROSBagEncryptException(ROSBagException):
    """A bag could not be encrypted or decrypted."""


@contextmanager
def in_file(name: str) -> Iterator[None]:
    """Prefix errors raised within the block with the file's name."""
    try:
        yield
    except ROSBagException as error:
        if not str(error).startswith(name):
            error.value = f"{name}: {error.value}"
            error.args = (error.value,)
        raise


class UnknownCompression(ROSBagException, ValueError):
    """Unknown compression (rosbag raises ``ValueError``)."""


class NotOpenForWriting(ROSBagException, UnsupportedOperation):
    """A bag open for reading cannot be written to (rosbag raises Python's error for such a file)."""


class BagFull(ROSBagException):
    """The disk, a quota or a file size limit is full; what fitted is in the bag, which is closed and intact."""


class FilterError(ROSBagException):
    """A filter expression uses something that is not allowed, or failed on a message."""
