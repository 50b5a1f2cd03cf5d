"""Errors about interactive markers."""

from __future__ import annotations

from rosmini.core.errors import RosminiError


class InteractiveMarkerException(RosminiError):
    """A request about a marker or a menu cannot be fulfilled."""
