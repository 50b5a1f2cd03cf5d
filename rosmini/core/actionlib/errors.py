"""Errors of actions."""

from __future__ import annotations

from rosmini.core.errors import RosminiError

__all__ = ["ActionException", "IllegalTransition"]


class ActionException(RosminiError):
    """An action client or server was used in an unsupported way; actionlib's name."""


class IllegalTransition(ActionException):
    """The state machine has no such transition from its current state."""
