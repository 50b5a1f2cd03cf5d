"""A robot's description: links, and the joints between them (http://wiki.ros.org/urdf/XML).

Units and axes follow REP 103: metres, radians, kilograms, seconds; fixed-axis roll, pitch, yaw. `rosmini.sim.urdf.load`
makes a `Robot` from a file; nothing here reads or writes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import nearest
from rosmini.core.geometry.products import matrix_product
from rosmini.core.graph.show import show
from rosmini.core.markup import Element

from . import kinematics
from .errors import UnknownJoint

Floats = NDArray[np.float64]
Vector = tuple[float, float, float]
Colour = tuple[float, float, float, float]
"""Red, green, blue and opacity, each from 0 to 1."""
JointType = Literal["revolute", "continuous", "prismatic", "fixed", "floating", "planar"]


@dataclass(frozen=True)
class Origin:
    """The pose of a frame in another."""

    xyz: Vector = (0.0, 0.0, 0.0)
    rpy: Vector = (0.0, 0.0, 0.0)

    @cached_property
    def matrix(self) -> Floats:
        """Return the transform (4, 4)."""
        return kinematics.origin(self.xyz, self.rpy)


@dataclass(frozen=True)
class Box:
    """A box around its origin."""

    size: Vector


@dataclass(frozen=True)
class Cylinder:
    """A cylinder around its origin, with the axis z."""

    radius: float
    length: float


@dataclass(frozen=True)
class Sphere:
    """A sphere around its origin."""

    radius: float


@dataclass(frozen=True)
class Mesh:
    """A shape from a file."""

    filename: str
    """As in the file: ``package://...``, ``file://...`` or a path."""
    scale: Vector = (1.0, 1.0, 1.0)
    path: Path | None = None
    """The file; None if it was not searched for (`load(..., meshes=False)`)."""


Geometry = Box | Cylinder | Sphere | Mesh


@dataclass(frozen=True)
class Material:
    """A named colour or texture."""

    name: str = ""
    colour: Colour | None = None
    texture: str = ""


@dataclass(frozen=True)
class Inertial:
    """Mass [kg], its centre, and the moments of inertia about it [kg m2] along the axes of `origin`."""

    mass: float
    ixx: float = 0.0
    ixy: float = 0.0
    ixz: float = 0.0
    iyy: float = 0.0
    iyz: float = 0.0
    izz: float = 0.0
    origin: Origin = Origin()

    @property
    def matrix(self) -> Floats:
        """The tensor of inertia (3, 3)."""
        return np.array(
            [[self.ixx, self.ixy, self.ixz], [self.ixy, self.iyy, self.iyz], [self.ixz, self.iyz, self.izz]]
        )


@dataclass(frozen=True)
class Visual:
    """A visible shape of a link."""

    geometry: Geometry
    origin: Origin = Origin()
    material: Material | None = None
    name: str = ""


@dataclass(frozen=True)
class Collision:
    """A shape of a link for contacts."""

    geometry: Geometry
    origin: Origin = Origin()
    name: str = ""


@dataclass(frozen=True)
class Link:
    """A rigid body; its frame has the same name."""

    name: str
    inertial: Inertial | None = None
    visuals: tuple[Visual, ...] = ()
    collisions: tuple[Collision, ...] = ()
    line: int = 0


@dataclass(frozen=True)
class Limit:
    """Range, maximum effort and maximum speed of a joint: radians or metres, N m or N, rad/s or m/s."""

    lower: float = 0.0
    upper: float = 0.0
    effort: float = 0.0
    velocity: float = 0.0


@dataclass(frozen=True)
class Mimic:
    """A joint follows another: ``multiplier * position + offset``."""

    joint: str
    multiplier: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True)
class Dynamics:
    """Damping [N m s/rad or N s/m] and friction [N m or N] of a joint."""

    damping: float = 0.0
    friction: float = 0.0


@dataclass(frozen=True)
class Joint:
    """The connection of a child link to its parent: `origin` is the child's frame in the parent's at position 0."""

    name: str
    type: JointType
    parent: str
    child: str
    origin: Origin = Origin()
    axis: Vector = (1.0, 0.0, 0.0)
    """Axis of rotation or translation, or normal of the plane, in the child's frame; of length 1."""
    limit: Limit | None = None
    mimic: Mimic | None = None
    dynamics: Dynamics | None = None
    line: int = 0

    @property
    def moves(self) -> bool:
        """True if its position is a single number: for revolute, continuous and prismatic joints."""
        return self.type in {"revolute", "continuous", "prismatic"}

    @property
    def rest(self) -> float:
        """Its default position: 0, or the middle of its limits if these exclude 0 (as in joint_state_publisher)."""
        if self.type == "continuous" or self.limit is None or self.limit.lower <= 0 <= self.limit.upper:
            return 0.0
        return (self.limit.lower + self.limit.upper) / 2

    def transform(self, position: float = 0.0) -> Floats:
        """Return the child's frame in the parent's (4, 4) at `position` [rad or m]; 0 if floating or planar."""
        if not self.moves:
            return self.origin.matrix
        return matrix_product(
            self.origin.matrix, kinematics.motion(self.axis, position, slides=self.type == "prismatic")
        )


@dataclass(frozen=True)
class Extension:
    """A raw ``<gazebo>`` element about the link or joint `reference`, or about the whole robot if that is empty."""

    reference: str
    element: Element


@dataclass(frozen=True)
class Robot:
    """A tree of links. `links` and `joints` are in the order of the file."""

    name: str
    links: Mapping[str, Link]
    joints: Mapping[str, Joint]
    root: str
    """The root of the tree."""
    materials: Mapping[str, Material] = field(default_factory=dict)
    extensions: tuple[Extension, ...] = ()
    notes: tuple[str, ...] = ()
    """Problems and omissions, each with file and line: an impossible inertia, a missing mesh..."""
    left_out: Mapping[str, Sequence[str]] = field(default_factory=dict)
    """The notes about omissions, by the kind of what was left out ("a visual")."""
    path: str = ""

    def __repr__(self) -> str:
        return f"Robot({self.name!r}, {len(self.links)} links, {len(self.joints)} joints)"

    def link(self, name: str) -> Link:
        """Return the link of this name. Raises `UnknownJoint`."""
        if name not in self.links:
            raise UnknownJoint(self._unknown("link", name, list(self.links)))
        return self.links[name]

    def joint(self, name: str) -> Joint:
        """Return the joint of this name. Raises `UnknownJoint`."""
        if name not in self.joints:
            raise UnknownJoint(self._unknown("joint", name, list(self.joints)))
        return self.joints[name]

    def _unknown(self, what: str, name: str, there: list[str]) -> str:
        hint = nearest(name, there) or f"it has: {', '.join(there) or 'none'}"
        return f"the robot {self.name!r} has no {what} {name!r}; {hint}"

    @cached_property
    def above(self) -> dict[str, Joint]:
        """For the name of each link except the root, the joint above it."""
        return {joint.child: joint for joint in self.joints.values()}

    @cached_property
    def order(self) -> tuple[Joint, ...]:
        """The joints from the root outwards: each after its parent's joint."""
        below: dict[str, list[Joint]] = {}
        for joint in self.joints.values():
            below.setdefault(joint.parent, []).append(joint)
        found: list[Joint] = []
        waiting = [self.root]
        while waiting:
            joints = below.get(waiting.pop(0), [])
            found += joints
            waiting += [joint.child for joint in joints]
        return tuple(found)

    def children(self, link: str) -> list[str]:
        """Return the child links of a link, in the order of their joints in the file."""
        return [joint.child for joint in self.joints.values() if joint.parent == link]

    @property
    def mass(self) -> float:
        """Total mass of all links [kg]."""
        return sum(link.inertial.mass for link in self.links.values() if link.inertial)

    def positions(self, joints: Mapping[str, float] | None = None) -> dict[str, float]:
        """Return the positions of all moving joints [rad or m]: as given, or at rest; a mimic joint follows its joint.

        Raises `UnknownJoint` for a joint that does not exist, and for one that does not move.
        """
        given = dict(joints or {})
        for name in given:
            if not self.joint(name).moves:
                raise UnknownJoint(
                    f"the joint {name!r} of {self.name!r} is {self.joints[name].type}: no number moves it"
                )
        found: dict[str, float] = {}

        def position(joint: Joint) -> float:  # chains of mimics end, as the reader has checked
            if joint.name not in found:
                if joint.mimic is not None:
                    followed = position(self.joints[joint.mimic.joint])
                    found[joint.name] = joint.mimic.multiplier * followed + joint.mimic.offset
                else:
                    found[joint.name] = float(given.get(joint.name, joint.rest))
            return found[joint.name]

        return {joint.name: position(joint) for joint in self.joints.values() if joint.moves}

    def transforms(self, joints: Mapping[str, float] | None = None) -> dict[str, Floats]:
        """Return every link's frame in the root's (4, 4) for positions of joints [rad or m]; see `positions`.

        Raises `UnknownJoint`.
        """
        at = self.positions(joints)
        found = {self.root: np.eye(4)}
        for joint in self.order:
            found[joint.child] = matrix_product(found[joint.parent], joint.transform(at.get(joint.name, 0.0)))
        return found

    def show3d(self, joints: Mapping[str, float] | None = None, **options: Any) -> Any:
        """Return a view of the robot in three dimensions, with joints at these positions [rad or m] or at rest.

        Options and their defaults:
            collisions=False: show collision shapes instead of visuals
            distance=None: of the camera from its target [m]; None: chosen automatically
            azimuth=None: direction of the camera [deg]: 0 towards x, 90 towards y; None: chosen automatically
            elevation=None: elevation of the camera above the horizon [deg]; None: chosen automatically
            title=None: a caption under the picture, and the first words of its text form
            height=420: of the viewer [CSS px]
        """
        return show("robot_3d", self, joints=joints, **options)
