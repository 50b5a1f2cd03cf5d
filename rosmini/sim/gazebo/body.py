"""Conversion of a model with a drive or sensors for the engine: parts, outline, mass and wheels.

The engine's robots turn about the middle of their axle; a model's origin may be elsewhere. `Body.axle` is the pose of
the engine's frame in the model's.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np

from rosmini.core.errors import nearest
from rosmini.core.geometry.poses import Pose, compose, inverse, transform_points
from rosmini.core.geometry.products import matrix_product, scalar_product
from rosmini.sim.models import Drive, RobotModel, WheelErrors, hull
from rosmini.sim.sdf import placed_links, to_obstacles
from rosmini.sim.sdf.document import ORIGIN, Pose6, SdfJoint, SdfModel, SdfPlugin
from rosmini.sim.sdf.poses import compose as compose6
from rosmini.sim.sdf.poses import matrix
from rosmini.sim.shapes import Box, Cylinder, Part, Polygon, Sphere, outline_at, simple_parts
from rosmini.sim.world import Obstacle

from .errors import SpawnError

TICKS = 1 << 20
"""Encoder ticks per turn of a wheel: Gazebo's joints report their exact angle."""

CIRCLE = 24
"""Number of vertices of a round part of an outline."""

DOT = 0.005
"""Half the side length of the outline of a model without collisions [m]."""


@dataclass
class Body:
    """A model to be added to the engine; plugins describe its drive in `ModelPlugin.prepare`."""

    model: SdfModel
    drive: Drive | None = None
    wheel_separation: float = 0.16
    """Distance between the wheels [m]; their radius is in m, the acceleration of their rims in m/s2."""
    wheel_radius: float = 0.033
    wheel_acceleration: float = math.inf
    rate: float = 30.0
    """Rate at which the drive publishes [Hz]."""
    axle: Pose = (0.0, 0.0, 0.0)
    wheels: tuple[str, str] | None = None
    """The joints of the left and the right wheel."""
    sides: dict[str, int] = field(default_factory=dict)
    """The joints of all wheels: 0 for the left side, 1 for the right side."""
    notes: list[str] = field(default_factory=list)

    def joint(self, name: str) -> SdfJoint:
        """Return a joint of the model. Raises `SpawnError`."""
        for joint in self.model.joints:
            if joint.name == name:
                return joint
        names = [joint.name for joint in self.model.joints]
        hint = nearest(name, names) or f"its joints are: {', '.join(names) or 'none'}"
        raise SpawnError(f"the model {self.model.name!r} has no joint {name!r}; {hint}")

    def set_wheels(
        self, left: str, right: str, separation: float, radius: float, rear: tuple[str, str] | None = None
    ) -> None:
        """Set a drive with two wheels, or four with two in the `rear`. Their positions determine the left side.

        The model turns about the middle of all wheels. Raises `SpawnError` if there are no such joints.
        """
        self.drive, self.wheels = "differential", (left, right)
        self.wheel_separation, self.wheel_radius = separation, radius
        places = {name: pose for name, _, pose in placed_links(self.model)}
        a, b = (np.array(places[self.joint(name).child][:2]) for name in (left, right))
        middle = (a + b) / 2
        if rear is not None:
            back = sum(np.array(places[self.joint(name).child][:2]) for name in rear) / 2
            middle = (middle + back) / 2
        distance = float(np.hypot(*(a - b)))
        if distance < 1e-6:
            raise SpawnError(
                f"the wheels of the joints {left!r} and {right!r} of the model {self.model.name!r} are in one place"
            )
        heading = math.atan2(a[1] - b[1], a[0] - b[0]) - math.pi / 2
        heading = math.remainder(heading, 2 * math.pi)
        if abs(heading) > math.pi / 2 + 1e-6:  # the left wheel is on the right
            self.wheels = (right, left)
            heading = math.remainder(heading + math.pi, 2 * math.pi)
            rear = rear and (rear[1], rear[0])
        self.sides = {joint: i for pair in (self.wheels, rear or ()) for i, joint in enumerate(pair)}
        self.axle = (float(middle[0]), float(middle[1]), heading if abs(heading) > 1e-9 else 0.0)
        if abs(distance - separation) > 0.05 * distance:
            self.notes.append(
                f"the wheels of the model {self.model.name!r} are {distance:.3f} m apart, but its plugin says "
                f"{separation:g} m: it is taken as the plugin says"
            )

    def robot_model(self) -> RobotModel:
        """Return the engine's model of it."""
        parts = self.parts()
        mass, inertia = self.weight()
        return RobotModel(
            name=self.model.name,
            title=self.model.name,
            mass=math.inf if self.model.static else mass,
            inertia=math.inf if self.model.static else inertia,
            footprint=_footprint(parts),
            height=max((part.top for part in parts), default=DOT),
            drive=self.drive,
            wheel_radius=self.wheel_radius,
            wheel_separation=self.wheel_separation,
            wheel_acceleration=self.wheel_acceleration,
            ticks_per_turn=TICKS,
            rate=self.rate,
            errors=WheelErrors(0.0, 0.0, 0.0),
            parts=parts,
        )

    def parts(self) -> tuple[Part, ...]:
        """Return its visible parts, relative to the middle of its axle."""
        still = replace(self.model, static=True, name="body")
        there = inverse(self.axle)
        found = []
        for obstacle in to_obstacles(still, ORIGIN):
            for shape, pose in simple_parts(obstacle.shape, obstacle.pose):
                top = obstacle.bottom + 2 * shape.radius if isinstance(shape, Sphere) else obstacle.height
                at = compose(there, pose)
                found.append(Part(shape, at, obstacle.bottom, top, obstacle.colour, self.model.name))
        return tuple(found)

    def weight(self) -> tuple[float, float]:
        """Return mass and inertia [kg, kg m2] about the vertical axis through the axle's middle (Steiner's theorem)."""
        mass = inertia = 0.0
        for _, link, pose in placed_links(self.model):
            own = link.inertial
            at = compose6(pose, own.pose)
            ixx, iyy, izz, ixy, ixz, iyz = own.inertia
            up = matrix(at)[2, :3]
            tensor = np.array([[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]])
            mass += own.mass
            away = (at[0] - self.axle[0]) ** 2 + (at[1] - self.axle[1]) ** 2
            inertia += scalar_product(up, matrix_product(tensor, up)) + own.mass * away
        return max(mass, 1e-6), max(inertia, 1e-9)


def plugins_of(model: SdfModel) -> list[SdfPlugin]:
    """Return the plugins of a model and of its nested models."""
    return [*model.plugins, *(plugin for each in model.models for plugin in plugins_of(each))]


def is_still(model: SdfModel) -> bool:
    """Return True if a model is scenery: it has no plugin and no sensor, and cannot be pushed."""
    if plugins_of(model) or any(link.sensors for _, link, _ in placed_links(model)):
        return False
    return not any(each.movable for each in to_obstacles(model))


def lowest(model: SdfModel, pose: Pose6) -> float | None:
    """Return the height of the lowest solid point of a model above its origin [m]; None if nothing is solid."""
    high = 1000.0  # high enough that everything is above the ground
    up = (0.0, 0.0, high, pose[3], pose[4], 0.0)
    found = to_obstacles(replace(model, static=True, name="body"), up)
    return min((each.bottom for each in found), default=high) - high if found else None


def obstacles_at(pose: Pose6, model: SdfModel, old: tuple[Obstacle, ...]) -> tuple[Obstacle, ...]:
    """Return the obstacles of a fixed model at another pose: rebuilt from its collisions, or `old` ones moved there."""
    if any(link.collisions for _, link, _ in placed_links(model)):
        return to_obstacles(model, pose)
    return tuple(replace(each, pose=(pose[0], pose[1], pose[5])) for each in old)


def _footprint(parts: tuple[Part, ...]) -> tuple[tuple[float, float], ...]:
    points: list[tuple[float, float]] = []
    for part in parts:
        shape = part.shape
        if isinstance(shape, (Cylinder, Sphere)):
            angles = np.arange(CIRCLE) * (2 * math.pi / CIRCLE)
            ring = shape.radius * np.column_stack([np.cos(angles), np.sin(angles)])
            points += [(float(x), float(y)) for x, y in transform_points(part.pose, ring)]
        elif isinstance(shape, (Box, Polygon)):
            points += [(float(x), float(y)) for x, y in outline_at(shape, part.pose)]
    if not points:
        points = [(-DOT, -DOT), (DOT, -DOT), (DOT, DOT), (-DOT, DOT)]
    return hull(points)
