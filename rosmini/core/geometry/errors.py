"""What this package raises."""

from __future__ import annotations

from rosmini.core.errors import RosminiError


class GeometryError(RosminiError, ValueError):
    """Numbers that describe nothing in the plane: not a number, infinite, of the wrong shape, a negative length."""
