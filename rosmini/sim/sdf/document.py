"""The contents of an SDF file as plain data: worlds, models, links, and their parts.

Lengths are in metres, angles in radians, masses in kilograms (http://sdformat.org/spec). Every pose is resolved,
whichever frame the file uses (`relative_to`): a model's is relative to its world (or to the model around it), a
link's to its model, that of a collision, visual or sensor to its link. `element` contains the raw text of a plugin
or a sensor.
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
    """A remark for users of a file: something was left out, or replaced with something simpler."""

    path: str
    line: int
    text: str
    warning: bool = False
    """True for a fault of the file, of which Gazebo complains too; False if rosmini lacks something."""
    left_out: str = ""
    """Short description of what was left out; empty if it was replaced."""

    def __str__(self) -> str:
        return f"{self.path}:{self.line}: {self.text}"


@dataclass(frozen=True)
class SdfPlugin:
    """A plugin tag; only the plugin interprets its contents."""

    name: str
    filename: str
    element: Element

    @property
    def line(self) -> int:
        """Its line in the file."""
        return self.element.line


@dataclass(frozen=True)
class SdfGeometry:
    """A shape around the pose of its collision or visual."""

    kind: GeometryKind
    size: tuple[float, ...] = ()
    """Of a box: along x, y and z. Of a plane: along x and y."""
    radius: float = 0.0
    """Radius of a cylinder or a sphere."""
    length: float = 0.0
    """Length of a cylinder along its z axis, which goes through its centre; height of a polyline from its z upwards."""
    outlines: tuple[tuple[tuple[float, float], ...], ...] = ()
    """For a polyline: one or more closed outlines of corners (x, y)."""
    normal: tuple[float, float, float] = (0.0, 0.0, 1.0)
    """Normal of a plane."""
    mesh: Path | None = None
    """The file of a mesh."""
    scale: tuple[float, float, float] = (1.0, 1.0, 1.0)
    """Scale of a mesh."""
    submesh: str = ""
    """The name of a submesh, if only that part of the mesh is used."""
    line: int = 0


@dataclass(frozen=True)
class SdfCollision:
    """A solid part: bodies collide with it, and ray sensors see it."""

    name: str
    pose: Pose6
    geometry: SdfGeometry
    friction: float | None = None
    """The Coulomb coefficient mu of its surface, if the file gives one."""
    line: int = 0
    restitution: float = 0.0
    """Coefficient of restitution, from 0 to 1."""


@dataclass(frozen=True)
class SdfVisual:
    """A visible part."""

    name: str
    pose: Pose6
    geometry: SdfGeometry
    colour: str | None = None
    """Its diffuse colour as #rrggbb, or that of the Gazebo material it names."""
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
    """A sensor on a link; its parameters are read from `element`."""

    name: str
    type: str
    """The type in the file: ray, gpu_ray, camera, depth, imu, contact..."""
    pose: Pose6
    update_rate: float
    """[Hz]; 0: once in each physics step."""
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
    """A joint between two links."""

    name: str
    type: str
    """fixed, revolute, prismatic, continuous..."""
    parent: str
    child: str
    pose: Pose6 = ORIGIN
    """Relative to the child link."""
    axis: tuple[float, float, float] = (0.0, 0.0, 1.0)
    element: Element | None = None
    line: int = 0


@dataclass(frozen=True)
class SdfModel:
    """A model: an object or a robot."""

    name: str
    pose: Pose6 = ORIGIN
    static: bool = False
    links: tuple[SdfLink, ...] = ()
    joints: tuple[SdfJoint, ...] = ()
    plugins: tuple[SdfPlugin, ...] = ()
    models: tuple[SdfModel, ...] = ()
    """Nested models; outside, the names of their links begin with the model's name and `::`."""
    path: str = ""
    line: int = 0


@dataclass(frozen=True)
class SdfActor:
    """A person who walks along a path, regardless of obstacles."""

    name: str
    waypoints: tuple[tuple[float, Pose6], ...] = ()
    """Time [s after the start] and pose in the world, sorted by time."""
    loop: bool = True
    delay: float = 0.0
    """Delay before the start, and before each round [s]."""
    plugins: tuple[SdfPlugin, ...] = ()
    path: str = ""
    line: int = 0


@dataclass(frozen=True)
class SdfPhysics:
    """The physics settings of a world."""

    type: str = "ode"
    max_step_size: float = 0.001
    """[s]"""
    real_time_factor: float = 1.0
    real_time_update_rate: float = 1000.0
    """[Hz]; 0: as fast as possible."""
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
    """Named poses, in the order of the file; robots start at those whose names begin with `start`."""
    path: str = ""
    line: int = 0
    warnings: tuple[Note, ...] = ()
    """Parts that were left out or replaced, because the file is wrong or names something that does not exist."""


@dataclass(frozen=True)
class Sdf:
    """An SDF document."""

    version: str
    worlds: tuple[SdfWorld, ...] = ()
    models: tuple[SdfModel, ...] = ()
    actors: tuple[SdfActor, ...] = ()
    path: str = ""
    notes: tuple[Note, ...] = field(default=())
