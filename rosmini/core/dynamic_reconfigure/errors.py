"""What goes wrong when parameters are changed; dynamic_reconfigure's names."""

from __future__ import annotations

from rosmini.core.errors import RosminiError


class DynamicReconfigureException(RosminiError):
    """The base of the others."""


class DynamicReconfigureParameterException(DynamicReconfigureException):
    """There is no such parameter or group, it cannot have such a value, or its description is wrong."""


class DynamicReconfigureCallbackException(DynamicReconfigureException):
    """A server's callback, or a call of its service, failed."""
