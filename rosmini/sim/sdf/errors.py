"""Errors of SDF files."""

from __future__ import annotations

from rosmini.core.markup import MarkupError


class SdfError(MarkupError):
    """An SDF file cannot be read, or does not describe a valid world, at ``file``, line ``line``."""


class MissingError(SdfError):
    """A model or a mesh named in an SDF file does not exist."""
