"""What can go wrong with transforms, under the names of tf2 (http://wiki.ros.org/tf2/Errors)."""

from __future__ import annotations

from rosmini.core.errors import RosminiError


class TransformException(RosminiError):
    """A transform cannot be had: the base of all errors of tf (`tf.Exception`)."""


class LookupException(TransformException):
    """There is no such frame, or the frames are in a loop."""


class ConnectivityException(TransformException):
    """Both frames exist, but no chain of transforms leads from one to the other."""


class ExtrapolationException(TransformException):
    """The chain exists, but not at the time that was asked for."""


class InvalidArgumentException(TransformException):
    """A frame's name, or a quaternion, is none."""


class TimeoutException(TransformException):
    """Nothing came in time."""
