"""What goes wrong with interactive markers."""

from __future__ import annotations

from rosmini.core.errors import RosminiError


class InteractiveMarkerException(RosminiError):
    """What a program asks for of a marker or a menu is not possible."""
