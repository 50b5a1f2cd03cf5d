"""SDF, the format of Gazebo's worlds and models (http://sdformat.org): reading, and conversion to flat worlds."""

from .convert import converted, to_obstacles
from .document import (
    ORIGIN,
    Pose6,
    SdfCollision,
    SdfGeometry,
    SdfInertial,
    SdfJoint,
    SdfLink,
    SdfModel,
    SdfPlugin,
    SdfSensor,
    SdfVisual,
    SdfWorld,
)
from .errors import SdfError
from .poses import placed_links
from .reader import load

__all__ = [
    "ORIGIN",
    "Pose6",
    "SdfCollision",
    "SdfError",
    "SdfGeometry",
    "SdfInertial",
    "SdfJoint",
    "SdfLink",
    "SdfModel",
    "SdfPlugin",
    "SdfSensor",
    "SdfVisual",
    "SdfWorld",
    "converted",
    "load",
    "placed_links",
    "to_obstacles",
]
