"""Errors of message filters."""

from __future__ import annotations

from typing import Any

from rosmini.core.errors import RosminiError


class MessageFilterError(RosminiError, ValueError):
    """A filter was given an invalid size, time interval or message."""


def check_size(name: str, size: Any) -> int:
    """Return ``size``. Raises ``MessageFilterError`` unless it is an integer of at least 1."""
    if isinstance(size, bool) or not isinstance(size, int) or size < 1:
        raise MessageFilterError(
            f"{name} is {size!r}; give a whole number of messages, at least 1: a filter that keeps none has no output"
        )
    return size
