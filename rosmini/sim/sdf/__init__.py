"""SDF, the format of Gazebo's worlds and models (http://sdformat.org): read to plain data, and made into a flat world."""

from .convert import converted, to_obstacles, to_walker, to_world
from .document import (
    ORIGIN,
    Note,
    Pose6,
    Sdf,
    SdfActor,
    SdfCollision,
    SdfGeometry,
    SdfInertial,
    SdfJoint,
    SdfLink,
    SdfModel,
    SdfPhysics,
    SdfPlugin,
    SdfSensor,
    SdfVisual,
    SdfWorld,
)
from .errors import SdfError
from .reader import load

__all__ = [
    "ORIGIN",
    "Note",
    "Pose6",
    "Sdf",
    "SdfActor",
    "SdfCollision",
    "SdfError",
    "SdfGeometry",
    "SdfInertial",
    "SdfJoint",
    "SdfLink",
    "SdfModel",
    "SdfPhysics",
    "SdfPlugin",
    "SdfSensor",
    "SdfVisual",
    "SdfWorld",
    "converted",
    "load",
    "to_obstacles",
    "to_walker",
    "to_world",
]
