"""Errors of robot descriptions."""

from __future__ import annotations

from rosmini.core.errors import RosminiError
from rosmini.core.markup import MarkupError


class UrdfError(MarkupError):
    """A URDF or xacro file is invalid at ``file``, line ``line``."""


class UnknownJoint(RosminiError, KeyError):
    """A robot has no joint, or no link, of this name."""

    # KeyError shows the repr of its argument, which would put quotes around our sentences.
    __str__ = Exception.__str__
