"""What goes wrong with bags. The names and relatives are those of ROS's ``rosbag``, so an ``except`` of a script catches ours."""

from __future__ import annotations

from rosmini.errors import RosminiError

__all__ = [
    "BagFull",
    "BagTypeChanged",
    "FilterError",
    "ROSBagEncryptException",
    "ROSBagEncryptNotSupportedException",
    "ROSBagException",
    "ROSBagFormatException",
    "ROSBagUnindexedException",
]


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
    """A bag has no index: its recording did not come to an end. ``rosbag reindex`` makes one."""

    def __init__(self, value: object = "Unindexed bag") -> None:
        super().__init__(value)


class ROSBagEncryptNotSupportedException(ROSBagException):
    """A bag is encrypted in a way that cannot be read here."""


class ROSBagEncryptException(ROSBagException):
    """A bag could not be encrypted or decrypted."""


class BagFull(ROSBagException):
    """The disk, a quota or a limit of file sizes is full. What fitted is in the bag, which is closed and whole."""


class BagTypeChanged(ROSBagException):
    """A message in a bag has another definition than the message of that name has now."""


class FilterError(ROSBagException):
    """An expression that chooses messages uses what such an expression may not use, or failed on a message."""
