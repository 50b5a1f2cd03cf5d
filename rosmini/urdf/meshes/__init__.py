"""Meshes of robots: read from files, written as COLLADA, and those of the TurtleBot3 made from their measures.

``python -m rosmini.urdf.meshes`` makes the files in `assets/ros/turtlebot3_description/meshes` again, byte by byte.
"""

from __future__ import annotations

from .files import MeshError, read
from .surface import Surface

__all__ = ["MeshError", "Surface", "read"]
