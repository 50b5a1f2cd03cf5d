"""What goes wrong with actions."""

from __future__ import annotations

from rosmini.core.errors import RosminiError

__all__ = ["ActionException", "IllegalTransition"]


class ActionException(RosminiError):
    """An action client or server was used in a way that it cannot be used in; actionlib's name."""


class IllegalTransition(ActionException):
    """A state machine was asked for a step that it does not have."""
