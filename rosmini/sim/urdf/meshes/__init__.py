"""Meshes of robots: surfaces, and the files they are read from."""

from __future__ import annotations

from .files import MeshError, read
from .surface import Surface

__all__ = ["MeshError", "Surface", "read"]
