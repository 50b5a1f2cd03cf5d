"""URDF: descriptions of robots (http://wiki.ros.org/urdf)."""

from __future__ import annotations

from .errors import UrdfError
from .model import Box, Cylinder, Geometry, Joint, Link, Material, Mesh, Robot, Sphere, Visual
from .reader import load

__all__ = [
    "Box",
    "Cylinder",
    "Geometry",
    "Joint",
    "Link",
    "Material",
    "Mesh",
    "Robot",
    "Sphere",
    "UrdfError",
    "Visual",
    "load",
]
