"""Conversion of URDF to SDF, which Gazebo also does before anything else.

A link on a fixed joint becomes part of the link that it is fixed to, as in Gazebo, unless a `<gazebo>` element says
`preserveFixedJoint` or `disableFixedJointLumping`: so the links of a TurtleBot3 are base_footprint and its two wheels
(http://classic.gazebosim.org/tutorials?tut=ros_urdf).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.products import inverse_matrix, matrix_product, scalar_product
from rosmini.core.markup import Element
from rosmini.sim import urdf
from rosmini.sim.sdf.document import (
    ORIGIN,
    Pose6,
    SdfCollision,
    SdfGeometry,
    SdfInertial,
    SdfJoint,
    SdfLink,
    SdfModel,
    SdfSensor,
    SdfVisual,
)
from rosmini.sim.sdf.frames import Scope
from rosmini.sim.sdf.material_colours import colour_of
from rosmini.sim.sdf.parts import plugins, sensor
from rosmini.sim.sdf.poses import matrix, pose6

Matrix = NDArray[np.float64]

LUMP = "_fixed_joint_lump__"


@dataclass(frozen=True)
class Converted:
    """An SDF model, converted from a URDF or read from an SDF text."""

    model: SdfModel
    frames: Mapping[str, tuple[str, Pose6]] = field(default_factory=dict)
    """The links that became part of another one: name of the other link, and pose in it."""
    warnings: tuple[str, ...] = ()
    """Faulty items that were left out or replaced, with file and line."""


def from_urdf(robot: urdf.Robot) -> Converted:
    """Return the SDF model of a robot. Raises `UrdfError` for a sensor or plugin that lacks a required element."""
    return _Conversion(robot).converted()


class _Conversion:
    def __init__(self, robot: urdf.Robot) -> None:
        self.robot = robot
        self.at = robot.transforms()
        self.about: dict[str, list[Element]] = {}
        for extension in robot.extensions:
            self.about.setdefault(extension.reference, []).append(extension.element)
        self.host = {robot.root: robot.root}  # maps each link to the one that it becomes part of
        for joint in robot.order:
            lumped = joint.type == "fixed" and not self._kept(joint.name)
            self.host[joint.child] = self.host[joint.parent] if lumped else joint.child

    def converted(self) -> Converted:
        robot = self.robot
        links = [name for name in robot.links if self.host[name] == name]
        joints = [joint for joint in robot.order if self.host[joint.child] == joint.child]
        top = self.about.get("", [])
        static = next((each.flag(each.word("static")) for each in top if each.find("static")), False)
        model = SdfModel(
            robot.name,
            static=static,
            links=tuple(self._link(name) for name in links),
            joints=tuple(self._joint(joint) for joint in joints),
            plugins=tuple(tag for each in top for tag in plugins(each)),
            path=robot.path,
        )
        lumped = {name: (host, self._pose(np.eye(4), host, name)) for name, host in self.host.items() if host != name}
        wrong = tuple(note for notes in robot.left_out.values() for note in notes)
        return Converted(model, lumped, wrong)

    def _kept(self, joint: str) -> bool:
        """Return True if a fixed joint must be preserved."""
        for element in self.about.get(joint, []):
            for tag in ("preserveFixedJoint", "disableFixedJointLumping"):
                found = element.find(tag)
                if found is not None and found.flag(found.text):
                    return True
        return False

    def _pose(self, origin: Matrix, host: str, name: str) -> Pose6:
        """Convert a pose on a link to the frame of the link that it became part of."""
        if host == name:
            return pose6(origin)
        return pose6(self._seen_from(host, name, origin))

    def _seen_from(self, host: str, name: str, origin: Matrix) -> Matrix:
        return matrix_product(matrix_product(inverse_matrix(self.at[host]), self.at[name]), origin)

    def _link(self, name: str) -> SdfLink:
        parts = [self.robot.links[each] for each, host in self.host.items() if host == name]
        collisions, visuals, sensors = [], [], []
        for part in parts:
            base = f"{name}{LUMP}{part.name}" if part.name != name else name
            colour = self._colour(part.name)
            for i, collision in enumerate(part.collisions):
                at = self._pose(collision.origin.matrix, name, part.name)
                called = f"{base}_collision{f'_{i}' if i else ''}"
                collisions.append(
                    SdfCollision(called, at, _geometry(collision.geometry), self._friction(part.name), part.line)
                )
            for i, visual in enumerate(part.visuals):
                at = self._pose(visual.origin.matrix, name, part.name)
                called = f"{base}_visual{f'_{i}' if i else ''}"
                shown = colour or _hex(visual.material)
                visuals.append(SdfVisual(called, at, _geometry(visual.geometry), shown, part.line))
            for element in self.about.get(part.name, []):
                sensors += [self._sensor(tag, name, part.name) for tag in element.all("sensor")]
        return SdfLink(
            name,
            pose6(self.at[name]),
            self._inertial(name, parts),
            tuple(collisions),
            tuple(visuals),
            tuple(sensors),
            self.robot.links[name].line,
        )

    def _colour(self, link: str) -> str | None:
        for element in self.about.get(link, []):
            named = element.find("material")
            if named is not None and named.text:
                script = Element("script", children=[Element("name", text=named.text)])
                return colour_of(Element("material", children=[script], path=named.path, line=named.line))
        return None

    def _friction(self, link: str) -> float | None:
        for element in self.about.get(link, []):
            mu = element.find("mu1") or element.find("mu")
            if mu is not None:
                return mu.floats(mu.attributes.get("value", mu.text), 1)[0]
        return None

    def _sensor(self, tag: Element, host: str, name: str) -> SdfSensor:
        own = sensor(tag, Scope("world", what="the robot"), ORIGIN)
        return replace(own, pose=self._pose(matrix(own.pose), host, name))

    def _inertial(self, name: str, parts: list[urdf.Link]) -> SdfInertial:
        """Combine the masses of all parts into one (parallel axis theorem)."""
        bodies = []
        for part in parts:
            if part.inertial is not None and part.inertial.mass > 0:
                at = self._seen_from(name, part.name, part.inertial.origin.matrix)
                turn = at[:3, :3]
                own = matrix_product(matrix_product(turn, part.inertial.matrix), turn.T)
                bodies.append((part.inertial.mass, at[:3, 3], own))
        mass = math.fsum(m for m, _, _ in bodies)
        if not mass:
            return SdfInertial(mass=1e-9, inertia=(1e-9, 1e-9, 1e-9, 0.0, 0.0, 0.0))
        centre = np.array(sum(m * at for m, at, _ in bodies)) / mass
        tensor = np.zeros((3, 3))
        for m, at, own in bodies:
            d = at - centre
            tensor += own + m * (scalar_product(d, d) * np.eye(3) - d[:, None] * d)
        x, y, z = (float(part) for part in centre)
        ixx, iyy, izz, ixy, ixz, iyz = (
            float(tensor[i, j]) for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
        )
        return SdfInertial(mass, (x, y, z, 0.0, 0.0, 0.0), (ixx, iyy, izz, ixy, ixz, iyz))

    def _joint(self, joint: urdf.Joint) -> SdfJoint:
        kind = {"continuous": "revolute"}.get(joint.type, joint.type)
        parent = self.host[joint.parent]
        return SdfJoint(joint.name, kind, parent, joint.child, axis=joint.axis, line=joint.line)


def _geometry(shape: urdf.model.Geometry) -> SdfGeometry:
    if isinstance(shape, urdf.Box):
        return SdfGeometry("box", size=shape.size)
    if isinstance(shape, urdf.Cylinder):
        return SdfGeometry("cylinder", radius=shape.radius, length=shape.length)
    if isinstance(shape, urdf.Sphere):
        return SdfGeometry("sphere", radius=shape.radius)
    return SdfGeometry("mesh", mesh=shape.path, scale=shape.scale)


def _hex(material: urdf.Material | None) -> str | None:
    if material is None or material.colour is None:
        return None
    red, green, blue = (round(255 * min(max(part, 0.0), 1.0)) for part in material.colour[:3])
    return f"#{red:02x}{green:02x}{blue:02x}"
