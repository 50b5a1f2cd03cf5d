"""Errors of `rosmini.core.geometry`."""

from __future__ import annotations

from rosmini.core.errors import RosminiError


class GeometryError(RosminiError, ValueError):
    """Numbers that are not valid geometry: nan, infinite, of the wrong shape, a negative length."""
