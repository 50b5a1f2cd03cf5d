"""Errors in parameter files."""

from __future__ import annotations

from rosmini.core.errors import LocatedError, ParameterError


class RosParamException(LocatedError, ParameterError):
    """A parameter file, or a value in it, is wrong."""


class RosParamIOException(RosParamException):
    """The Parameter Server could not be reached."""
