"""Errors of transforms, with tf2's names (http://wiki.ros.org/tf2/Errors)."""

from __future__ import annotations

from rosmini.core.errors import RosminiError


class TransformException(RosminiError):
    """A transform is not available: base class of all errors of tf (`tf.Exception`)."""


class LookupException(TransformException):
    """There is no such frame, or the frames are in a loop."""


class ConnectivityException(TransformException):
    """Both frames exist, but no chain of transforms leads from one to the other."""


class ExtrapolationException(TransformException):
    """The chain exists, but not at the requested time."""


class InvalidArgumentException(TransformException):
    """A frame's name or a quaternion is invalid."""


class TimeoutException(TransformException):
    """No transform arrived in time."""
