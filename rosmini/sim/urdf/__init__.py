"""URDF: descriptions of robots (http://wiki.ros.org/urdf)."""

from __future__ import annotations

from .errors import UnknownJoint, UrdfError
from .model import Box, Cylinder, Geometry, Joint, Link, Material, Mesh, Mimic, Origin, Robot, Sphere, Visual
from .reader import load

__all__ = [
    "Box",
    "Cylinder",
    "Geometry",
    "Joint",
    "Link",
    "Material",
    "Mesh",
    "Mimic",
    "Origin",
    "Robot",
    "Sphere",
    "UnknownJoint",
    "UrdfError",
    "Visual",
    "load",
]
