"""What goes wrong with filters of messages."""

from __future__ import annotations

from typing import Any

from rosmini.core.errors import RosminiError


class MessageFilterError(RosminiError, ValueError):
    """A filter was given a size, a span of time or a message that it cannot work with."""


def check_size(name: str, size: Any) -> int:
    """Return ``size``, which has to be a whole number of messages and at least 1. Raises ``MessageFilterError``."""
    if isinstance(size, bool) or not isinstance(size, int) or size < 1:
        raise MessageFilterError(
            f"{name} is {size!r}; give a whole number of messages, at least 1: a filter that keeps none has no output"
        )
    return size
