"""What can be wrong with an SDF file."""

from __future__ import annotations

from rosmini.core.markup import MarkupError


class SdfError(MarkupError):
    """An SDF file cannot be read, or says what makes no world, at ``file``, line ``line``."""


class MissingError(SdfError):
    """A model or a mesh that an SDF file names is not there."""
