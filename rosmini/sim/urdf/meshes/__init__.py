"""Meshes of robots: surfaces, and readers of mesh files."""

from __future__ import annotations

from .files import MeshError, read
from .surface import Surface

__all__ = ["MeshError", "Surface", "read"]
