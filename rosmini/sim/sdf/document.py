"""The contents of an SDF file as plain data: worlds, models, links, and what is on them.

Lengths are in metres, angles in radians, masses in kilograms (http://sdformat.org/spec). Every pose is resolved,
whatever frame a file gave it in (`relative_to`): a model's is seen from its world (or from the model around it), a
link's from its model, that of a collision, visual or sensor from its link. `element` holds the raw text of what only
a plugin or a sensor understands.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from rosmini.core.markup import Element

Pose6 = tuple[float, float, float, float, float, float]
"""x, y, z [m], roll, pitch, yaw [rad]: the rotation is yaw after pitch after roll, about fixed axes."""

ORIGIN: Pose6 = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)

GeometryKind = Literal["box", "cylinder", "sphere", "plane", "polyline", "mesh", "empty", "other"]


@dataclass(frozen=True)
class Note:
    """What a reader of a file should know: something was left out, or taken for something simpler."""

    path: str
    line: int
    text: str
    warning: bool = False
    """Whether it is a fault of the file, of which Gazebo complains too; else rosmini lacks something."""
    left_out: str = ""
    """What was left out, in a few words; empty if it was only taken for something else."""

    def __str__(self) -> str:
        return f"{self.path}:{self.line}: {self.text}"


@dataclass(frozen=True)
class SdfPlugin:
    """A plugin tag; what is in it is the plugin's own business."""

    name: str
    filename: str
    element: Element

    @property
    def line(self) -> int:
        """Its line in the file."""
        return self.element.line


@dataclass(frozen=True)
class SdfGeometry:
    """A shape around the pose of the collision or visual that it belongs to."""

    kind: GeometryKind
    size: tuple[float, ...] = ()
    """Of a box: along x, y and z. Of a plane: along x and y."""
    radius: float = 0.0
    """Of a cylinder or a sphere."""
    length: float = 0.0
    """Of a cylinder along its z, which goes through its middle; of a polyline from its z upwards."""
    outlines: tuple[tuple[tuple[float, float], ...], ...] = ()
    """Of a polyline: one or more closed outlines of corners (x, y)."""
    normal: tuple[float, float, float] = (0.0, 0.0, 1.0)
    """Of a plane."""
    mesh: Path | None = None
    """The file of a mesh."""
    scale: tuple[float, float, float] = (1.0, 1.0, 1.0)
    """Of a mesh."""
    submesh: str = ""
    """The one part of a mesh that is meant, if it is not the whole."""
    line: int = 0


@dataclass(frozen=True)
class SdfCollision:
    """What is solid: bodies run against it, and a ray sensor sees it."""

    name: str
    pose: Pose6
    geometry: SdfGeometry
    friction: float | None = None
    """The Coulomb coefficient mu of its surface, if the file gives one."""
    line: int = 0
    restitution: float = 0.0
    """How much of its speed a body has after a blow, from 0 to 1."""


@dataclass(frozen=True)
class SdfVisual:
    """What is drawn."""

    name: str
    pose: Pose6
    geometry: SdfGeometry
    colour: str | None = None
    """As #rrggbb, of its diffuse colour or of the Gazebo material it names."""
    line: int = 0


@dataclass(frozen=True)
class SdfInertial:
    """Mass and inertia about the centre of mass, which is at `pose` in the link."""

    mass: float = 1.0
    pose: Pose6 = ORIGIN
    inertia: tuple[float, float, float, float, float, float] = (1.0, 1.0, 1.0, 0.0, 0.0, 0.0)
    """ixx, iyy, izz, ixy, ixz, iyz [kg m2]."""


@dataclass(frozen=True)
class SdfSensor:
    """A sensor on a link; what its type needs is read from `element`."""

    name: str
    type: str
    """As in the file: ray, gpu_ray, camera, depth, imu, contact..."""
    pose: Pose6
    update_rate: float
    """[Hz]; 0: as often as the world is stepped."""
    element: Element
    plugins: tuple[SdfPlugin, ...] = ()

    @property
    def line(self) -> int:
        """Its line in the file."""
        return self.element.line


@dataclass(frozen=True)
class SdfLink:
    """A rigid body of a model."""

    name: str
    pose: Pose6 = ORIGIN
    inertial: SdfInertial = SdfInertial()
    collisions: tuple[SdfCollision, ...] = ()
    visuals: tuple[SdfVisual, ...] = ()
    sensors: tuple[SdfSensor, ...] = ()
    line: int = 0


@dataclass(frozen=True)
class SdfJoint:
    """What holds two links together."""

    name: str
    type: str
    """fixed, revolute, prismatic, continuous..."""
    parent: str
    child: str
    pose: Pose6 = ORIGIN
    """Seen from the child link."""
    axis: tuple[float, float, float] = (0.0, 0.0, 1.0)
    element: Element | None = None
    line: int = 0


@dataclass(frozen=True)
class SdfModel:
    """A thing or a robot."""

    name: str
    pose: Pose6 = ORIGIN
    static: bool = False
    links: tuple[SdfLink, ...] = ()
    joints: tuple[SdfJoint, ...] = ()
    plugins: tuple[SdfPlugin, ...] = ()
    models: tuple[SdfModel, ...] = ()
    """Models within it; the names of their links begin with theirs and `::` when spoken of from outside."""
    path: str = ""
    line: int = 0


@dataclass(frozen=True)
class SdfActor:
    """Somebody who walks along a path, whatever is in the way."""

    name: str
    waypoints: tuple[tuple[float, Pose6], ...] = ()
    """When [s after it started] it is where, seen from the world; sorted by time."""
    loop: bool = True
    delay: float = 0.0
    """Before it starts, and before each round [s]."""
    plugins: tuple[SdfPlugin, ...] = ()
    path: str = ""
    line: int = 0


@dataclass(frozen=True)
class SdfPhysics:
    """How a world is stepped."""

    type: str = "ode"
    max_step_size: float = 0.001
    """[s]"""
    real_time_factor: float = 1.0
    real_time_update_rate: float = 1000.0
    """[Hz]; 0: as fast as it can."""
    element: Element | None = None


@dataclass(frozen=True)
class SdfWorld:
    """A world."""

    name: str
    models: tuple[SdfModel, ...] = ()
    actors: tuple[SdfActor, ...] = ()
    physics: SdfPhysics = SdfPhysics()
    gravity: tuple[float, float, float] = (0.0, 0.0, -9.8)
    """[m/s2]"""
    plugins: tuple[SdfPlugin, ...] = ()
    frames: tuple[tuple[str, Pose6], ...] = ()
    """Named places, in the order of the file; robots start at those whose names begin with `start`."""
    path: str = ""
    line: int = 0
    warnings: tuple[Note, ...] = ()
    """What was left out or replaced, because the file is wrong or names what is not there."""


@dataclass(frozen=True)
class Sdf:
    """A document."""

    version: str
    worlds: tuple[SdfWorld, ...] = ()
    models: tuple[SdfModel, ...] = ()
    actors: tuple[SdfActor, ...] = ()
    path: str = ""
    notes: tuple[Note, ...] = field(default=())
