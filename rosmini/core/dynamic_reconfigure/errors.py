"""Errors of dynamic_reconfigure, with its names."""

from __future__ import annotations

from rosmini.core.errors import RosminiError


class DynamicReconfigureException(RosminiError):
    """Base class of these errors."""


class DynamicReconfigureParameterException(DynamicReconfigureException):
    """There is no such parameter or group, the value is not allowed, or the description is wrong."""


class DynamicReconfigureCallbackException(DynamicReconfigureException):
    """A server's callback, or a call of its service, failed."""
